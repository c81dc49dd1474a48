"""A small experiment, and its gallery: two materials with sheets of 16 x 16 pixels, and two without."""

import atexit
import functools
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

RESOLUTION = 16
SHEET = ["--res", str(RESOLUTION), "--model", "both", "--spp", "64", "--sampler", "grid"]
BOTH = "two-layer"  # has all that there can be
BARE = "conductor"  # has a sheet alone
MATERIALS = [
    {"number": 3, "name": BOTH, "listed": True, "kind": "plastic", "file": f"{BOTH}.binary", "present": True},
    {"number": 1, "name": BARE, "listed": True, "kind": "metal", "file": f"{BARE}.binary", "present": True},
    {"number": 2, "name": "brass", "listed": True, "kind": "metal", "file": "brass.binary", "present": False},
    {"number": 4, "name": "steel", "listed": True, "kind": "metal", "file": "steel.binary", "present": True},
]
SUMMARY = {
    "models": [{"model": "shared", "lobes": 1, "relrmse": {"median": 0.125, "worst": 2.5}}],
    "worst": [{"material": BOTH, "relrmse": 2.5, "reason": "the inversion"}],
    "time": {"wall_seconds": 12.5},
}


@functools.cache
def scratch() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="test_gallery."))
    atexit.register(shutil.rmtree, folder)
    return folder


def slopemix(*arguments) -> str:
    command = [os.environ["SLOPEMIX"], *map(str, arguments)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def gallery(*arguments) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-m", "gallery", *map(str, arguments)], capture_output=True, text=True)


@functools.cache
def out() -> Path:
    folder = scratch() / "out"
    for name in (BOTH, BARE):
        slopemix("sheet", f"builtin:{name}", "--out", folder / "sheets" / name, *SHEET)
    for model, lobes in (("shared", 1), ("per-lobe", 2)):
        slopemix(
            "fit",
            f"builtin:{BOTH}",
            "--model",
            model,
            "--lobes",
            lobes,
            "--plot",
            "--out",
            folder / "fits" / BOTH / f"{model}-{lobes}",
        )
    budget = slopemix(
        "budget", f"builtin:{BOTH}", "--res", 16, "--alpha", "0.25,0.25", "--lobes", 2, "--spp", 64, "--json"
    )
    write(folder / "budget" / f"{BOTH}.json", budget)
    write(
        folder / "metrics" / f"{BOTH}.json",
        json.dumps(
            {
                "images": [
                    {"id": image["id"], "flip": image["relrmse"] / 2}
                    for image in sheet(BOTH)["images"]
                    if "relrmse" in image
                ]
            }
        ),
    )
    write(folder / "materials.json", json.dumps(MATERIALS))
    write(folder / "gallery" / "summary.json", json.dumps(SUMMARY))
    return folder


@functools.cache
def site() -> Path:
    """The gallery with everything in it."""
    done = gallery(out())
    if done.returncode or done.stderr:
        raise RuntimeError(f"the gallery was not built: {done.stderr}")
    return out() / "gallery"


def sheet(name: str) -> dict:
    return json.loads((scratch() / "out" / "sheets" / name / "sheet.json").read_text())


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)

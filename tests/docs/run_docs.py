"""Runs the commands and the code of README.md, CONTRIBUTING.md and docs/*.md (blocks.py says what is run), and checks their
links. Every page has a folder of its own, with a table gold-paint.binary and a folder merl/ of two (built-in materials
by other names), in which its blocks are run in order; commands find an installation of the build, and images are small.

    SOURCE=DIR BUILD=DIR LIBDIR=lib run_docs.py [--slow] [PAGE...]
"""
import collections
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from blocks import Malformed, blocks_of
from links import broken_links

SOURCE, BUILD, LIBDIR = (pathlib.Path(os.environ["SOURCE"]), pathlib.Path(os.environ["BUILD"]), os.environ["LIBDIR"])
HERE = pathlib.Path(__file__).resolve().parent
C = ["cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]


class Failed(Exception):
    """A block that does not do what it shows."""


def call(arguments, folder, environment, what):
    done = subprocess.run(arguments, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace")
    if done.returncode:
        raise Failed(f"{what}: status {done.returncode}\n{done.stdout}")


def installed(work):
    """An installation of the build, and the environment of a user of it."""
    prefix, bin_ = work / "installed", work / "bin"
    call(["cmake", "--install", str(BUILD), "--prefix", str(prefix)], work, None, "cmake --install")
    bin_.mkdir()
    shutil.copy(HERE / "slopemix", bin_ / "slopemix")
    library = prefix / LIBDIR
    return os.environ | {
        "PATH": f"{bin_}:{os.environ['PATH']}", "SLOPEMIX": str(prefix / "bin" / "slopemix"),
        "LD_LIBRARY_PATH": str(library), "LIBRARY_PATH": str(library), "CMAKE_PREFIX_PATH": str(prefix),
        "PKG_CONFIG_PATH": str(library / "pkgconfig")}


def make_tables(work, environment):
    tables = work / "tables"
    (tables / "merl").mkdir(parents=True)
    for name, material in (("gold-paint", "builtin:two-layer"), ("merl/chrome", "builtin:conductor"),
                           ("merl/brass", "analytic:ggx,alpha=0.2,f0=0.9/0.6/0.5")):
        call(["slopemix", "synth", material, "--out", f"{name}.binary"], tables, environment, "synth")
    return tables


def folder_of(page, work, tables):
    """The page's folder: the tables, and `build/slopemix` for pages that are about the source tree."""
    folder = work / str(page).replace("/", "-")
    if not folder.exists():
        shutil.copytree(tables, folder, copy_function=os.link)
        (folder / "build").mkdir()
        os.symlink(work / "bin" / "slopemix", folder / "build" / "slopemix")
    return folder


def run_part(block, folder, environment):
    """The block stands in a program, indentation apart; the program is compiled and run."""
    path = SOURCE / block.value
    wanted = [line.strip() for line in block.text.splitlines()]
    lines = [line.strip() for line in path.read_text().splitlines()]
    if not any(lines[k:k + len(wanted)] == wanted for k in range(len(lines))):
        raise Failed(f"{block}: {block.value} does not have these lines")
    call([*C, str(path), f"-I{path.parent}", *flags(environment), "-o", "part"], folder, environment, str(block))
    call(["./part"], folder, environment, f"{block}: {block.value}")


def flags(environment):
    return subprocess.run(["pkg-config", "--cflags", "--libs", "slopemix"], env=environment, stdout=subprocess.PIPE,
                          text=True, check=True).stdout.split() + ["-lOpenCL", "-lm"]


def run(block, folder, environment):
    if block.kind == "part of":
        run_part(block, folder, environment)
    elif block.kind == "file":
        (folder / block.value).write_text(block.text)
        if block.language == "c":
            call([*C, "-c", block.value, "-o", "/dev/null", *flags(environment)], folder, environment, str(block))
    else:
        call(["bash", "-euo", "pipefail", "-c", block.text], folder, environment, str(block))


def pages():
    return [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", SOURCE / "examples/README.md",
            *sorted((SOURCE / "docs").glob("*.md"))]


def main(arguments):
    slow, only = "--slow" in arguments, [a for a in arguments if a != "--slow"]
    counts, failures = collections.Counter(), []
    with tempfile.TemporaryDirectory() as temporary:
        work = pathlib.Path(temporary)
        environment = installed(work)
        tables = make_tables(work, environment)
        for page in pages():
            name = page.relative_to(SOURCE)
            if only and str(name) not in only:
                continue
            failures += [f"{name}: the link '{target}' leads nowhere" for target in broken_links(page)]
            try:
                visit(blocks_of(page, name), slow, folder_of(name, work, tables), environment, counts)
            except (Failed, Malformed) as failure:
                failures.append(str(failure))
    for failure in failures:
        print(f"run_docs: {failure}", file=sys.stderr)
    print(", ".join([f"{count} {what}" for what, count in sorted(counts.items())] + [f"{len(failures)} failures"]))
    return 1 if failures or not counts["run"] else 0


def visit(blocks, slow, folder, environment, counts):
    """Runs a page's blocks; in the slow entry only pages that have a slow one, whole."""
    if slow and not any(block.kind == "slow" for block in blocks):
        return
    for block in blocks:
        if block.kind == "" and block.language in ("text", "csv"):
            counts["shown"] += 1
        elif block.kind == "not run" or (block.kind == "slow" and not slow):
            print(f"{block}: {block.kind}: {block.value}")
            counts[block.kind] += 1
        else:
            run(block, folder, environment)
            counts["run"] += 1


sys.exit(main(sys.argv[1:]))

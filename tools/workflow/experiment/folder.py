"""The experiment's folder: one run at a time, its settings, its list of materials."""
import fcntl
import json
import os
import pathlib
import subprocess


class Refused(Exception):
    """What keeps the experiment from running, for whoever started it."""


def lock(out):
    """A lock on the folder, kept by this process and those that inherit it. It goes with the last of them."""
    out.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(out / ".experiment.lock", os.O_RDWR | os.O_CREAT, 0o644)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise Refused(f"{out} is in use by another run; wait for its end, or name another folder") from None
    return descriptor


def write_if_changed(path, text):
    """Whole or not at all; a file that says the same already keeps its time, and nothing is made anew for it."""
    if path.exists() and path.read_text() == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.part")
    temporary.write_text(text)
    temporary.replace(path)


def call(slopemix, *arguments):
    done = subprocess.run([slopemix, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode:
        raise Refused(f"{' '.join(map(str, arguments))}: {done.stderr.strip() or done.returncode}")
    return done.stdout


def link_tables(merl, out):
    """OUT/tables is the folder of tables: results name it, and not where it is on this machine."""
    link, target = out / "tables", merl.resolve()
    if link.is_symlink() and link.resolve() == target:
        return link.name
    if link.exists() and not link.is_symlink():
        raise Refused(f"{link} is in the way: it should become a link to {target}")
    link.unlink(missing_ok=True)
    link.symlink_to(target)
    return link.name


def materials(slopemix, merl, out):
    """The catalogue with what the folder of tables has of it, also in OUT/materials.json."""
    text = call(slopemix, "materials", merl, "--json")
    write_if_changed(out / "materials.json", text)
    return json.loads(text)


def chosen(listed, only, what):
    """The names of the materials that have tables, of those that are wanted."""
    known = {material["name"] for material in listed}
    unknown = sorted(set(only or []) - known)
    if unknown:
        raise Refused(f"{what}: no material is called {', '.join(unknown)}; `slopemix materials` lists them")
    return [material["name"] for material in listed if material["present"] and (not only or material["name"] in only)]


def drop_pages(out, keep):
    """Pages of other materials than these, which an earlier run made, are not in the gallery any more."""
    for page in (out / "gallery").glob("*.html"):
        if page.stem not in {*keep, "index", "summary"}:
            page.unlink()


def program(path):
    found = pathlib.Path(path).resolve()
    if not os.access(found, os.X_OK):
        raise Refused(f"there is no program {path}; build it, or let SLOPEMIX name it")
    return found

"""Files that are whole or not there, and the metrics of the materials."""
import json
import os
import pathlib


def write_text(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    temporary.write_text(text)
    temporary.replace(path)


def read_json(path):
    return json.loads(pathlib.Path(path).read_text())


def names_of(out, only):
    """The materials that are asked for, or all that were measured."""
    return only or sorted(file.stem for file in (out / "metrics").glob("*.json"))


def read_metrics(out, only=None):
    """By material, what summary.measure wrote."""
    return {name: read_json(out / "metrics" / f"{name}.json") for name in names_of(out, only)}

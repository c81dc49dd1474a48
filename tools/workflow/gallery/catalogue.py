"""The materials of an experiment, from OUT/materials.json: in the catalogue's order, then those without a number."""

import json
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Material:
    number: int | None
    name: str
    kind: str
    has_table: bool


def read_materials(out: Path) -> list[Material]:
    """Of the catalogue; or, where there is none, those that have a sheet."""
    path = out / "materials.json"
    if not path.is_file():
        return [Material(None, sheet.parent.name, "other", True) for sheet in sorted(out.glob("sheets/*/sheet.json"))]
    materials = [to_material(item) for item in json.loads(path.read_text())]
    return sorted(materials, key=lambda material: (material.number is None, material.number, material.name))


def to_material(item: dict) -> Material:
    return Material(item["number"], item["name"], item["kind"], item["present"])

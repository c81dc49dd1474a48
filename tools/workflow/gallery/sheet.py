"""A material's sheet, from OUT/sheets/NAME/sheet.json: images in tables, rows and columns, and the fits they show."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

LIGHTS = {90.0: "at the camera", 0.0: "right", -25.0: "right, behind"}
TABLES = {
    1: ("isotropic", "α_x = α_y = r"),
    2: ("latitudinal", "α_x = r, α_y = 0"),
    3: ("longitudinal", "α_x = 0, α_y = r"),
}


@dataclass(frozen=True)
class Fit:
    model: str
    lobes: int
    order: int | str  # of the widening, or "auto"

    @property
    def key(self) -> str:
        return f"{self.model}-{self.lobes}" + (f"-order-{self.order}" if self.order else "")

    @property
    def label(self) -> str:
        model = "per-lobe, " if self.model == "per-lobe" else ""
        return f"{model}N = {self.lobes}" + (f", order {self.order}" if self.order else "")


@dataclass(frozen=True)
class SheetImage:
    id: str
    entry: dict  # as sheet.json has it
    flip: float | None  # mean FLIP against the reference, where it was measured

    @property
    def table(self) -> int:
        return int(self.id.split(".")[0])

    @property
    def row(self) -> int:
        return int(self.id.split(".")[1])

    @property
    def column(self) -> int:
        return int(self.id.split(".")[2])

    @property
    def light(self) -> float | None:
        return self.entry["light_phi_deg"]

    @property
    def fit(self) -> Fit | None:
        entry = self.entry
        if entry["integrator"] != "filtered":
            return None
        return Fit(entry["model"], entry["lobes"], entry["widening_order"])

    @property
    def shows(self) -> str:
        """What the image is of: geometry, reference, or a fit's key."""
        return self.fit.key if self.fit else self.entry["integrator"]

    @property
    def radius(self) -> float:
        return max(self.entry["alpha_x"], self.entry["alpha_y"])


class Sheet:
    def __init__(self, out: Path, name: str):
        self.folder = out / "sheets" / name
        self.document = json.loads((self.folder / "sheet.json").read_text())
        flips = read_flips(out, name)
        self.images = {
            entry["id"]: SheetImage(entry["id"], entry, flips.get(entry["id"])) for entry in self.document["images"]
        }

    @cached_property
    def fits(self) -> list[Fit]:
        found = {image.fit for image in self.images.values() if image.fit}
        return sorted(found, key=lambda fit: (fit.model != "shared", fit.lobes, str(fit.order)))

    @cached_property
    def columns(self) -> list[SheetImage]:
        """An image of each column, which stands for its light and its fit."""
        by_column = {image.column: image for image in self.images.values()}
        return [by_column[column] for column in sorted(by_column)]

    @cached_property
    def lights(self) -> list[float]:
        return list(dict.fromkeys(image.light for image in self.columns if image.light is not None))

    @cached_property
    def exposures(self) -> dict[float, float]:
        return {item["light_phi_deg"]: item["exposure"] for item in self.document["exposures"]}

    def at(self, table: int, row: int, column: int) -> SheetImage | None:
        return self.images.get(f"{table}.{row}.{column}")

    def rows(self, table: int) -> list[int]:
        return sorted({image.row for image in self.images.values() if image.table == table})

    def radius(self, table: int, row: int) -> float:
        return next(image.radius for image in self.images.values() if (image.table, image.row) == (table, row))

    def of_fit(self, fit: Fit) -> list[SheetImage]:
        return [image for image in self.images.values() if image.fit == fit]


def read_flips(out: Path, name: str) -> dict[str, float]:
    path = out / "metrics" / f"{name}.json"
    if not path.is_file():
        return {}
    return {image["id"]: image["flip"] for image in json.loads(path.read_text())["images"]}


def light_label(light: float) -> str:
    return f"φ = {light:g}°".replace("-", "−")


def light_name(light: float) -> str:
    return f"light {light_label(light)}" + (f" ({LIGHTS[light]})" if light in LIGHTS else "")

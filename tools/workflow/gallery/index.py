"""The index: every material with thumbnails and errors, and those of the catalogue that have no page."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from .assets import write_assets
from .catalogue import Material
from .errors import FitErrors, fit_errors
from .files import write_text
from .sheet import Fit, Sheet, SheetImage
from .templates import render

THUMBNAIL_LIGHT = 0.0


@dataclass(frozen=True)
class IndexEntry:
    material: Material
    sheet: Sheet

    @cached_property
    def errors(self) -> dict[str, FitErrors]:
        return {error.fit.key: error for error in fit_errors(self.sheet)}

    @cached_property
    def thumbnails(self) -> list[SheetImage]:
        """Reference and fits of the middle isotropic roughness, lit from the right where there is such a light."""
        rows = self.sheet.rows(1)
        lights = self.sheet.lights
        light = THUMBNAIL_LIGHT if THUMBNAIL_LIGHT in lights else lights[0] if lights else None
        row = rows[len(rows) // 2] if rows else None
        found = [
            image for image in self.sheet.images.values() if (image.table, image.row, image.light) == (1, row, light)
        ]
        order = ["reference", *(fit.key for fit in self.sheet.fits)]
        return sorted(found, key=lambda image: order.index(image.shows))


def write_index(out: Path, to: Path, materials: list[Material], pdf: bool) -> None:
    """Of the pages that are in the folder `to`; `pdf`: there is, or will be, one to link to."""
    entries = [IndexEntry(material, Sheet(out, material.name)) for material in materials if has_page(to, material.name)]
    absent = [material for material in materials if not has_page(to, material.name)]
    fits = sorted({fit for entry in entries for fit in entry.sheet.fits}, key=in_order)
    flips = any(error.flip is not None for entry in entries for error in entry.errors.values())
    kinds = sorted({material.kind for material in materials})
    write_text(
        to / "index.html",
        render("index.html", entries=entries, absent=absent, fits=fits, flips=flips, kinds=kinds, pdf=pdf),
    )
    write_assets(to)


def has_page(to: Path, name: str) -> bool:
    return (to / f"{name}.html").is_file()


def in_order(fit: Fit) -> tuple:
    return fit.model != "shared", fit.lobes, str(fit.order)

"""The files of a sheet's images: a PNG of each, and a script per row of a table with the linear data.

The scripts are classic ones, since pages opened from a file may neither fetch nor import.
"""

import base64
import json
from pathlib import Path

from .files import write_bytes, write_text
from .image import Exr, bright_value, exposure_for, png, read_exr, small_exr
from .sheet import Sheet, SheetImage


def write_pixels(sheet: Sheet, name: str, to: Path) -> dict[str, float]:
    """Writes images/NAME/T.R.C.png and data/NAME/T.R.js. Returns the exposure of each image by its id."""
    read = {id: read_exr(sheet.folder / f"{id}.exr") for id in sheet.images}
    exposures = {id: exposure_of(sheet, image, read) for id, image in sheet.images.items()}
    for id, exr in read.items():
        write_bytes(to / "images" / name / f"{id}.png", png(exr.rgba, exposures[id]))
    for row in row_keys(sheet):
        write_text(to / "data" / name / f"{row}.js", row_script(row, {id: read[id] for id in ids_of_row(sheet, row)}))
    return exposures


def exposure_of(sheet: Sheet, image: SheetImage, read: dict[str, Exr]) -> float:
    """That of its light; of pictures of the geometry, one for all."""
    if image.light is not None:
        return sheet.exposures.get(image.light, 1.0)
    unlit = [read[other.id].rgba for other in sheet.images.values() if other.light is None]
    return exposure_for(max(map(bright_value, unlit)))


def row_keys(sheet: Sheet) -> list[str]:
    return [f"{table}.{row}" for table in (1, 2, 3) for row in sheet.rows(table)]


def ids_of_row(sheet: Sheet, row: str) -> list[str]:
    images = [image for image in sheet.images.values() if f"{image.table}.{image.row}" == row]
    return [image.id for image in sorted(images, key=lambda image: image.column)]


def row_script(row: str, images: dict[str, Exr]) -> str:
    files = {id: base64.b64encode(small_exr(exr)).decode() for id, exr in images.items()}
    return f"gallery.pixels.receive({json.dumps(row)}, {json.dumps(files, indent=0)});\n"

"""A material's page: NAME.html, its images, its linear data, its fits and the files to take away."""

import json
from pathlib import Path

from .assets import write_assets
from .catalogue import Material
from .errors import fit_errors
from .files import copy_file, write_text
from .lobes import MaterialFit, read_fits
from .pixels import row_keys, write_pixels
from .plots import copy_plot
from .sheet import TABLES, Sheet, light_label, light_name
from .templates import render

BUDGET_PARTS = {"shared": ("inversion", "fit", "widening", "total"), "per-lobe": ("fit", "widening", "total")}
PAPER_IMAGE = 19.6  # millimetres
PAPER_TABLE = 255.0  # the images of a row


def write_page(out: Path, to: Path, material: Material) -> None:
    """Raises an OSError where the sheet is not whole."""
    sheet = Sheet(out, material.name)
    exposures = write_pixels(sheet, material.name, to)
    fits = read_fits(out, material.name)
    copy_file(sheet.folder / "sheet.json", to / "data" / material.name / "sheet.json")
    page = render(
        "material.html",
        material=material,
        sheet=sheet,
        tables=TABLES,
        groups=column_groups(sheet),
        sizes=image_sizes(sheet.document["resolution"][0], len(sheet.columns)),
        errors=fit_errors(sheet),
        fits=[(fit, *copy_fit(fit, material.name, to)) for fit in fits],
        **budget_values(out / "budget" / f"{material.name}.json"),
        tradeoff=copy_tradeoff(out, material.name, to),
        data=viewer_data(sheet, material, exposures),
        light_label=light_label,
    )
    write_text(to / f"{material.name}.html", page)
    write_assets(to)


def column_groups(sheet: Sheet) -> list[tuple[str, list[tuple[int, str]]]]:
    """Headings as on the contact sheet: groups of columns, and of each the (column, heading) pairs."""
    groups: dict[str, list[tuple[int, str]]] = {}
    for image in sheet.columns:
        if image.light is None:
            group, heading = "", image.shows
        elif image.fit and image.fit.model == "per-lobe":
            group, heading = image.fit.label, light_label(image.light)
        else:
            group, heading = light_name(image.light), image.fit.label if image.fit else image.shows
        groups.setdefault(group, []).append((image.column, heading))
    return list(groups.items())


def image_sizes(width: int, columns: int) -> dict[str, float]:
    """Widths in CSS pixels, on narrow, middling and wide windows: whole multiples of small images' pixels. On paper, in
    millimetres, what leaves room for the figures beside the tables."""
    paper = {"paper": round(min(PAPER_IMAGE, PAPER_TABLE / columns), 2)}
    if width > 72:
        return {"narrow": 72, "middle": min(width, 88), "wide": min(width, 128)} | paper
    return {"narrow": width * (72 // width), "middle": width * (88 // width), "wide": width * (128 // width)} | paper


def viewer_data(sheet: Sheet, material: Material, exposures: dict[str, float]) -> str:
    """What the viewer's scripts need to know, as JSON that may stand in a script element."""
    fits = [{"key": "reference", "label": "reference"}, *({"key": fit.key, "label": fit.label} for fit in sheet.fits)]
    if any(image.light is None for image in sheet.images.values()):
        fits.append({"key": "geometry", "label": "geometry"})
    images = [
        {"shows": image.shows, "row": f"{image.table}.{image.row}", "exposure": exposures[image.id], "flip": image.flip}
        | image.entry
        for image in sheet.images.values()
    ]
    document = {
        "material": material.name,
        "shows": fits,
        "lights": [{"key": light, "label": light_label(light)} for light in sheet.lights],
        "rows": [{"key": row, "label": row_label(sheet, row)} for row in row_keys(sheet)],
        "images": images,
    }
    return json.dumps(document, separators=(",", ":")).replace("<", "\\u003c")


def row_label(sheet: Sheet, key: str) -> str:
    table, row = map(int, key.split("."))
    return f"{key}: {TABLES[table][0]}, r = {sheet.radius(table, row):g}"


def copy_fit(fit: MaterialFit, name: str, to: Path) -> tuple[str, str | None]:
    """Paths in the gallery of the material file and, if there is one, of the plot."""
    file = f"data/{name}/{fit.key}.json"
    write_text(to / file, json.dumps(fit.document, separators=(",", ":"), ensure_ascii=False) + "\n")
    if fit.plot is None:
        return file, None
    plot = f"images/{name}/{fit.key}.svg"
    copy_plot(fit.plot, to / plot)
    return file, plot


def copy_tradeoff(out: Path, name: str, to: Path) -> dict[str, str] | None:
    """Paths in the gallery of the plot of accuracy against time and of its figures."""
    folder = out / "tradeoff" / name
    if not (folder / "tradeoff.svg").is_file():
        return None
    files = {"plot": f"images/{name}/tradeoff.svg"}
    copy_plot(folder / "tradeoff.svg", to / files["plot"])
    if (folder / "tradeoff.json").is_file():
        files["figures"] = f"data/{name}/tradeoff.json"
        copy_file(folder / "tradeoff.json", to / files["figures"])
    return files


def budget_values(path: Path) -> dict:
    """The split of the error, a row per roughness and in it both models' parts; without one, None."""
    budget = read_json(path)
    rows: dict[tuple[float, float], dict[str, dict]] = {}
    for row in budget["rows"] if budget else []:
        rows.setdefault((row["alpha_x"], row["alpha_y"]), {})[row["model"]] = row
    return {"budget": budget, "budget_models": BUDGET_PARTS, "budget_rows": list(rows.items())}


def read_json(path: Path) -> dict | None:
    return json.loads(path.read_text()) if path.is_file() else None

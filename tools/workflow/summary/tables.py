"""summary.csv, a row per material, and images.csv, a row per filtered image."""
import csv
import io

from .files import write_text
from .statistics import MEASURES, grouped, material_means, sorted_by_fit

IMAGE_COLUMNS = ("material", "kind", "id", "model", "lobes", "widening_order", "alpha_x", "alpha_y", "light_phi_deg",
                 "relrmse", "flip")


def write_csv(path, head, rows):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows(rows)
    write_text(path, text.getvalue())


def cell(value):
    return f"{value:.6g}" if isinstance(value, float) else value


def write_materials(path, rows):
    """Means over a material's images, a column per measure and fit."""
    fits = grouped(sorted_by_fit(rows), lambda row: row["fit"])
    columns = [(f"{measure} {fit}", material_means(of_fit, measure)) for measure in MEASURES
               for fit, of_fit in fits.items()]
    kinds = {row["material"]: row["kind"] for row in rows}
    write_csv(path, ["material", "kind", *(head for head, _ in columns)],
              ([name, kind, *(cell(means[name]) for _, means in columns)] for name, kind in sorted(kinds.items())))


def write_images(path, rows):
    write_csv(path, IMAGE_COLUMNS, ([cell(row[key]) for key in IMAGE_COLUMNS] for row in rows))

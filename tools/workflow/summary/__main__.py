"""Writes OUT/gallery/summary.json, summary.csv, images.csv and charts/, of OUT/metrics, OUT/budget and OUT/times.

    python -m summary OUT [--only NAME,...]
"""
import argparse
import json
import pathlib

from .charts import write_charts
from .cost import extrapolation, time_of
from .files import read_json, read_metrics, write_text
from .reason import worst_entry
from .statistics import TABLES, best_fit, by, by_fit, rows_of, worst_materials
from .tables import write_images, write_materials


def budget_of(out, name):
    file = out / "budget" / f"{name}.json"
    return read_json(file) if file.exists() else None


def summary(out, metrics, rows, settings):
    first = next(iter(metrics.values()))
    return {
        "schema": 1, "version": settings["version"], "materials": len(metrics), "resolution": first["resolution"],
        "settings": {key: settings[key] for key in ("spp", "target_error", "seed", "radii", "lobes", "widening_order")},
        "pixels_per_degree": first["pixels_per_degree"],
        "models": by_fit(rows),
        "by_kind": by(rows, lambda row: row["kind"], lambda kind: {"kind": kind}),
        "by_roughness": by(rows, lambda row: (row["table"], row["radius"]),
                           lambda key: {"roughness": TABLES[key[0]], "radius": key[1]}),
        "by_light": by(rows, lambda row: -row["light_phi_deg"], lambda light: {"light_phi_deg": -light}),
        "worst_fit": best_fit(rows),
        "worst": [worst_entry(name, error, budget_of(out, name))
                  for name, error in worst_materials(rows, settings["worst"])],
        "time": time_of(out), "extrapolation": extrapolation(metrics, settings["threads"])}


def main():
    parser = argparse.ArgumentParser(prog="python -m summary")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--only", type=lambda text: text.split(","))
    arguments = parser.parse_args()
    out, gallery = arguments.out, arguments.out / "gallery"
    metrics = read_metrics(out, arguments.only)
    kinds = {material["name"]: material["kind"] for material in read_json(out / "materials.json")}
    rows = rows_of(metrics, kinds)
    write_materials(gallery / "summary.csv", rows)
    write_images(gallery / "images.csv", rows)
    charts = write_charts(gallery / "charts", rows)
    document = summary(out, metrics, rows, read_json(out / "settings.json")) | {"charts": charts}
    write_text(gallery / "summary.json", json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    main()

"""Distributions over materials, and what they are grouped by.

A row is one filtered image: material, kind, fit, table and radius of its roughness, light, relrmse, flip. A material's
value under a fit is the mean over its images; a distribution is that of these values over the materials.
"""
import statistics

MEASURES = ("relrmse", "flip")
TABLES = {1: "isotropic", 2: "latitudinal", 3: "longitudinal"}
UNKNOWN_KIND = "other"


def fit_name(model, lobes, order):
    """shared N = 8; per-lobe N = 8, order 3."""
    return f"{model} N = {lobes}" + ("" if order in (0, None) else f", order {order}")


def rows_of(metrics, kinds):
    """A row per filtered image of all materials."""
    rows = []
    for name, document in metrics.items():
        for image in document["images"]:
            if image["relrmse"] is None:  # its reference is black
                continue
            table = int(image["id"].split(".")[0])
            rows.append(image | {
                "material": name, "kind": kinds.get(name) or UNKNOWN_KIND, "table": table,
                "roughness": TABLES[table], "radius": max(image["alpha_x"], image["alpha_y"]),
                "fit": fit_name(image["model"], image["lobes"], image["widening_order"])})
    return rows


def percentile(values, share):
    """The value of that rank among the sorted values, the nearest."""
    return sorted(values)[round(share * (len(values) - 1))]


def distribution(values):
    return {"median": statistics.median(values), "mean": statistics.fmean(values), "p90": percentile(values, 0.9),
            "worst": max(values)}


def grouped(rows, key):
    """The rows by a key's values, in the order of their first appearance."""
    groups = {}
    for row in rows:
        groups.setdefault(key(row), []).append(row)
    return groups


def material_means(rows, measure):
    """By material, the mean over its images."""
    return {name: statistics.fmean(row[measure] for row in images)
            for name, images in grouped(rows, lambda row: row["material"]).items()}


def described(rows):
    """Both measures' distributions over the materials of these rows, and who is worst."""
    means = {measure: material_means(rows, measure) for measure in MEASURES}
    return {"materials": len(means["relrmse"])} | {
        measure: distribution(of.values()) | {"worst_material": max(of, key=of.get)} for measure, of in means.items()}


def by_fit(rows, **of):
    """An entry per fit, in the order of the sheet's columns; `of` says what the rows have in common."""
    return [of | {"fit": fit} | described(of_fit)
            for fit, of_fit in grouped(sorted_by_fit(rows), lambda row: row["fit"]).items()]


def sorted_by_fit(rows):
    return sorted(rows, key=lambda row: (row["model"] != "shared", row["lobes"], str(row["widening_order"])))


def by(rows, key, describe):
    """An entry per value of a key, in its order, and fit."""
    return [entry for value, group in sorted(grouped(rows, key).items()) for entry in by_fit(group, **describe(value))]


def best_fit(rows):
    """The document's most exact: the per-lobe model in closed form, or what comes nearest to it."""
    fits = sorted_by_fit(rows)
    closed = [row["fit"] for row in fits if row["model"] == "per-lobe" and row["widening_order"] == 0]
    return (closed or [fits[-1]["fit"]])[-1]


def worst_materials(rows, count):
    """The materials of largest mean relRMSE under that fit, worst first, with the mean."""
    fit = best_fit(rows)
    means = material_means([row for row in rows if row["fit"] == fit], "relrmse")
    return sorted(means.items(), key=lambda item: (-item[1], item[0]))[:count]

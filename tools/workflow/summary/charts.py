"""The summary's charts, SVG by matplotlib: on a transparent ground, in colours that read on light and on dark pages."""
import io

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot, ticker

from .files import write_text
from .statistics import TABLES, grouped, material_means, sorted_by_fit

TITLES = {"relrmse": "relRMSE", "flip": "FLIP"}
INK = "#76797d"  # contrast of 4.4 against white, and of 4.3 against #0d1117
COLOURS = ("#d2691e", "#2f81c4", "#3a9d5d", "#a371d9", "#c2528b", "#8a8f2a", "#1f9aa0", "#b8860b")
STYLE = {"svg.hashsalt": "slopemix", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10,
         "text.color": INK, "axes.edgecolor": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK,
         "grid.color": INK, "grid.alpha": 0.3, "axes.grid": True, "axes.spines.top": False, "axes.spines.right": False,
         "axes.axisbelow": True, "legend.frameon": False}


def save(figure, path):
    text = io.StringIO()
    figure.savefig(text, format="svg", transparent=True, bbox_inches="tight", metadata={"Date": None})
    pyplot.close(figure)
    write_text(path, text.getvalue())


def fits_of(rows):
    """The rows of each fit, and its colour."""
    fits = grouped(sorted_by_fit(rows), lambda row: row["fit"])
    return [(fit, of_fit, COLOURS[at % len(COLOURS)]) for at, (fit, of_fit) in enumerate(fits.items())]


def sorted_curves(rows, measure):
    """Each fit's materials from best to worst: height against share."""
    figure, axes = pyplot.subplots(figsize=(8, 4))
    for fit, of_fit, colour in fits_of(rows):
        values = sorted(material_means(of_fit, measure).values())
        shares = [100 * (at + 0.5) / len(values) for at in range(len(values))]
        axes.plot(shares, values, color=colour, label=fit, marker="o", markersize=3, linewidth=1.2)
    axes.set(xlabel="share of the materials, %", xlim=(0, 100))
    finish(axes, measure)
    return figure


def strips(rows, measure, key, labels):
    """For each value of a key a box per fit over the materials' means, with every material as a dot."""
    groups, fits = grouped(rows, key), fits_of(rows)
    values = [value for value in labels if value in groups]
    figure, axes = pyplot.subplots(figsize=(8, 4))
    width = 0.8 / len(fits)
    for at, (fit, of_fit, colour) in enumerate(fits):
        of_value = grouped(of_fit, key)
        for place, value in enumerate(values):
            means = list(material_means(of_value[value], measure).values())
            x = place + (at + 0.5) * width - 0.4
            box(axes, means, x, 0.7 * width, colour)
        axes.plot([], [], color=colour, marker="s", linestyle="", label=fit)
    turned = {"rotation": 30, "ha": "right", "rotation_mode": "anchor"} if len(values) > 5 else {}
    axes.set_xticks(range(len(values)), [labels[value] for value in values], **turned)
    axes.grid(visible=False, axis="x")
    finish(axes, measure)
    return figure


def finish(axes, measure):
    """Errors of a hundredth and of one are both legible on a logarithmic axis; the legend hides none of them."""
    axes.set(ylabel=f"{TITLES[measure]}, mean of a material", yscale="log")
    axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axes.yaxis.set_minor_locator(ticker.NullLocator())
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3, borderaxespad=0.2, columnspacing=1.2)


def box(axes, values, x, width, colour):
    """Quartiles and whiskers to the ends, and the values themselves."""
    line = {"color": colour, "linewidth": 1.2}
    axes.boxplot([values], positions=[x], widths=width, whis=(0, 100), boxprops=line, whiskerprops=line, capprops=line,
                 medianprops=line | {"linewidth": 2}, manage_ticks=False)
    axes.plot([x] * len(values), values, linestyle="", marker="o", markersize=2, color=colour, alpha=0.6)


def roughness_labels(rows):
    keys = sorted({(row["table"], row["radius"]) for row in rows})
    return {key: f"{TABLES[key[0]]} {key[1]:g}" for key in keys}


def write_charts(folder, rows):
    """folder/MEASURE-GROUPING.svg; returns their names."""
    kinds = {kind: kind for kind in sorted({row["kind"] for row in rows})}
    lights = {light: f"{light:g} degrees" for light in sorted({row["light_phi_deg"] for row in rows}, reverse=True)}
    written = []
    with matplotlib.rc_context(STYLE):
        for measure in TITLES:
            charts = {
                "materials": sorted_curves(rows, measure),
                "kind": strips(rows, measure, lambda row: row["kind"], kinds),
                "roughness": strips(rows, measure, lambda row: (row["table"], row["radius"]), roughness_labels(rows)),
                "light": strips(rows, measure, lambda row: row["light_phi_deg"], lights)}
            for name, figure in charts.items():
                save(figure, folder / f"{measure}-{name}.svg")
                written.append(f"charts/{measure}-{name}.svg")
    return written

"""The summary over the materials, as a page: summary.html, of gallery/summary.json and gallery/charts/*.svg.

Every list of rows in summary.json becomes a table, every object a table of one column of figures. A row's member that
is itself an object becomes a group of columns.
"""

from dataclasses import dataclass
from pathlib import Path

from .assets import write_assets
from .catalogue import Material
from .files import copy_file, write_text
from .index import has_page
from .page import read_json
from .templates import MINUS, figures, number, render

HEADINGS = {
    "models": "Errors over the materials",
    "worst": "The worst materials",
    "by_kind": "By kind of material",
    "by_roughness": "By roughness",
    "by_light": "By light",
    "time": "Time and cost",
    "extrapolation": "The full protocol, extrapolated",
}
CHARTS = {
    "models": "materials",
    "by_kind": "kind",
    "by_roughness": "roughness",
    "by_light": "light",
}  # charts/*-LAST.svg
UNTOLD = ("schema", "charts")
WORDS = {
    "relrmse": "relRMSE",
    "flip": "FLIP",
    "p90": "90th percentile",
    "cpu": "CPU",
    "phi": "φ",
    "deg": "in degrees",
    "rss": "memory",
    "mb": "in MB",
}
LONG = 12  # rows of a table that is folded away


@dataclass(frozen=True)
class Column:
    group: str
    name: str
    path: tuple[str, ...]

    def value_in(self, row: dict):
        for key in self.path:
            row = (row or {}).get(key)
        return row


@dataclass(frozen=True)
class Table:
    key: str
    heading: str
    columns: list[Column]
    rows: list[dict]
    charts: list[str]

    @property
    def is_long(self) -> bool:
        return len(self.rows) > LONG

    @property
    def groups(self) -> list[tuple[str, int]]:
        """Headings over the columns, and how many columns each has."""
        groups: list[tuple[str, int]] = []
        for column in self.columns:
            if groups and column.group and groups[-1][0] == column.group:
                groups[-1] = (column.group, groups[-1][1] + 1)
            else:
                groups.append((column.group, 1))
        return groups


def write_summary(out: Path, to: Path, materials: list[Material]) -> None:
    source = out / "gallery"
    summary = read_json(source / "summary.json")
    charts = copy_extras(source, to)
    tables = tables_of(summary or {}, charts)
    shown = [chart for table in tables for chart in table.charts]
    pages = {material.name for material in materials if has_page(to, material.name)}
    page = render(
        "summary.html",
        tables=tables,
        facts=facts_of(summary or {}),
        present=summary is not None,
        other_charts=[chart for chart in charts if chart not in shown],
        files=[name for name in ("summary.csv", "images.csv", "summary.json") if (to / name).is_file()],
        pages=pages,
        show=show,
        is_number=is_number,
        in_words=in_words,
    )
    write_text(to / "summary.html", page)
    write_assets(to)


def copy_extras(source: Path, to: Path) -> list[str]:
    """Paths in the gallery of the charts, which another stage wrote beside the tables."""
    charts = sorted(source.glob("charts/*.svg"), key=lambda chart: ("flip" in chart.name, chart.name))
    if source.resolve() != to.resolve():
        for file in [*charts, *source.glob("summary.*"), *source.glob("images.csv")]:
            if file.suffix in (".svg", ".csv", ".json"):
                copy_file(file, to / file.relative_to(source))
    return [f"charts/{chart.name}" for chart in charts]


def tables_of(summary: dict, charts: list[str]) -> list[Table]:
    """Those with a heading of their own come first."""
    keys = [*(key for key in HEADINGS if key in summary), *(key for key in summary if key not in HEADINGS)]
    return [table_of(key, summary[key], charts) for key in keys if is_table(summary[key])]


def is_table(value) -> bool:
    return isinstance(value, dict) or (
        isinstance(value, list) and bool(value) and all(isinstance(row, dict) for row in value)
    )


def table_of(key: str, value: list | dict, charts: list[str]) -> Table:
    rows = (
        value if isinstance(value, list) else [{"figure": in_words(name), "value": item} for name, item in flat(value)]
    )
    columns = list(dict.fromkeys(column for row in rows for column in columns_of(row)))
    own = [chart for chart in charts if key in CHARTS and chart.endswith(f"-{CHARTS[key]}.svg")]
    return Table(key, HEADINGS.get(key, in_words(key).capitalize()), columns, rows, own)


def columns_of(row: dict) -> list[Column]:
    columns = []
    for key, value in row.items():
        if isinstance(value, dict):
            columns += [Column(in_words(key), in_words(inner), (key, inner)) for inner in value]
        else:
            columns.append(Column("", in_words(key), (key,)))
    return columns


def flat(value: dict, prefix: str = "") -> list[tuple[str, object]]:
    pairs = []
    for key, item in value.items():
        pairs += flat(item, f"{prefix}{key}_") if isinstance(item, dict) else [(prefix + key, item)]
    return pairs


def facts_of(summary: dict) -> list[tuple[str, str]]:
    return [(in_words(key), show(value)) for key, value in summary.items() if not is_table(value) and key not in UNTOLD]


def in_words(key: str) -> str:
    return " ".join(WORDS.get(word, word) for word in key.replace("-", "_").split("_"))


def is_number(value) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def show(value) -> str:
    if value is None:
        return "–"
    if isinstance(value, list):
        return ", ".join(map(show, value))
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    if isinstance(value, int) or value.is_integer():
        return f"{value:,.0f}".replace(",", "\u202f").replace("-", MINUS)
    if abs(value) >= 10000:
        return show(round(value))
    return number(value) if 0.001 <= abs(value) < 10 else figures(value, 4)

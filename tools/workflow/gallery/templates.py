"""The HTML templates, and how they write numbers."""

from pathlib import Path

import jinja2
from markupsafe import Markup

MINUS = "\u2212"


def number(value: float | None, digits: int = 3) -> str:
    """Fixed decimals; an en dash for what was not measured."""
    return "–" if value is None else f"{value:.{digits}f}".replace("-", MINUS)


def figures(value: float | None, digits: int = 3) -> str:
    """Significant figures."""
    return "–" if value is None else f"{value:.{digits}g}".replace("-", MINUS)


def symbols(text: str) -> Markup:
    """Markup of α_x: underlined subscripts become real ones."""
    escaped = str(jinja2.filters.escape(text))
    return Markup(escaped.replace("_x", "<sub>x</sub>").replace("_y", "<sub>y</sub>"))


def environment() -> jinja2.Environment:
    made = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters.update(number=number, figures=figures, symbols=symbols)
    return made


def render(template: str, **values) -> str:
    return environment().get_template(template).render(**values)

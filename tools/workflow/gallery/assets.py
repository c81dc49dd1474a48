"""What all pages share: style sheet, scripts, and the colour maps of the difference view."""

import json
from pathlib import Path

import matplotlib
import numpy

from .files import copy_file, write_text

SIGNED = "RdBu_r"  # white where there is no difference
ABSOLUTE = "magma"


def write_assets(to: Path) -> None:
    for source in sorted((Path(__file__).parent / "assets").iterdir()):
        copy_file(source, to / "assets" / source.name)
    maps = {"signed": colours(SIGNED), "absolute": colours(ABSOLUTE)}
    write_text(to / "assets" / "colours.js", f"gallery.colours = {json.dumps(maps, separators=(',', ':'))};\n")


def colours(name: str) -> list[list[int]]:
    """256 sRGB colours of a colour map, from its least to its greatest value."""
    rgba = matplotlib.colormaps[name](numpy.linspace(0.0, 1.0, 256), bytes=True)
    return rgba[:, :3].tolist()

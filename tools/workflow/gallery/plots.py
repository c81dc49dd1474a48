"""Plots are copied as SVG without what only their maker needs: half the bytes, the same picture."""

from pathlib import Path

from scour import scour

from .files import write_text

OPTIONS = scour.parse_args(["--quiet", "--set-precision=5", "--enable-comment-stripping", "--no-line-breaks"])


def copy_plot(source: Path, target: Path) -> None:
    write_text(target, scour.scourString(source.read_text(), OPTIONS))

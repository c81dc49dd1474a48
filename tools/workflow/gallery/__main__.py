"""Builds the gallery of an experiment's folder.

Without --page, --index, --summary or --pdf all of it is built, one after the other. A workflow calls the stages by
themselves: pages side by side, then the others. Parts of the folder that are not there are left out, and the pages
say so.
"""

import argparse
import sys
from pathlib import Path

from .catalogue import Material, read_materials


def main() -> int:
    arguments = parse_arguments()
    to = arguments.to or arguments.out / "gallery"
    try:
        materials = chosen(read_materials(arguments.out), arguments.only)
        if arguments.page:
            make_pages(arguments.out, to, chosen(materials, arguments.page))
        if arguments.index:
            make_index(arguments.out, to, materials, not arguments.no_pdf)
        if arguments.summary:
            make_summary(arguments.out, to, materials)
        if arguments.pdf:
            make_pdf(to, materials)
        if not (arguments.page or arguments.index or arguments.summary or arguments.pdf):
            make_all(arguments.out, to, materials, not arguments.no_pdf)
    except (OSError, ValueError) as error:
        print(f"gallery: {error}", file=sys.stderr)
        return 1
    return 0


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m gallery", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path, metavar="OUT", help="the experiment's folder")
    parser.add_argument("--to", type=Path, metavar="DIR", help="where the gallery goes (default OUT/gallery)")
    parser.add_argument("--only", type=names, metavar="NAME,...", help="only these materials")
    parser.add_argument("--page", type=names, metavar="NAME,...", help="build these materials' pages")
    parser.add_argument("--index", action="store_true", help="build index.html, of the pages that are there")
    parser.add_argument("--no-pdf", action="store_true", help="no gallery.pdf, and no link to it in the index")
    parser.add_argument("--summary", action="store_true", help="build summary.html, of OUT/gallery/summary.json")
    parser.add_argument("--pdf", action="store_true", help="print the pages that are there into gallery.pdf (chromium)")
    return parser.parse_args()


def names(text: str) -> list[str]:
    return [name for name in text.split(",") if name]


def chosen(materials: list[Material], wanted: list[str] | None) -> list[Material]:
    if wanted is None:
        return materials
    unknown = sorted(set(wanted) - {material.name for material in materials})
    if unknown:
        raise ValueError(f"no material is called {', '.join(unknown)}; materials.json lists {len(materials)} materials")
    return [material for material in materials if material.name in wanted]


def make_all(out: Path, to: Path, materials: list[Material], with_pdf: bool) -> None:
    from .pdf import chromium

    make_pages(
        out, to, [material for material in materials if (out / "sheets" / material.name / "sheet.json").is_file()]
    )
    make_index(out, to, materials, with_pdf)
    make_summary(out, to, materials)
    if with_pdf and chromium():
        make_pdf(to, materials)
    elif with_pdf:
        print("gallery: gallery.pdf is left out: no chromium on PATH (tools/setup --gallery)", file=sys.stderr)


# What a stage needs is imported by it alone: a workflow starts a process for each.


def make_pages(out: Path, to: Path, materials: list[Material]) -> None:
    from .page import write_page

    for material in materials:
        write_page(out, to, material)


def make_index(out: Path, to: Path, materials: list[Material], with_pdf: bool) -> None:
    from .index import write_index
    from .pdf import chromium

    write_index(out, to, materials, with_pdf and chromium() is not None)


def make_summary(out: Path, to: Path, materials: list[Material]) -> None:
    from .summary import write_summary

    write_summary(out, to, materials)


def make_pdf(to: Path, materials: list[Material]) -> None:
    from .pdf import write_pdf

    write_pdf(to, materials)


if __name__ == "__main__":
    sys.exit(main())

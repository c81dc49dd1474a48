"""gallery.pdf: index, summary and the materials' pages, printed by Chromium and bound with a bookmark each."""

import io
import shutil
from pathlib import Path

from playwright.sync_api import Page, sync_playwright
from pypdf import PdfReader, PdfWriter
from pypdf.annotations import Link

from .catalogue import Material
from .files import write_bytes
from .index import has_page

BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def chromium() -> str | None:
    return next(filter(None, map(shutil.which, BROWSERS)), None)


def write_pdf(to: Path, materials: list[Material]) -> None:
    """Of the pages that are in the folder. Raises an OSError where there is no Chromium."""
    browser = chromium()
    if not browser:
        raise OSError("there is no chromium on PATH to print with; tools/setup --gallery installs it")
    chapters = [
        ("Materials", "index"),
        ("Summary", "summary"),
        *((material.name, material.name) for material in materials),
    ]
    writer = PdfWriter()
    starts: dict[str, int] = {}
    with sync_playwright() as playwright:
        page = playwright.chromium.launch(executable_path=browser, args=["--no-sandbox"]).new_page()
        for title, name in chapters:
            if has_page(to, name):
                starts[f"{name}.html"] = len(writer.pages)
                bind(writer, title, print_page(page, to / f"{name}.html"))
    link(writer, starts)
    write_bytes(to / "gallery.pdf", finished(writer))


WHOLE = """() => {
    for (const details of document.querySelectorAll("details")) details.open = true;
    for (const image of document.images) image.loading = "eager";
    return Promise.all([...document.images].map((image) => image.decode()));
}"""


def print_page(page: Page, path: Path) -> bytes:
    page.goto(path.resolve().as_uri())
    page.evaluate(WHOLE)
    return page.pdf(prefer_css_page_size=True, print_background=True)


def bind(writer: PdfWriter, title: str, pdf: bytes) -> None:
    first = len(writer.pages)
    writer.append(PdfReader(io.BytesIO(pdf)), import_outline=False)
    writer.add_outline_item(title, first)


def link(writer: PdfWriter, starts: dict[str, int]) -> None:
    """Links to other pages of the gallery lead into the document; others, which name files of this machine, go."""
    for number, page in enumerate(writer.pages):
        annotations = [annotation.get_object() for annotation in page.pop("/Annots", [])]
        for annotation in annotations:
            target = Path(str(annotation.get("/A", {}).get("/URI", ""))).name
            if target in starts:
                writer.add_annotation(number, Link(rect=annotation["/Rect"], target_page_index=starts[target]))


def finished(writer: PdfWriter) -> bytes:
    """Without dates, so that the same pages make the same bytes; fonts that all pages have are kept once."""
    writer.metadata = {"/Title": "slopemix gallery", "/Producer": "slopemix"}
    writer.compress_identical_objects(remove_unreferenced=True)
    buffer = io.BytesIO()
    writer.write(buffer)
    return buffer.getvalue()

"""The gallery's files: EXR decoded in the browser, PNG as the command's, the same bytes again, the PDF, messages."""

import base64
import json
import shutil
import unittest

import numpy
from PIL import Image
from pypdf import PdfReader

from browser import BrowserCase
from experiment import BARE, BOTH, gallery, out, scratch, site, slopemix
from gallery.image import Exr, bright_value, display_pixels, exposure_for, read_exr, small_exr

DECODE = "async text => [...(await gallery.exr.decode(Uint8Array.from(atob(text), c => c.charCodeAt(0)))).rgba]"


def noise(height, width, largest):
    """Values of every size that half precision has, which hardly shrink."""
    random = numpy.random.default_rng(7)
    sizes = numpy.exp2(random.uniform(-24, numpy.log2(largest), (height, width, 4)))
    return Exr((sizes * random.choice([-1, 1], sizes.shape)).astype(numpy.float32), {"slopemix.version": "x"})


class Exrs(BrowserCase):
    def test_the_browser_reads_what_python_writes(self):
        page = self.open(f"{BOTH}.html")
        smooth = Exr(numpy.linspace(0, 2, 40 * 33 * 4, dtype=numpy.float32).reshape(40, 33, 4), {})
        black = Exr(numpy.zeros((16, 16, 4), numpy.float32), {})
        images = [smooth, black, *(noise(*size, 60000) for size in ((1, 1), (7, 5), (16, 1), (17, 93), (64, 3)))]
        for image in images:
            with self.subTest(image.rgba.shape):
                values = page.evaluate(DECODE, base64.b64encode(small_exr(image)).decode())
                numpy.testing.assert_array_equal(values, image.rgba.astype(numpy.float16).ravel())

    def test_values_that_half_precision_lacks_stay_float(self):
        page = self.open(f"{BOTH}.html")
        image = noise(9, 21, 1e6)
        self.assertGreater(image.rgba.max(), 65504)
        values = page.evaluate(DECODE, base64.b64encode(small_exr(image)).decode())
        numpy.testing.assert_array_equal(numpy.array(values, numpy.float32), image.rgba.ravel())

    def test_refuses_other_files(self):
        page = self.open(f"{BOTH}.html")
        for content, words in ((bytes(64), "not an EXR file"), (self.stored(), "compression 0")):
            text = base64.b64encode(content).decode()
            message = page.evaluate(
                "async text => { try { await (" + DECODE + ")(text); } catch (e) { return e.message; } }", text
            )
            self.assertIn(words, message)

    def stored(self):
        content = small_exr(noise(4, 4, 1))
        at = content.index(b"compression\0compression\0") + 24 + 4
        return content[:at] + b"\0" + content[at + 1 :]


class Pictures(unittest.TestCase):
    def test_png_is_what_the_command_writes(self):
        path = scratch() / "rendered.exr"
        slopemix(
            "render",
            f"builtin:{BOTH}",
            "--integrator",
            "filtered",
            "--alpha",
            "0.25,0.25",
            "--light",
            "90",
            "--res",
            "40",
            "--out",
            path,
            "--png",
        )
        rgba = read_exr(path).rgba
        pixels = display_pixels(rgba, exposure_for(bright_value(rgba)))
        numpy.testing.assert_array_equal(pixels, numpy.asarray(Image.open(path.with_suffix(".png")).convert("RGB")))

    def test_pages_have_the_pngs_of_their_sheet(self):
        document = json.loads((out() / "sheets" / BOTH / "sheet.json").read_text())
        exposures = {item["light_phi_deg"]: item["exposure"] for item in document["exposures"]}
        for image in document["images"]:
            if image["light_phi_deg"] is not None:
                wanted = display_pixels(
                    read_exr(out() / "sheets" / BOTH / f"{image['id']}.exr").rgba, exposures[image["light_phi_deg"]]
                )
                given = numpy.asarray(Image.open(site() / "images" / BOTH / f"{image['id']}.png"))
                numpy.testing.assert_array_equal(given, wanted, image["id"])


class Stages(unittest.TestCase):
    def test_stages_make_the_bytes_of_the_whole(self):
        to = scratch() / "again"
        for stage in (["--page", f"{BOTH},{BARE}"], ["--index"], ["--summary"], ["--pdf"]):
            done = gallery(out(), "--to", to, *stage)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        again, first = contents(to), contents(site())
        self.assertEqual(sorted(again), sorted(first))
        self.assertEqual([str(path) for path in first if again[path] != first[path]], [])

    def test_nothing_is_written_again(self):
        times = {path: path.stat().st_mtime_ns for path in site().rglob("*")}
        self.assertEqual(gallery(out(), "--page", f"{BOTH},{BARE}", "--index", "--summary").returncode, 0)
        self.assertEqual({path: path.stat().st_mtime_ns for path in site().rglob("*")}, times)

    def test_no_link_to_a_pdf_that_is_not_wanted(self):
        to, link = scratch() / "no-pdf", 'href="gallery.pdf"'
        self.assertEqual(gallery(out(), "--to", to, "--page", BARE, "--index", "--no-pdf").returncode, 0)
        self.assertNotIn(link, (to / "index.html").read_text())
        self.assertIn(link, (site() / "index.html").read_text())

    def test_only_some(self):
        to = scratch() / "some"
        self.assertEqual(gallery(out(), "--to", to, "--only", BARE, "--page", BARE, "--index").returncode, 0)
        self.assertEqual(sorted(path.name for path in to.glob("*.html")), [f"{BARE}.html", "index.html"])
        self.assertNotIn("brass", (to / "index.html").read_text())

    def test_a_folder_of_sheets_is_enough(self):
        bare = scratch() / "bare"
        shutil.copytree(out() / "sheets" / BARE, bare / "sheets" / BARE)
        self.assertEqual(gallery(bare, "--page", BARE, "--index", "--summary").returncode, 0)
        self.assertIn(BARE, (bare / "gallery" / "index.html").read_text())
        self.assertIn("no summary yet", (bare / "gallery" / "summary.html").read_text())

    def test_messages(self):
        for arguments, words in (
            (["--page", "gold"], "no material is called gold"),
            (["--page", "brass"], "sheet.json"),
        ):
            done = gallery(out(), *arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn(words, done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_a_damaged_image_is_named(self):
        bad = scratch() / "bad"
        shutil.copytree(out() / "sheets" / BARE, bad / "sheets" / BARE)
        (bad / "sheets" / BARE / "1.1.2.exr").write_bytes(b"no image")
        done = gallery(bad, "--page", BARE)
        self.assertEqual(done.returncode, 1)
        self.assertIn("1.1.2.exr", done.stderr)
        self.assertNotIn("Traceback", done.stderr)


class Pdf(unittest.TestCase):
    def test_a_leaf_a_material_with_a_bookmark(self):
        reader = PdfReader(site() / "gallery.pdf")
        bookmarks = [(item.title, reader.get_destination_page_number(item)) for item in reader.outline]
        self.assertEqual(bookmarks, [("Materials", 0), ("Summary", 1), (BARE, 2), (BOTH, 3)])
        self.assertEqual(len(reader.pages), 4)
        for name, at in bookmarks[2:]:
            text = reader.pages[at].extract_text()
            self.assertIn(name, text)
            self.assertIn("3.3.13", text)
        box = reader.pages[3].mediabox
        self.assertAlmostEqual(float(box.width) / 72 * 25.4, 420, delta=1)
        self.assertAlmostEqual(float(box.height) / 72 * 25.4, 297, delta=1)

    def test_the_index_leads_to_the_leaves(self):
        reader = PdfReader(site() / "gallery.pdf")
        links = [annotation.get_object() for annotation in reader.pages[0]["/Annots"]]
        self.assertEqual(
            {link["/Dest"][0].idnum for link in links}, {reader.pages[at].indirect_reference.idnum for at in (2, 3)}
        )
        self.assertNotIn(b"file:", b"".join(str(page.get("/Annots", "")).encode() for page in reader.pages))


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


if __name__ == "__main__":
    unittest.main()

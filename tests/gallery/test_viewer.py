"""The viewer: its canvas against the sheet's EXR files, its controls, its keys, and the files that it gives."""

import io
import json
import tempfile
import unittest
from pathlib import Path

import matplotlib
import numpy
from PIL import Image

from browser import PHONE, BrowserCase, drawn
from experiment import BOTH, out, sheet, site
from gallery.image import display_pixels, read_exr

REFERENCE, ONE, EIGHT, PER_LOBE = "1.2.5", "1.2.6", "1.2.7", "1.2.12"
LIGHT = 0.0


def linear(id: str) -> numpy.ndarray:
    """The sheet's image as the page has it: in half precision."""
    return read_exr(out() / "sheets" / BOTH / f"{id}.exr").rgba.astype(numpy.float16).astype(numpy.float32)


def exposure(light: float = LIGHT) -> float:
    return next(item["exposure"] for item in sheet(BOTH)["exposures"] if item["light_phi_deg"] == light)


def shown(id: str, stops: float = 0.0) -> numpy.ndarray:
    return display_pixels(linear(id), exposure() * 2**stops)


class ViewerCase(BrowserCase):
    def view(self, id: str = ONE, key: str = "i", **options):
        page = self.open(f"{BOTH}.html", **options)
        page.click(f"a[data-image='{id}']")
        page.keyboard.press(key)
        return page


class Images(ViewerCase):
    def test_the_canvas_shows_what_the_png_shows(self):
        page = self.view()
        for key, id in zip("1234", (REFERENCE, ONE, EIGHT, PER_LOBE), strict=True):
            page.keyboard.press(key)
            pixels = drawn(page, f"{id} image")
            numpy.testing.assert_array_equal(pixels[..., :3], shown(id))
            self.assertTrue((pixels[..., 3] == 255).all())
            self.assertIn(id, page.locator("#viewer-title").inner_text())

    def test_geometry_has_no_comparison(self):
        page = self.view("1.2.1", "d")
        drawn(page, "1.2.1 image")
        self.assertTrue(page.locator("#choose-view").evaluate("choice => choice.disabled"))

    def test_exposure_in_stops(self):
        page = self.view()
        page.locator("#stops").fill("-2")
        numpy.testing.assert_array_equal(drawn(page, f"{ONE} image")[..., :3], shown(ONE, -2.0))
        page.focus("#canvas")
        page.keyboard.press("0")
        for _ in range(4):
            page.keyboard.press("+")
        numpy.testing.assert_array_equal(drawn(page, f"{ONE} image")[..., :3], shown(ONE, 1.0))
        self.assertEqual(page.locator("#stops-value").inner_text(), "+1.00")

    def test_wipe(self):
        page = self.view(ONE, "w")
        self.expect_wipe(page, 8)
        page.locator("#wipe").fill("3")
        self.expect_wipe(page, 3)
        page.focus("#canvas")
        page.keyboard.press(".")
        page.keyboard.press(".")
        self.expect_wipe(page, 5)
        page.keyboard.press(",")
        self.expect_wipe(page, 4)
        box = page.locator("#canvas").bounding_box()
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] * 0.2)
        page.mouse.down()
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] * (11.5 / 16))
        page.mouse.up()
        self.expect_wipe(page, 11)

    def expect_wipe(self, page, split):
        page.wait_for_function("split => document.getElementById('wipe').value === split", arg=str(split))
        pixels = drawn(page, f"{ONE} wipe")[..., :3]
        numpy.testing.assert_array_equal(pixels[:split], shown(REFERENCE)[:split])
        numpy.testing.assert_array_equal(pixels[split:], shown(ONE)[split:])
        line = page.locator("#wipe-line").bounding_box()
        canvas = page.locator("#canvas").bounding_box()
        at = (line["y"] + line["height"] / 2 - canvas["y"]) / canvas["height"]
        self.assertAlmostEqual(at, split / 16, delta=0.005)

    def test_differences(self):
        page = self.view(ONE, "d")
        reference, image = linear(REFERENCE).astype(float), linear(ONE).astype(float)
        sphere = reference[..., 3] > 0
        off = (image - reference)[..., :3] / numpy.sqrt((reference[sphere][:, :3] ** 2).mean())
        for scale in ("0.5", "2"):
            page.locator("#range").select_option(scale)
            page.focus("#canvas")
            for key, view, place in (
                ("d", "signed", (off.mean(axis=-1) / float(scale) + 1) / 2),
                ("a", "absolute", numpy.sqrt((off**2).mean(axis=-1)) / float(scale)),
            ):
                page.keyboard.press(key)
                pixels = drawn(page, f"{ONE} {view}")
                self.expect_colours(pixels, place, {"signed": "RdBu_r", "absolute": "magma"}[view], sphere)
        self.assertIn("2", page.locator("#legend-ends").inner_text())

    def expect_colours(self, pixels, place, name, sphere):
        colours = matplotlib.colormaps[name](numpy.linspace(0, 1, 256), bytes=True)
        wanted = colours[numpy.floor(255 * numpy.clip(place, 0, 1) + 0.5).astype(int)]
        numpy.testing.assert_array_equal(pixels[sphere], wanted[sphere])
        self.assertTrue((pixels[~sphere][:, 3] == 0).all())

    def test_the_absolute_difference_has_the_images_relrmse(self):
        page = self.view(EIGHT)
        drawn(page, f"{EIGHT} image")
        measured = page.evaluate(
            """async ([a, b]) => {
            const { sheet } = gallery.state;
            const [image, reference] = await Promise.all([a, b].map((id) =>
                gallery.pixels.get(sheet.material, sheet.images.find((item) => item.id === id))));
            const rms = gallery.display.rootMeanSquare(reference);
            let sum = 0, count = 0;
            for (let at = 0; at < image.rgba.length; at += 4) {
                if (!(reference.rgba[at + 3] > 0)) continue;
                sum += gallery.display.pixelDifference(image, reference, rms, at, "absolute") ** 2;
                ++count;
            }
            return Math.sqrt(sum / count);
        }""",
            [EIGHT, REFERENCE],
        )
        entry = next(image for image in sheet(BOTH)["images"] if image["id"] == EIGHT)
        self.assertAlmostEqual(measured, entry["relrmse"], delta=1e-3)  # what half precision leaves
        self.assertIn(f"relRMSE {entry['relrmse']:.4f}", page.locator("#viewer-figures").inner_text())


class Controls(ViewerCase):
    def test_keys_go_through_lights_and_surfaces(self):
        page = self.view()
        for key, id in (("l", "1.2.9"), ("l", "1.2.3"), ("l", ONE), ("]", "1.3.6"), ("]", "2.1.6"), ("[", "1.3.6")):
            page.keyboard.press(key)
            drawn(page, f"{id} image")
        page.keyboard.press("4")
        drawn(page, "1.3.12 image")
        self.assertTrue(page.url.endswith("#1.3.12"))

    def test_the_controls_do_what_the_keys_do(self):
        page = self.view()
        page.get_by_label("per-lobe, N = 8").check(force=True)
        page.get_by_label("φ = −25°").check(force=True)
        page.locator("#row").select_option("2.1")
        page.get_by_label("difference", exact=True).check(force=True)
        drawn(page, "2.1.13 signed")

    def test_pixel_values_under_the_pointer(self):
        page = self.view()
        drawn(page, f"{ONE} image")
        box = page.locator("#canvas").bounding_box()
        x, y = 11, 6
        page.mouse.move(box["x"] + (x + 0.5) * box["width"] / 16, box["y"] + (y + 0.5) * box["height"] / 16)
        self.expect_readout(page, x, y)
        page.mouse.move(box["x"] + 2, box["y"] + 2)
        self.assertEqual(page.locator("#readout").inner_text(), "x 0, y 0: off the sphere")

    def test_pixel_values_by_arrow_keys_are_announced(self):
        page = self.view()
        drawn(page, f"{ONE} image")
        for key in ("ArrowRight", "ArrowRight", "ArrowUp", "ArrowRight", "ArrowLeft", "ArrowDown", "ArrowDown"):
            page.keyboard.press(key)
        self.expect_readout(page, 9, 9)
        self.assertEqual(page.locator("#announce").inner_text(), page.locator("#readout").inner_text())
        page.keyboard.press("Shift+ArrowLeft")
        self.assertIn("x 1, y 9", page.locator("#readout").inner_text())
        for _ in range(3):
            page.keyboard.press("Shift+ArrowLeft")
        self.assertIn("x 0, y 9", page.locator("#readout").inner_text())

    def expect_readout(self, page, x, y):
        text = page.locator("#readout").inner_text()
        self.assertIn(f"x {x}, y {y}", text)
        image, reference = (part.split()[-3:] for part in text.split(";")[:2])
        numpy.testing.assert_allclose(numpy.array(image, float), linear(ONE)[y, x, :3], rtol=5e-4)
        numpy.testing.assert_allclose(numpy.array(reference, float), linear(REFERENCE)[y, x, :3], rtol=5e-4)

    def test_zoom_is_by_whole_pixels(self):
        page = self.view(viewport=PHONE)
        drawn(page, f"{ONE} image")
        self.assertEqual(page.locator("#canvas").evaluate("c => getComputedStyle(c).imageRendering"), "pixelated")
        page.click("#zoom-fit")
        fitting = page.locator("#canvas").bounding_box()["width"]
        self.assertEqual(fitting % 16, 0)
        page.focus("#canvas")
        page.keyboard.press("z")
        self.assertEqual(page.locator("#canvas").bounding_box()["width"], fitting - 16)
        page.click("#zoom-in")
        self.assertEqual(page.locator("#canvas").bounding_box()["width"], fitting)

    def test_an_address_opens_its_image(self):
        page = self.open(f"{BOTH}.html#3.1.9")
        drawn(page, "3.1.9 wipe")

    def test_fits_a_phone(self):
        page = self.view(ONE, viewport=PHONE)
        drawn(page, f"{ONE} image")
        for control in ("#canvas", "#close", "#save-exr"):
            page.locator(control).scroll_into_view_if_needed()
            box = page.locator(control).bounding_box()
            self.assertTrue(0 <= box["x"] and box["x"] + box["width"] <= PHONE["width"], control)

    def test_missing_data_is_told(self):
        row = site() / "data" / BOTH / "3.3.js"
        away = row.with_suffix(".away")
        row.rename(away)
        self.addCleanup(away.rename, row)
        page = self.open(f"{BOTH}.html")
        page.click("a[data-image='3.3.6']")
        page.wait_for_function("document.getElementById('message').textContent.includes('could not be loaded')")
        self.assertTrue(any("3.3.js" in complaint for complaint in self.complaints))
        self.complaints.clear()


class Downloads(ViewerCase):
    def save(self, page, button) -> tuple[str, bytes]:
        with page.expect_download() as download:
            page.click(button)
        return download.value.suggested_filename, Path(download.value.path()).read_bytes()

    def test_exr(self):
        page = self.view(PER_LOBE)
        name, content = self.save(page, "#save-exr")
        self.assertEqual(name, f"{BOTH}-{PER_LOBE}.exr")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            path.write_bytes(content)
            given = read_exr(path)
        original = read_exr(out() / "sheets" / BOTH / f"{PER_LOBE}.exr")
        numpy.testing.assert_array_equal(given.rgba, linear(PER_LOBE))
        self.assertEqual(given.attributes, original.attributes)
        self.assertIn("slopemix.alpha_x", given.attributes)

    def test_png_is_what_the_canvas_shows(self):
        page = self.view(ONE, "d")
        pixels = drawn(page, f"{ONE} signed")
        name, content = self.save(page, "#save-png")
        self.assertEqual(name, f"{BOTH}-{ONE}-signed-difference.png")
        numpy.testing.assert_array_equal(numpy.asarray(Image.open(io.BytesIO(content)).convert("RGBA")), pixels)

    def test_json(self):
        name, content = self.save(self.view(EIGHT), "#save-json")
        entry = next(image for image in sheet(BOTH)["images"] if image["id"] == EIGHT)
        self.assertEqual(name, f"{BOTH}-{EIGHT}.json")
        self.assertEqual(json.loads(content) | entry, json.loads(content))

    def test_links_of_the_page(self):
        page = self.open(f"{BOTH}.html")
        for link in page.locator("a[download]").all():
            path = site() / link.get_attribute("href")
            self.assertGreater(path.stat().st_size, 100)
        self.assertEqual(
            json.loads((site() / "data" / BOTH / "per-lobe-2.json").read_text()),
            json.loads((out() / "fits" / BOTH / "per-lobe-2" / f"{BOTH}.json").read_text()),
        )


if __name__ == "__main__":
    unittest.main()

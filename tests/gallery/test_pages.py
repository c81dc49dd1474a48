"""What a page shows of its sheet, with and without JavaScript, and what it says of parts that are not there."""

import unittest

from browser import PHONE, WIDE, BrowserCase
from experiment import BARE, BOTH, sheet

PAGES = ["index.html", "summary.html", f"{BOTH}.html", f"{BARE}.html"]
COLUMNS = 13
ROWS = 9


class Pages(BrowserCase):
    def test_load_without_a_complaint(self):
        for name in PAGES:
            with self.subTest(name):
                page = self.open(name)
                self.assertTrue(page.title())
                self.assertEqual(page.locator("h1").count(), 1)

    def test_no_page_is_wider_than_its_window(self):
        for name in PAGES:
            page = self.open(name)
            for viewport in (PHONE, WIDE):
                with self.subTest(name, width=viewport["width"]):
                    page.set_viewport_size(viewport)
                    self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), viewport["width"])

    def test_every_image_of_the_sheet_decodes(self):
        for javascript in (True, False):
            with self.subTest(javascript=javascript):
                page = self.open(f"{BOTH}.html", javascript=javascript)
                images = page.evaluate(
                    "[...document.querySelectorAll('.sheet img')].map("
                    "i => [i.complete, i.naturalWidth, i.alt.split(':')[0]])"
                )
                self.assertEqual(len(images), ROWS * COLUMNS)
                self.assertTrue(all(complete and width == 16 for complete, width, _ in images))
                self.assertEqual({id for _, _, id in images}, {image["id"] for image in sheet(BOTH)["images"]})

    def test_images_stand_in_the_rows_and_columns_of_their_names(self):
        page = self.open(f"{BOTH}.html")
        placed = page.evaluate(
            "[...document.querySelectorAll('table.sheet')].map(t => [...t.tBodies[0].rows].map("
            "r => [...r.querySelectorAll('.id')].map(i => i.textContent)))"
        )
        wanted = [[[f"{t}.{r}.{c}" for c in range(1, COLUMNS + 1)] for r in (1, 2, 3)] for t in (1, 2, 3)]
        self.assertEqual(placed, wanted)

    def test_errors_are_those_of_the_sheet(self):
        page = self.open(f"{BOTH}.html")
        cells = page.locator(".errors tbody tr").all_inner_texts()
        for row, fit in zip(cells, sheet(BOTH)["summary"], strict=True):
            self.assertIn(f"{fit['mean_relrmse']:.3f}", row)
            self.assertIn(f"{fit['worst_relrmse']:.3f}", row)
            self.assertIn(fit["worst_image"], row)
        image = next(image for image in sheet(BOTH)["images"] if image["id"] == "2.3.4")
        self.assertIn(f"{image['relrmse']:.3f}", page.locator("a[data-image='2.3.4']").inner_text())

    def test_fits_have_their_lobes_and_plots(self):
        page = self.open(f"{BOTH}.html")
        self.assertEqual(page.locator(".fit").count(), 2)
        self.assertEqual(page.locator(".fit").nth(1).locator("tbody tr").count(), 2)
        for plot in page.locator(".plot img").all():
            plot.scroll_into_view_if_needed()
            plot.evaluate("image => image.decode()")
        self.assertIn("inversion", page.locator(".budget").inner_text())

    def test_says_what_is_not_there(self):
        page = self.open(f"{BARE}.html")
        self.assertIn("No material files", page.locator(".fits").inner_text())
        self.assertIn("not split", page.locator(".budget").inner_text())
        self.assertIn("Not measured", page.locator(".tradeoff").inner_text())
        self.assertIn("FLIP was not measured", page.locator(".errors").inner_text())

    def test_summary_has_its_tables(self):
        page = self.open("summary.html")
        self.assertEqual(page.locator("#models + div tbody tr").inner_text().split(), ["shared", "1", "0.125", "2.500"])
        self.assertIn("12.5", page.locator("#time + div").inner_text())
        page.locator("#worst + div a").click()
        self.assertEqual(page.locator("h1").inner_text(), BOTH)


if __name__ == "__main__":
    unittest.main()

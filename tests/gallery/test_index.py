"""The index: sorting, filtering, searching, its two forms, and the materials without a page."""

import unittest

from browser import BrowserCase
from experiment import BARE, BOTH, sheet


def names(page, container: str) -> list[str]:
    return page.evaluate(
        f"[...document.querySelectorAll('{container}')].filter(i => !i.hidden).map(i => i.dataset.name)"
    )


class Index(BrowserCase):
    def listed(self, page) -> list[str]:
        """What tiles and table show, which is the same."""
        tiles = names(page, ".tiles li")
        self.assertEqual(tiles, names(page, ".materials tbody tr"))
        return tiles

    def test_sorts_by_number_at_first(self):
        self.assertEqual(self.listed(self.open("index.html")), [BARE, BOTH])

    def test_sorts_by_every_error(self):
        page = self.open("index.html")
        for fit in sheet(BOTH)["summary"]:
            key = f"{fit['model']}-{fit['lobes']}"
            errors = {
                name: next(
                    item["mean_relrmse"]
                    for item in sheet(name)["summary"]
                    if (item["model"], item["lobes"]) == (fit["model"], fit["lobes"])
                )
                for name in (BOTH, BARE)
            }
            with self.subTest(key):
                page.locator("#sort").select_option(key)
                page.locator("#direction").select_option("1")
                self.assertEqual(self.listed(page), sorted(errors, key=errors.get))
                page.locator("#direction").select_option("-1")
                self.assertEqual(self.listed(page), sorted(errors, key=errors.get, reverse=True))

    def test_what_was_not_measured_comes_last(self):
        page = self.open("index.html")
        page.locator("#sort").select_option("flip-shared-1")
        for direction in ("1", "-1"):
            page.locator("#direction").select_option(direction)
            self.assertEqual(self.listed(page), [BOTH, BARE])

    def test_headings_sort_and_turn(self):
        page = self.open("index.html")
        page.get_by_label("table", exact=True).check()
        heading = page.locator("th[data-key='name']")
        heading.get_by_role("button").click()
        self.assertEqual((self.listed(page), heading.get_attribute("aria-sort")), ([BARE, BOTH], "ascending"))
        heading.get_by_role("button").click()
        self.assertEqual((self.listed(page), heading.get_attribute("aria-sort")), ([BOTH, BARE], "descending"))
        self.assertEqual(page.locator("[aria-sort]").count(), 1)
        self.assertEqual(page.locator("#sort").input_value(), "name")

    def test_filters_by_kind_and_name(self):
        page = self.open("index.html")
        page.locator("#kind").select_option("plastic")
        self.assertEqual(self.listed(page), [BOTH])
        self.assertEqual(page.locator("#count").inner_text(), "1 of 2 materials")
        self.assertFalse(page.locator("#absent").is_visible())
        page.locator("#kind").select_option("")
        page.locator("#search").fill("CONDUC")
        self.assertEqual(self.listed(page), [BARE])
        page.locator("#search").fill("nothing")
        self.assertEqual(self.listed(page), [])

    def test_shows_tiles_or_a_table(self):
        page = self.open("index.html")
        self.assertEqual((page.locator("#tiles").is_visible(), page.locator("#rows").is_visible()), (True, False))
        page.get_by_label("table", exact=True).check()
        self.assertEqual((page.locator("#tiles").is_visible(), page.locator("#rows").is_visible()), (False, True))

    def test_shows_both_without_javascript(self):
        page = self.open("index.html", javascript=False)
        self.assertTrue(page.locator("#tiles").is_visible() and page.locator("#rows").is_visible())
        self.assertFalse(page.locator(".filters").is_visible())

    def test_lists_what_has_no_page(self):
        absent = self.open("index.html").locator(".absent li").all_inner_texts()
        self.assertEqual([text.split()[:2] for text in absent], [["2", "brass"], ["4", "steel"]])
        self.assertIn("no table", absent[0])
        self.assertIn("not finished", absent[1])

    def test_thumbnails_decode_and_lead_to_the_page(self):
        page = self.open("index.html")
        widths = page.evaluate(
            "Promise.all([...document.querySelectorAll('.tiles img')].map(i => i.decode().then(() => i.naturalWidth)))"
        )
        self.assertEqual(widths, [16] * 8)
        page.locator(f".tiles li[data-name='{BOTH}'] a").click()
        self.assertEqual(page.locator("h1").inner_text(), BOTH)


if __name__ == "__main__":
    unittest.main()

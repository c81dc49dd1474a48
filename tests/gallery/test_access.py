"""Who can use the pages: axe-core in light and dark, on phone and wide screen, and a keyboard alone."""

import unittest

from axe_playwright_python.sync_playwright import Axe

from browser import LAPTOP, PHONE, WIDE, BrowserCase, drawn
from experiment import BOTH


def as_table(page):
    page.get_by_label("table", exact=True).check()


def in_viewer(key):
    def act(page):
        page.click("a[data-image='1.2.6']")
        page.wait_for_function("document.getElementById('canvas').dataset.drawn")
        page.keyboard.press(key)
        page.wait_for_timeout(50)

    return act


VIEWS = {
    "index": ("index.html", None),
    "index as a table": ("index.html", as_table),
    "summary": ("summary.html", None),
    "material": (f"{BOTH}.html", None),
    "wipe": (f"{BOTH}.html", in_viewer("w")),
    "difference": (f"{BOTH}.html", in_viewer("d")),
}


class Access(BrowserCase):
    def test_axe_finds_nothing(self):
        for name, (address, act) in VIEWS.items():
            page = self.open(address, PHONE)
            if act:
                act(page)
            for scheme, viewport in (("light", PHONE), ("dark", WIDE)):
                with self.subTest(name, scheme=scheme, width=viewport["width"]):
                    page.set_viewport_size(viewport)
                    page.emulate_media(color_scheme=scheme)
                    found = Axe().run(page, options={"preload": False})  # style sheets of files cannot be fetched
                    self.assertEqual(found.violations_count, 0, found.generate_report())
            page.context.close()

    def test_the_first_key_skips_to_the_content(self):
        page = self.open("index.html")
        page.keyboard.press("Tab")
        self.assertEqual(page.evaluate("document.activeElement.textContent"), "Skip to the content")
        self.assertTrue(page.locator(".skip").bounding_box()["x"] >= 0)

    def test_a_keyboard_opens_uses_and_leaves_the_viewer(self):
        page = self.open(f"{BOTH}.html")
        self.tab_to(page, "1.1.3")
        page.keyboard.press("Enter")
        drawn(page, "1.1.3 wipe")
        self.assertEqual(self.focused(page), "canvas")
        visited = self.tab_through(page, "canvas")
        for control in ("close", "row", "wipe", "stops", "zoom-in", "save-exr"):
            self.assertIn(control, visited)
        page.keyboard.press("Escape")
        self.assertFalse(page.locator("#viewer").is_visible())
        self.assertEqual(self.focused(page), "1.1.3")
        page.keyboard.press("Tab")
        self.assertEqual(self.focused(page), "1.1.4")

    def test_focus_returns_to_the_image_that_was_shown_last(self):
        page = self.open(f"{BOTH}.html")
        page.click("a[data-image='1.1.3']")
        page.keyboard.press("]")
        drawn(page, "1.2.3 wipe")
        page.click("#close")
        self.assertEqual(self.focused(page), "1.2.3")

    def test_what_has_the_focus_shows_it(self):
        page = self.open(f"{BOTH}.html")
        self.tab_to(page, "1.1.3")
        width = page.evaluate("parseFloat(getComputedStyle(document.activeElement).outlineWidth)")
        self.assertGreaterEqual(width, 2)

    def test_little_moves(self):
        page = self.open(f"{BOTH}.html", LAPTOP)
        page.emulate_media(reduced_motion="reduce")
        page.click("a[data-image='1.1.3']")
        self.assertEqual(page.evaluate("document.getAnimations().length"), 0)

    def tab_to(self, page, id):
        for _ in range(60):
            page.keyboard.press("Tab")
            if self.focused(page) == id:
                return
        self.fail(f"sixty tabs do not reach {id}")

    def tab_through(self, page, first) -> list[str]:
        """What has an id, from the element `first` on until it has the focus again."""
        visited = []
        for _ in range(60):
            page.keyboard.press("Tab")
            if self.focused(page) == first:
                return visited
            visited.append(self.focused(page))
        self.fail(f"sixty tabs do not come back to {first}: {visited}")

    def focused(self, page) -> str:
        return page.evaluate("document.activeElement.id")


if __name__ == "__main__":
    unittest.main()

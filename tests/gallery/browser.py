"""Chromium, started once, and test cases that look at pages in it: a message on a console or a request fails them."""

import atexit
import functools
import shutil
import unittest

import numpy
from playwright.sync_api import Page, sync_playwright

from experiment import site

LAPTOP = {"width": 1280, "height": 800}
PHONE = {"width": 390, "height": 844}
WIDE = {"width": 1920, "height": 1080}


@functools.cache
def chromium():
    playwright = sync_playwright().start()
    browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
    atexit.register(lambda: (browser.close(), playwright.stop()))
    return browser


class BrowserCase(unittest.TestCase):
    def setUp(self):
        self.complaints = []

    def open(self, page_name: str, viewport=LAPTOP, scheme="light", javascript=True) -> Page:
        context = chromium().new_context(
            viewport=viewport, color_scheme=scheme, java_script_enabled=javascript, accept_downloads=True
        )
        self.addCleanup(context.close)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.on("console", lambda message: self.complaints.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: self.complaints.append(f"error: {error}"))
        page.on("request", lambda request: self.note_request(request.url))
        page.on("requestfailed", lambda request: self.complaints.append(f"failed: {request.url}"))
        page.goto(site().as_uri() + "/" + page_name)
        return page

    def note_request(self, url: str) -> None:
        if not url.startswith(("file:", "data:", "blob:")):
            self.complaints.append(f"the page asks the network for {url}")

    def tearDown(self):
        self.assertEqual(self.complaints, [])


def drawn(page: Page, what: str) -> numpy.ndarray:
    """The canvas's pixels [height][width][4], once it shows `what`: an identifier and a view."""
    page.wait_for_function("what => document.getElementById('canvas').dataset.drawn === what", arg=what)
    values = page.evaluate(
        "() => { const c = document.getElementById('canvas');"
        " return [c.height, c.width, [...c.getContext('2d').getImageData(0, 0, c.width, c.height).data]]; }"
    )
    return numpy.array(values[2], numpy.uint8).reshape(values[0], values[1], 4)

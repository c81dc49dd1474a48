"""What checks the documentation finds what is wrong: each fault is planted in a header or a page that is right."""
import pathlib
import tempfile
import unittest

import blocks
import check_fields
import links

HEADER = '''typedef struct smx_thing_s *smx_thing;

/** Makes a thing.
 *
 * @param x, y   numbers
 * @param thing  the new handle
 * @ownership  the caller owns one reference
 * @threads    any
 * @statuses   INVALID_ARGUMENT */
SMX_API smx_status smx_thing_create(double x, double y, smx_thing *thing);

/** Its name.
 *
 * @param thing  the thing
 * @return     the name
 * @ownership  the thing's
 * @threads    any */
SMX_API const char *smx_thing_name(smx_thing thing);
'''

PAGE = '''# A page

[itself](#a-page), [another](page.md)

- a list

  with a paragraph

```sh
true
```

<!-- test: file x.c -->
```c
int x;
```
'''


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name


class Fields(Files):
    def fails(self, old, new):
        self.assertIn(old, HEADER)
        self.write("slopemix.h", HEADER.replace(old, new, 1))
        return check_fields.main(self.folder)

    def test_a_whole_header_passes(self):
        self.assertEqual(self.fails("Makes", "Makes"), 0)

    def test_each_field_is_missed(self):
        for old, new in ((" * @param x, y   numbers\n", ""), ("@param x, y", "@param x"), ("@param x, y", "@param x, y, z"),
                         (" * @ownership  the caller owns one reference\n", ""), (" * @ownership  the thing's\n", ""),
                         (" * @threads    any\n * @statuses", " * @statuses"), ("\n * @threads    any */", " */"),
                         ("\n * @statuses   INVALID_ARGUMENT */", " */"), (" * @return     the name\n", ""),
                         ("INVALID_ARGUMENT */", "INVALID_ARGUMENT, BAD_LUCK */"), ("INVALID_ARGUMENT */", "some */"),
                         ("INVALID_ARGUMENT */", "those of smx_other */"), ("/** Makes a thing.", "/**"),
                         ("/** Makes", "/* Makes")):
            with self.subTest(old=old, new=new):
                self.assertEqual(self.fails(old, new), 1)


class Pages(Files):
    def blocks(self, old="", new=""):
        self.assertIn(old, PAGE)
        return blocks.blocks_of(self.write("page.md", PAGE.replace(old, new, 1)), "page.md")

    def test_a_page_that_is_right(self):
        self.assertEqual([(b.language, b.kind, b.value, b.text) for b in self.blocks()],
                         [("sh", "", "", "true\n"), ("c", "file", "x.c", "int x;\n")])
        self.assertEqual(list(links.broken_links(self.folder / "page.md")), [])

    def test_blocks_that_cannot_be_judged(self):
        for old, new in (("```sh", "```"), ("```sh", "```fortran"), ("<!-- test: file x.c -->\n", ""), ("file x.c", "run"),
                         ("file x.c", "not run:"), ("<!-- test: file x.c -->\n", "<!-- test: file x.c -->\n\n"),
                         ("int x;\n```", "int x;"), ("```sh\ntrue\n```", "text\n\n    true\n"),
                         ("  with a paragraph", "      true"), ("```sh", "<!-- test: file x.sh -->\n```sh")):
            with self.subTest(old=old, new=new), self.assertRaises(blocks.Malformed):
                self.blocks(old, new)

    def test_links_that_lead_nowhere(self):
        for old, new in (("#a-page", "#another"), ("page.md", "other.md"), ("page.md", "page.md#x")):
            with self.subTest(new=new):
                page = self.write("page.md", PAGE.replace(f"({old})", f"({new})", 1))
                self.assertEqual(list(links.broken_links(page)), [new])


if __name__ == "__main__":
    unittest.main()

"""Doxygen's filter for docs/*.md: gives every heading the label that links on a forge have, with the page's name before
it, and makes links by them. Prints the page.

    page.py FILE.md
"""
import os
import re
import sys


def slug(heading):
    """The anchor that a forge gives a heading."""
    return re.sub(r"[^\w -]", "", heading.lower()).strip().replace(" ", "-")


def name_of(path):
    """docs/fit.md is the page `fit`; the start page, docs/README.md, is `index`."""
    name = os.path.splitext(os.path.basename(path))[0].lower()
    return "index" if name == "readme" else name


def labelled(line, page):
    level, heading = re.match(r"(#+) (.*)", line).groups()
    if page == "index":
        return line  # its headings would be in the navigation, beside the pages that they list
    return f"{line} {{#{page if level == '#' else f'{page}-{slug(heading)}'}}}"


def linked(line, page):
    line = re.sub(r"\[`([^`\]]*)`\]\((?!http)", r"[\1](", line)  # Doxygen takes no code in a link's text
    line = line.replace("](../cl/slopemix.clh)", "](device/slopemix_8clh.html)")  # a reference of its own
    line = re.sub(r"\]\(\.\./capi/([\w/]+\.h)\)", r"](@ref \1)", line)
    line = re.sub(r"\]\(#([^)]*)\)", rf"](@ref {page}-\1)", line)
    return re.sub(r"\]\((?!http)([^)#]*\.md)#([^)]*)\)", lambda m: f"](@ref {name_of(m[1])}-{m[2]})", line)


def main(path):
    page, in_code = name_of(path), False
    with open(path, encoding="utf-8") as file:
        for line in file.read().splitlines():
            in_code ^= line.startswith("```")
            if not in_code:
                line = labelled(line, page) if re.match(r"#+ ", line) else linked(line, page)
            print(line)


main(sys.argv[1])

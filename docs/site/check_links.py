"""Links and pictures of the site's pages lead to files that are there, and to anchors in them.

    check_links.py HTML_FOLDER
"""
import pathlib
import re
import sys
import urllib.parse


def main(folder):
    texts = {page.resolve(): page.read_text(errors="replace") for page in pathlib.Path(folder).rglob("*.html")}
    anchors = {page: set(re.findall(r'(?:id|name)="([^"]+)"', text)) for page, text in texts.items()}
    broken, links = [], 0
    for page, text in texts.items():
        for target in re.findall(r'(?:href|src)="([^"]+)"', text):
            if re.match(r"(https?|javascript|data):", target):
                continue
            links += 1
            path, _, anchor = urllib.parse.unquote(target).partition("#")
            file = (page.parent / path).resolve() if path else page
            if not file.exists() or (anchor and file in anchors and anchor not in anchors[file]):
                broken.append(f"{page.name}: '{target}' leads nowhere")
    for line in sorted(set(broken)):
        print(line, file=sys.stderr)
    print(f"{len(texts)} pages, {links} links, {len(set(broken))} broken")
    return 1 if broken or not links else 0


sys.exit(main(sys.argv[1]))

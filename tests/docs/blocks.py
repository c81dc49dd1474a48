"""The code blocks of a Markdown page, and what their markers ask for.

A block is fenced and names its language. A line `<!-- test: ... -->` right before it says
    file NAME        it is saved under NAME in the page's folder, for the blocks after it
    part of FILE     it stands in FILE, a C program of the sources, which is compiled and run
    slow: REASON     it is run by the slow entry only
    not run: REASON  it is not run
Without one, `sh` is run and `text` and `csv` are not code.
"""
import dataclasses
import pathlib
import re
import textwrap

CODE = {"c", "cmake", "opencl", "sh"}
SHOWN = {"text", "csv"}
MARKERS = re.compile(r"(file|part of) ([\w./-]+)|(slow|not run): (\S.*)")


@dataclasses.dataclass
class Block:
    page: pathlib.Path
    line: int
    language: str
    text: str
    kind: str = ""    # file, part of, slow, not run; "" without a marker
    value: str = ""   # the marker's file or reason

    def __str__(self):
        return f"{self.page}:{self.line} ({self.language})"


class Malformed(Exception):
    """A block that no test can judge."""


def marker_of(lines, at, place):
    """Kind and value of the marker before line `at`."""
    before = lines[at - 1].strip() if at else ""
    if not before.startswith("<!-- test:"):
        return "", ""
    match = re.fullmatch(r"<!-- test: (.*) -->", before)
    parts = match and MARKERS.fullmatch(match[1])
    if not parts:
        raise Malformed(f"{place}: the marker '{before}' is none of those in tests/docs/blocks.py")
    return (parts[1], parts[2]) if parts[1] else (parts[3], parts[4])


def checked(block):
    if block.language not in CODE | SHOWN:
        raise Malformed(f"{block}: the language is none of {', '.join(sorted(CODE | SHOWN))}")
    if block.language in SHOWN and block.kind not in ("", "file"):
        raise Malformed(f"{block}: text has nothing to run")
    if block.language in CODE - {"sh"} and block.kind in ("", "slow"):
        raise Malformed(f"{block}: needs a marker, 'file NAME', 'part of FILE' or 'not run: REASON'")
    if block.language == "sh" and block.kind in ("file", "part of"):
        raise Malformed(f"{block}: a shell block is run, and takes 'slow: REASON' or 'not run: REASON' only")
    return block


def indented_code(lines, at, in_list):
    """Whether line `at` begins a block that is indented in place of fenced."""
    after_blank = at > 0 and not lines[at - 1].strip()
    return after_blank and re.match(r" {6,}\S" if in_list else r" {4,}\S", lines[at])


def blocks_of(page, name):
    lines, found, at, in_list = page.read_text().splitlines(), [], 0, False
    while at < len(lines):
        place = f"{name}:{at + 1}"
        fence = re.match(r"( {0,3})```(.*)", lines[at])
        if fence:
            end = next((k for k in range(at + 1, len(lines)) if lines[k].strip() == "```"), None)
            if end is None:
                raise Malformed(f"{place}: the block does not end")
            text = textwrap.dedent("\n".join(lines[at + 1:end])) + "\n"
            found.append(checked(Block(name, at + 1, fence[2].strip(), text, *marker_of(lines, at, place))))
            at = end
        elif indented_code(lines, at, in_list):
            raise Malformed(f"{place}: a block without a language: fence it, ```sh ... ```")
        elif lines[at].startswith("<!-- test:") and not re.match(r" {0,3}```", (lines + [""])[at + 1]):
            raise Malformed(f"{place}: the marker has no block after it")
        elif re.match(r"\S", lines[at]):
            in_list = bool(re.match(r"(-|\d+\.) ", lines[at])) or (in_list and bool(lines[at - 1].strip()))
        at += 1
    return found

"""The names of the materials whose error is worth splitting.

    python -m summary.worst OUT --count N --to FILE [--only NAME,...]
"""
import argparse
import pathlib

from .files import read_metrics, write_text
from .statistics import rows_of, worst_materials


def main():
    parser = argparse.ArgumentParser(prog="python -m summary.worst")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--count", type=int, required=True)
    parser.add_argument("--to", type=pathlib.Path, required=True)
    parser.add_argument("--only", type=lambda text: text.split(","))
    arguments = parser.parse_args()
    rows = rows_of(read_metrics(arguments.out, arguments.only), {})
    write_text(arguments.to, "".join(f"{name}\n" for name, _ in worst_materials(rows, arguments.count)))


if __name__ == "__main__":
    main()

"""The command line, and the settings that it asks for."""
import argparse
import os
import pathlib
import re
import sys

import yaml

DEFAULTS = pathlib.Path(__file__).parent.parent / "config.yaml"
STAGES = ("metrics", "summary", "gallery", "pdf")
DESCRIPTION = """Runs the whole experiment over a folder of MERL tables: of each material its fits, its sheet of images
and their errors; then the summary over the materials and the gallery. The same command line goes on where it was
interrupted; other settings compute anew what depends on them. Flags behind -- go to Snakemake. docs/experiment.md has
more."""


def numbers(kind, low, high=float("inf")):
    """A list of numbers, separated by commas."""
    return lambda text: [number(kind, low, high)(part) for part in text.split(",")]


def number(kind, low, high=float("inf")):
    def parse(text):
        try:
            value = kind(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"'{text}' is no {kind.__name__}") from None
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"'{text}' is outside {low}..{high}")
        return value
    return parse


def order(text):
    return text if text == "auto" else number(int, 0, 8)(text)


def orders(text):
    return [order(part) for part in text.split(",")]


def names(text):
    return [name for name in text.split(",") if name]


def resolution(text):
    if not re.fullmatch(r"[1-9][0-9]*(x[1-9][0-9]*)?", text):
        raise argparse.ArgumentTypeError(f"'{text}' is no resolution: W or WxH, in pixels")
    return text


def add_settings(parser, defaults):
    """A flag for every entry of config.yaml."""
    def add(flag, help, **how):
        default = defaults[flag.removeprefix("--").replace("-", "_")]
        shown = ",".join(map(str, default)) if isinstance(default, list) else default
        parser.add_argument(flag, default=None, help=f"{help} (default {shown or 'none'})", **how)

    add("--res", "pixels of an image", metavar="W[xH]", type=resolution)
    sampling = parser.add_mutually_exclusive_group()
    sampling.add_argument("--spp", metavar="N", type=number(int, 1),
                          help=f"samples per pixel of a reference (default {defaults['spp']})")
    sampling.add_argument("--target-error", metavar="E", type=number(float, 1e-5, 1),
                          help="instead: as many as bring its standard error, relative to the image, below E")
    add("--seed", "seed of the references", metavar="S", type=number(int, 0))
    add("--radii", "roughnesses, a row each", metavar="R,...", type=numbers(float, 0, 10))
    add("--lobes", "numbers of lobes; the per-lobe model has the last", metavar="N,...", type=numbers(int, 1, 64))
    add("--widening-order", "more columns: the per-lobe model widened by these orders", metavar="N,...", type=orders)
    add("--worst", "materials of which the error is split", metavar="N", type=number(int, 1))
    add("--tradeoff", "materials of which accuracy against time is measured", metavar="NAME,...", type=names)
    add("--shard", "references of one job: one image, or those of a row, table or sheet",
        choices=("light", "row", "table", "sheet"))
    add("--threads", "of a rendering job", metavar="N", type=number(int, 1))
    add("--pixels-per-degree", "at which FLIP looks at the images", metavar="P", type=number(float, 1))


def parser_of(defaults):
    parser = argparse.ArgumentParser(prog="tools/experiment", description=DESCRIPTION,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("merl", metavar="MERL_DIR", type=pathlib.Path, help="the folder of tables, NAME.binary")
    parser.add_argument("out", metavar="OUT", type=pathlib.Path, help="the experiment's folder")
    parser.add_argument("--cores", metavar="N", type=number(int, 1), default=os.cpu_count(),
                        help="cores to use on this machine (default all)")
    parser.add_argument("--profile", metavar="NAME",
                        help="a Snakemake profile, tools/workflow/profiles/NAME or a folder: jobs go where it says, "
                        "`slurm` to a Slurm cluster")
    parser.add_argument("--only", metavar="NAME,...", type=names, help="only these materials")
    parser.add_argument("--until", choices=STAGES, help="stop at this stage (default pdf where there is a chromium)")
    parser.add_argument("--dry-run", action="store_true", help="say how many jobs there are to run, and run none")
    add_settings(parser.add_argument_group("settings of the experiment"), defaults)
    return parser


def parse(arguments=None):
    """The arguments, and the settings of config.yaml with what the flags say."""
    defaults = yaml.safe_load(DEFAULTS.read_text())
    arguments = sys.argv[1:] if arguments is None else arguments
    ours = arguments[:arguments.index("--")] if "--" in arguments else arguments
    parsed = parser_of(defaults).parse_args(ours)
    parsed.snakemake = arguments[len(ours) + 1:]
    asked = {key: getattr(parsed, key) for key in defaults if getattr(parsed, key) is not None}
    if "target_error" in asked:
        asked["spp"] = 0
    return parsed, defaults | asked

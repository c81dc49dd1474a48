"""A material's fits, from OUT/fits/NAME/FIT/NAME.json: their lobes, with the mean colour of each one's curve."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy

from .image import display_pixels


@dataclass(frozen=True)
class Lobe:
    alpha: float
    weight: float
    colour: tuple[float, float, float]  # mean of F over theta_d, weighted by sin(2 theta_d)

    @property
    def swatch(self) -> str:
        """The colour at full brightness, as CSS has it."""
        brightest = max(self.colour)
        if brightest <= 0:
            return "#000"
        pixel = display_pixels(numpy.array([[[*self.colour, 1.0]]]), 1.0 / brightest)[0, 0]
        return "#" + bytes(pixel).hex()


@dataclass(frozen=True)
class MaterialFit:
    key: str  # of its folder: shared-8
    model: str
    lobes: list[Lobe]
    file: Path
    plot: Path | None
    document: dict

    @property
    def label(self) -> str:
        return f"{self.model}, N = {len(self.lobes)}"


def read_fits(out: Path, name: str) -> list[MaterialFit]:
    fits = [read_fit(file) for file in out.glob(f"fits/{name}/*/{name}.json")]
    return sorted(fits, key=lambda fit: (fit.model != "shared", len(fit.lobes), fit.key))


def read_fit(file: Path) -> MaterialFit:
    document = json.loads(file.read_text())
    colours = [mean_colour(document["theta_d"], curve) for curve in document["fresnel"]]
    if len(colours) == 1:
        colours *= len(document["lobes"])
    lobes = [
        Lobe(lobe["alpha"], lobe["weight"], colour) for lobe, colour in zip(document["lobes"], colours, strict=True)
    ]
    plot = file.with_suffix(".svg")
    return MaterialFit(file.parent.name, document["model"], lobes, file, plot if plot.is_file() else None, document)


def mean_colour(theta_d: list[float], curve: dict) -> tuple[float, float, float]:
    weight = numpy.sin(2.0 * numpy.array(theta_d))
    return tuple(float(numpy.trapezoid(weight * curve[c], theta_d) / numpy.trapezoid(weight, theta_d)) for c in "rgb")

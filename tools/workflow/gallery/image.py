"""EXR images of a sheet: their pixels, small EXR files of them, and PNG files as `slopemix render --png` writes.

An image is float32 of shape (height, width, 4): linear R, G, B and alpha, which is 0 off the sphere.
"""

import io
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy
import OpenEXR
from PIL import Image

CHANNELS = ("R", "G", "B", "A")
LARGEST_HALF = 65504.0
BACKGROUND = (58, 110, 176)  # off the sphere, as lib/png.cpp has it
BRIGHT_QUANTILE = 0.99  # what shows at BRIGHT_DISPLAY, as tools/cli/exposure.h has it
BRIGHT_DISPLAY = 0.9


@dataclass
class Exr:
    rgba: numpy.ndarray
    attributes: dict[str, str]  # the names begin with slopemix.


def read_exr(path: Path) -> Exr:
    """Raises an OSError that names the file where it is not an EXR image with channels R, G, B and A."""
    try:
        with OpenEXR.File(str(path), separate_channels=True) as file:
            channels = file.channels()
            rgba = numpy.stack([channels[name].pixels for name in CHANNELS], axis=-1).astype(numpy.float32)
            attributes = {key: value for key, value in file.header().items() if key.startswith("slopemix.")}
    except (RuntimeError, KeyError, ValueError) as error:
        raise OSError(f"{path} is no EXR image with channels R, G, B, A: {error}") from error
    return Exr(rgba, attributes)


def small_exr(image: Exr) -> bytes:
    """A ZIP-compressed EXR file in half precision; in float where half has no room for a value."""
    fits = not (numpy.abs(image.rgba) > LARGEST_HALF).any()
    pixels = image.rgba.astype(numpy.float16 if fits else numpy.float32)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **image.attributes}
    channels = {name: numpy.ascontiguousarray(pixels[..., at]) for at, name in enumerate(CHANNELS)}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "image.exr"
        OpenEXR.File(header, channels).write(str(path))
        return path.read_bytes()


def bright_value(rgba: numpy.ndarray) -> float:
    """The 99th percentile of the values on the sphere; their maximum where that is 0."""
    values = numpy.sort(rgba[..., :3][rgba[..., 3] > 0], axis=None)
    if values.size == 0:
        return 0.0
    bright = values[int(numpy.floor(BRIGHT_QUANTILE * (values.size - 1) + 0.5))]
    return float(bright if bright > 0 else values[-1])


def exposure_for(bright: float) -> float:
    """1 for a black image, on which the exposure has no effect."""
    return BRIGHT_DISPLAY / bright if bright > 0 else 1.0


def display_pixels(rgba: numpy.ndarray, exposure: float) -> numpy.ndarray:
    """uint8 of shape (height, width, 3): the sRGB transfer of clip(exposure x linear), over the blue background."""
    linear = numpy.clip(exposure * rgba[..., :3].astype(numpy.float64), 0.0, 1.0)
    shown = 255.0 * numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    alpha = numpy.clip(rgba[..., 3:].astype(numpy.float64), 0.0, 1.0)
    return numpy.floor(shown * alpha + numpy.array(BACKGROUND) * (1.0 - alpha) + 0.5).astype(numpy.uint8)


def png(rgba: numpy.ndarray, exposure: float) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(display_pixels(rgba, exposure)).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()

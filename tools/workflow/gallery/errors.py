"""What the images of a fit are off by, over a sheet."""

from dataclasses import dataclass
from statistics import fmean

from .sheet import Fit, Sheet, SheetImage


@dataclass(frozen=True)
class FitErrors:
    fit: Fit
    images: int
    mean: float
    worst: SheetImage
    bias: float
    flip: float | None  # mean, where every image has one


def fit_errors(sheet: Sheet) -> list[FitErrors]:
    return [of_images(fit, measured) for fit in sheet.fits if (measured := measured_images(sheet, fit))]


def measured_images(sheet: Sheet, fit: Fit) -> list[SheetImage]:
    """Without those whose reference is black, of which no relative error is finite."""
    return [image for image in sheet.of_fit(fit) if image.entry.get("relrmse") is not None]


def of_images(fit: Fit, images: list[SheetImage]) -> FitErrors:
    flips = [image.flip for image in images if image.flip is not None]
    return FitErrors(
        fit=fit,
        images=len(images),
        mean=fmean(image.entry["relrmse"] for image in images),
        worst=max(images, key=lambda image: image.entry["relrmse"]),
        bias=fmean(image.entry["bias"] for image in images),
        flip=fmean(flips) if len(flips) == len(images) else None,
    )

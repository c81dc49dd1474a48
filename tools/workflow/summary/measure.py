"""A material's filtered images: relRMSE from sheet.json, and FLIP of the images as they are shown.

    python -m summary.measure SHEET --to FILE.json [--pixels-per-degree P]

FLIP (NVIDIA's flip-evaluator) compares what a viewer sees: the sRGB transfer of clip(exposure x linear) in 8 bits, with
the light's exposure from sheet.json for both images and the blue background behind them, as in sheet.png. The figure is
the mean of FLIP's error map over the sphere: the background is seen, but it is the same in both and would dilute the
mean by a share that depends on the frame.
"""
import argparse
import json
import pathlib

import flip_evaluator
import numpy

from gallery.image import display_pixels, read_exr

from .files import write_text

KEPT = ("id", "model", "lobes", "widening_order", "alpha_x", "alpha_y", "light_phi_deg", "relrmse")


def shown(linear, exposure):
    """What slopemix's PNG shows of it, 0 to 1 in steps of 1/255."""
    return (display_pixels(linear, exposure) / 255).astype(numpy.float32)


def flip(reference, image, exposure, pixels_per_degree):
    """Mean of FLIP's map over the sphere's pixels."""
    error_map, _, _ = flip_evaluator.evaluate(
        shown(reference, exposure), shown(image, exposure), "LDR", inputsRGB=True, applyMagma=False,
        computeMeanError=False, parameters={"ppd": pixels_per_degree})
    return float(numpy.mean(error_map[..., 0][reference[..., 3] > 0]))


def cost_of(folder, reference):
    """Samples of lit pixels, in all tries that a target error took, and seconds without the compilation of kernels."""
    report = json.loads((folder / f"{reference}.json").read_text())["report"]
    return {"id": reference, "samples": report["evaluations"], "seconds": report["seconds"] - report["build_seconds"]}


def measure(folder, pixels_per_degree):
    sheet = json.loads((folder / "sheet.json").read_text())
    exposures = {entry["light_phi_deg"]: entry["exposure"] for entry in sheet["exposures"]}
    scene = lambda image: (image["alpha_x"], image["alpha_y"], image["light_phi_deg"])
    pixels = {image["id"]: read_exr(folder / f"{image['id']}.exr").rgba for image in sheet["images"]
              if image["integrator"] != "geometry"}
    references = {scene(image): pixels[image["id"]] for image in sheet["images"] if image["integrator"] == "reference"}
    images = [{key: image[key] for key in KEPT}
              | {"flip": flip(references[scene(image)], pixels[image["id"]], exposures.get(image["light_phi_deg"], 1.0),
                              pixels_per_degree)}
              for image in sheet["images"] if image["integrator"] == "filtered"]
    taken = [cost_of(folder, image["id"]) for image in sheet["images"] if image["integrator"] == "reference"]
    return {"material": sheet["material"], "resolution": sheet["resolution"], "pixels_per_degree": pixels_per_degree,
            "references": taken, "images": images}


def main():
    parser = argparse.ArgumentParser(prog="python -m summary.measure")
    parser.add_argument("sheet", type=pathlib.Path)
    parser.add_argument("--to", type=pathlib.Path, required=True)
    parser.add_argument("--pixels-per-degree", type=float, default=67)
    arguments = parser.parse_args()
    write_text(arguments.to, json.dumps(measure(arguments.sheet, arguments.pixels_per_degree), indent=1) + "\n")


if __name__ == "__main__":
    main()

"""Time and cost of the experiment, and what the document's whole protocol would take."""
import math
import statistics

from .times import LATER, stage_times

PROTOCOL = {"materials": 100, "references": 27, "resolution": [128, 128], "samples": 65536}
SURFACES = 9
PIXELS_ON_SPHERE = 12892  # of 128 x 128, those whose centre is on the sphere
LIGHTS = (90, 0, -25)  # degrees; a light lights (1 + sin phi) / 2 of the visible disc, and other pixels take no sample
LIT_PIXELS = sum(PIXELS_ON_SPHERE * (1 + math.sin(math.radians(phi))) / 2 for phi in LIGHTS)
SLOPE = "one more did here, by the clock, so that launches are left out"
MEAN = "the mean did here, by the clock, with its share of the launches"
ASSUMES = ("a sample of a lit pixel costs what {}, on as many threads a job; the kernels' compilation, fits and filtered "
           "images are left out")


def time_of(out):
    """The stages' rows up to the summary, and one of all these."""
    stages = stage_times(out, LATER)
    return [*stages, {"stage": "all", **{key: round(sum(stage[key] for stage in stages), 2)
                                         for key in ("jobs", "seconds", "cpu_seconds")},
                      "max_rss_mb": max(stage["max_rss_mb"] for stage in stages)}]


def seconds_per_sample(references):
    """Of one sample more, and in words what that is: the slope of the line through the references' samples and seconds, by least squares, which
    leaves out what a launch costs by itself. Where the references do not tell it (all of as many samples, or times
    that fall), the mean, which has it."""
    samples, seconds = zip(*((reference["samples"], reference["seconds"]) for reference in references))
    slope = statistics.linear_regression(samples, seconds).slope if len(set(samples)) > 1 else 0.0
    return (slope, SLOPE) if slope > 0 else (sum(seconds) / sum(samples), MEAN)


def extrapolation(metrics, threads):
    """Core-seconds of the protocol's references, from those of these materials."""
    per_sample, what = seconds_per_sample([taken for document in metrics.values() for taken in document["references"]])
    samples = round(PROTOCOL["materials"] * SURFACES * LIT_PIXELS * PROTOCOL["samples"])
    core_seconds = samples * per_sample * threads
    return PROTOCOL | {"seconds_per_reference_sample": per_sample, "threads": threads, "reference_samples": samples,
                       "core_seconds": core_seconds, "core_hours": core_seconds / 3600, "assumes": ASSUMES.format(what)}

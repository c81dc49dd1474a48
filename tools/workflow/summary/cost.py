"""Time and cost of the experiment, and what the document's whole protocol would take."""
import statistics

from .times import stage_times

PROTOCOL = {"materials": 100, "references": 27, "resolution": [128, 128], "samples": 65536}
PIXELS_ON_SPHERE = 12892  # of 128 x 128, those whose centre is on the sphere
ASSUMES = ("a reference sample costs what one more did here, by the clock, on as many threads a job; what does not "
           "grow with the samples (launches, kernels' compilation, fits, filtered images) is left out")


def time_of(out):
    """The stages' rows, and one of all."""
    stages = stage_times(out)
    return [*stages, {"stage": "all", **{key: round(sum(stage[key] for stage in stages), 2)
                                         for key in ("jobs", "seconds", "cpu_seconds")},
                      "max_rss_mb": max(stage["max_rss_mb"] for stage in stages)}]


def seconds_per_sample(references):
    """Of one sample more: the slope of the line through the references' samples and seconds, by least squares, which
    leaves out what a launch costs by itself. Where the references do not tell it (all of as many samples, or times
    that fall), the mean, which has it."""
    samples, seconds = zip(*((reference["samples"], reference["seconds"]) for reference in references))
    slope = statistics.linear_regression(samples, seconds).slope if len(set(samples)) > 1 else 0.0
    return slope if slope > 0 else sum(seconds) / sum(samples)


def extrapolation(metrics, threads):
    """Core-seconds of the protocol's references, from those of these materials."""
    per_sample = seconds_per_sample([taken for document in metrics.values() for taken in document["references"]])
    samples = PROTOCOL["materials"] * PROTOCOL["references"] * PIXELS_ON_SPHERE * PROTOCOL["samples"]
    core_seconds = samples * per_sample * threads
    return PROTOCOL | {"seconds_per_reference_sample": per_sample, "threads": threads, "reference_samples": samples,
                       "core_seconds": core_seconds, "core_hours": core_seconds / 3600, "assumes": ASSUMES}

"""Time and cost of the experiment, and what the document's whole protocol would take."""
import statistics

from .times import stage_times

PROTOCOL = {"materials": 100, "references": 27, "resolution": [128, 128], "samples": 65536}
PIXELS_ON_SPHERE = 12892  # of 128 x 128, those whose centre is on the sphere
ASSUMES = ("a reference sample costs what it did here, on average over the materials, on as many threads a job; "
           "compiling kernels, fits and filtered images, which do not grow with the samples, are left out")


def time_of(out):
    """The stages' rows, and one of all."""
    stages = stage_times(out)
    return [*stages, {"stage": "all", **{key: round(sum(stage[key] for stage in stages), 2)
                                         for key in ("jobs", "seconds", "cpu_seconds")},
                      "max_rss_mb": max(stage["max_rss_mb"] for stage in stages)}]


def extrapolation(metrics, threads):
    """Core-seconds of the protocol's references, from the seconds per reference sample of these materials."""
    per_sample = statistics.fmean(document["seconds_per_reference_sample"] for document in metrics.values())
    samples = PROTOCOL["materials"] * PROTOCOL["references"] * PIXELS_ON_SPHERE * PROTOCOL["samples"]
    core_seconds = samples * per_sample * threads
    return PROTOCOL | {"seconds_per_reference_sample": per_sample, "threads": threads, "reference_samples": samples,
                       "core_seconds": core_seconds, "core_hours": core_seconds / 3600, "assumes": ASSUMES}

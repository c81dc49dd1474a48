"""What the jobs took, by stage: OUT/times/STAGE/..., which tools/workflow/job writes."""
import json


def clock(seconds):
    """1 h 02 min 03 s, or 4.2 s."""
    if seconds < 60:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest:02d} s" if minutes < 60 else f"{minutes // 60} h {minutes % 60:02d} min {rest:02d} s"


LATER = ("page", "index", "summary_page", "print")  # of the gallery, which the summary is a part of


def jobs_of(out):
    """Stage and times of every job whose results are there."""
    root = out / "times"
    for file in sorted(root.rglob("*.json")):
        yield file.relative_to(root).parts[0].removesuffix(".json"), json.loads(file.read_text())


def stage_times(out, without=()):
    """A row per stage, but for some: jobs, seconds by the clock and of processors, both summed over the jobs, peak of memory."""
    stages = {}
    for stage, took in jobs_of(out):
        if stage in without:
            continue
        row = stages.setdefault(stage, {"stage": stage, "jobs": 0, "seconds": 0.0, "cpu_seconds": 0.0, "max_rss_mb": 0})
        row["jobs"] += 1
        row["seconds"] += took["seconds"]
        row["cpu_seconds"] += took["cpu_seconds"]
        row["max_rss_mb"] = max(row["max_rss_mb"], took["max_rss_mb"])
    return [row | {"seconds": round(row["seconds"], 2), "cpu_seconds": round(row["cpu_seconds"], 2)}
            for row in sorted(stages.values(), key=lambda row: -row["cpu_seconds"])]

"""OUT/report.txt: what was left out, what failed, what it took."""
import json
import pathlib

from summary.times import clock, stage_times
from .folder import write_if_changed


def missing(listed, only):
    """A line per material of the catalogue that has no table, of those that are wanted."""
    return [f"missing: {material['name']}: there is no {material['file']}" for material in listed
            if not material["present"] and (not only or material["name"] in only)]


def complaint(logs):
    """What the job said when it failed: slopemix's first message, else its last line, in the first log that it left."""
    left = next((log for log in logs if log.is_file()), None)
    if not left:
        return "it left no log"
    lines = [line.strip() for line in left.read_text(errors="replace").splitlines() if line.strip()]
    messages = [line for line in lines if line.startswith("slopemix: ")][:1] or [
        line for line in lines if not line.startswith("status ")]
    return messages[-1] if messages else "it said nothing"


def failed(out, logs):
    """A line per stage and material of which jobs failed, with what the first of them said."""
    groups = {}
    for of_job in sorted(logs):
        parts = pathlib.Path(of_job[0]).with_suffix("").parts[1:3]
        groups.setdefault(" of ".join(parts), []).append(of_job)
    return [f"failed: {job}, {len(group)} job{'s' * (len(group) > 1)}: {complaint([out / log for log in group[0]])} "
            f"({group[0][0]})" for job, group in groups.items()]


def without_page(names):
    return [f"left out: {name}: not all of its jobs are done" for name in sorted(names)]


def took(out, seconds, cores):
    """Time of this run, and of all jobs whose results are there, whichever run made them."""
    stages = stage_times(out)
    jobs, cpu = sum(stage["jobs"] for stage in stages), sum(stage["cpu_seconds"] for stage in stages)
    lines = [f"time: {clock(seconds)} for this run, on {cores}",
             f"cost: {clock(cpu)} of one core, in {jobs} jobs, in all runs"]
    return lines + [f"cost: {stage['stage']}: {stage['jobs']} jobs, {clock(stage['cpu_seconds'])} of one core, "
                    f"at most {stage['max_rss_mb']} MB" for stage in stages]


def shortened(lines, most=5):
    """For a terminal: missing tables are counted where there are many."""
    gone = [line for line in lines if line.startswith("missing: ")]
    if len(gone) <= most:
        return lines
    return [f"missing: {len(gone)} tables of the catalogue; report.txt names them", *lines[len(gone):]]


def write(out, lines):
    write_if_changed(out / "report.txt", "".join(line + "\n" for line in lines))


def table(out):
    """The summary over the materials, for a terminal."""
    from summary.table import text

    return text(json.loads(pathlib.Path(out / "gallery" / "summary.json").read_text()))

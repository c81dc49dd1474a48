"""The experiment through the Slurm profile, on a Slurm of one node that the test starts: every job goes through it, and
the results are those of a run on this machine. Where Slurm cannot start, the executor plans the jobs and runs none.

    SOURCE=DIR SLOPEMIX=PROGRAM python3 test_slurm.py
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from folders import SKIPPED, SOURCE, Experiment, make_tables, skip, workflow_python
from one_node_slurm import CannotStart, OneNodeSlurm

FLAGS = ["--res", "16", "--spp", "16", "--shard", "sheet", "--until", "metrics"]
QUICKLY = ["--profile", "slurm", "--", "--seconds-between-status-checks", "2",
           "--slurm-init-seconds-before-status-checks", "1"]
JOBS = 7  # three fits, references, filtered images, comparison, measures


def set_up():
    done = subprocess.run([SOURCE / "tools" / "setup", "--slurm"], capture_output=True, text=True)
    if done.returncode:
        skip(f"Slurm cannot be installed:\n{done.stderr}")


def results(out):
    """What does not depend on where and when it was computed: pixels' digests and errors."""
    sheet = json.loads((out / "sheets" / "gold-paint" / "sheet.json").read_text())
    metrics = json.loads((out / "metrics" / "gold-paint.json").read_text())
    return [image["sha256"] for image in sheet["images"]], metrics["images"]


def expect(is_so, what):
    if not is_so:
        sys.exit(f"FAILED: {what}")
    print(f"ok: {what}")


def through_slurm(slurm, cluster):
    done = cluster.run(*QUICKLY, base=slurm.environment)
    expect(done.returncode == 0, f"the experiment ran on the cluster\n{done.stdout if done.returncode else ''}")
    states = slurm.finished_jobs()
    expect(states == ["COMPLETED"] * JOBS, f"Slurm ran all {JOBS} jobs: {states}")


def planned(cluster, why):
    print(f"Slurm did not start here, the executor only plans: {why}")
    done = cluster.run("--dry-run", *QUICKLY)
    expect(f"{JOBS + 1} jobs to run" in done.stdout,
           f"the executor planned the jobs, and the one that waits for them\n{done.stdout}")


def main():
    set_up()
    python = workflow_python()
    with tempfile.TemporaryDirectory(prefix="slopemix-slurm-") as work:
        work = pathlib.Path(work)
        tables = make_tables(work / "tables", {"gold-paint": "analytic:ggx,alpha=0.2,f0=0.9/0.6/0.3"})
        cluster = Experiment(python, tables, work / "cluster", FLAGS)
        try:
            with OneNodeSlurm(work / "slurm") as slurm:
                through_slurm(slurm, cluster)
        except CannotStart as why:
            planned(cluster, why)
            sys.exit(SKIPPED)
        here = Experiment(python, tables, work / "here", FLAGS)
        expect(here.run("--cores", "2").returncode == 0, "the experiment ran here")
        expect(results(cluster.out) == results(here.out), "images and errors are the same to the bit")


if __name__ == "__main__":
    main()

"""The experiment over two small tables and a damaged one: killed twice at random, resumed, fixed, run again, changed.

    SOURCE=DIR SLOPEMIX=PROGRAM python3 test_experiment.py
"""
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

from folders import Experiment, make_tables, workflow_python

CORES = 2
FLAGS = ["--cores", str(CORES), "--res", "16", "--spp", "16", "--shard", "table", "--worst", "1", "--until", "gallery"]
BEGUN_SECONDS = 300
RESULTS = ("fits/**/*.*", "sheets/**/*.*", "metrics/*", "budget/*", "gallery/**/*.*", "times/**/*.json")
random.seed(10)


def expect(is_so, what, said=""):
    if not is_so:
        sys.exit(f"FAILED: {what}\n{said}")
    print(f"ok: {what}", flush=True)


def results(experiment):
    return {path: time for pattern in RESULTS for path, time in experiment.times(pattern).items()}


def killed_after(experiment, jobs):
    """Starts a run and kills it and its jobs a moment after so many more are done. Returns the times that are there."""
    before, run = len(experiment.times("times/**/*.json")), experiment.start()
    deadline = time.monotonic() + BEGUN_SECONDS
    while len(experiment.times("times/**/*.json")) < before + jobs:
        expect_quietly(run.poll() is None and time.monotonic() < deadline, "the run goes on until it is killed", run)
        time.sleep(0.02)
    time.sleep(random.uniform(0, 0.5))
    os.killpg(run.pid, signal.SIGKILL)
    run.communicate()
    return experiment.times("times/**/*.json")


def expect_quietly(is_so, what, run):
    if not is_so:
        run.kill()
        sys.exit(f"FAILED: {what}\n{run.communicate()[0]}")


def redone(before, after):
    return sorted(path for path, time in before.items() if after.get(path) != time)


def check_killed(experiment):
    """What was finished before a kill is not done again, but for jobs whose end nobody was left to note."""
    for _ in range(2):
        kept = killed_after(experiment, random.randint(2, 5))
        expect(not (experiment.out / "report.txt").exists(), f"killed with {len(kept)} jobs done")
        yield kept


def check_refused(experiment):
    """A second run on the folder of one that is under way."""
    log = experiment.out / "logs" / "snakemake.log"
    log.unlink()
    run = experiment.start()
    while not log.exists():
        expect_quietly(run.poll() is None, "the run begins", run)
        time.sleep(0.02)
    second = experiment.run()
    expect(second.returncode == 2 and "in use by another run" in second.stdout, "a second run on the folder is refused",
           second.stdout)
    return run.communicate()[0], run.returncode


def check_damaged(experiment, said, status):
    report = experiment.report()
    expect(status == 1, "a damaged table makes the exit status 1", said)
    expect("failed: fit of brass" in report and "left out: brass" in report, "the report has the damaged table", report)
    expect("missing: nickel: there is no nickel.binary" in report, "so are tables that are missing", report)
    expect("failed: fit of gold-paint" not in report and report.count("left out:") == 1, "nothing else failed", report)
    file = experiment.out / "gallery" / "summary.json"
    summary = json.loads(file.read_text()) if file.exists() else {}
    expect(summary.get("materials") == 2 and len(summary["worst"]) == 1, "the summary is of the other two")
    pages = {page.stem for page in (experiment.out / "gallery").glob("*.html")}
    expect(pages == {"index", "summary", "gold-paint", "chrome"}, f"so is the gallery: {sorted(pages)}")


def check_same_as_sheet(experiment, slopemix):
    """The images are those of one call that makes the whole sheet."""
    whole = experiment.out.parent / "whole"
    subprocess.run([slopemix, "sheet", experiment.tables / "chrome.binary", "--out", whole, "--model", "both", "--res",
                    "16", "--spp", "16"], check=True, capture_output=True)
    digests = [{image["id"]: image["sha256"] for image in json.loads((folder / "sheet.json").read_text())["images"]}
               for folder in (whole, experiment.out / "sheets" / "chrome")]
    expect(digests[0] == digests[1] and len(digests[0]) == 117, "the images are those of `slopemix sheet`")


def check_again(experiment):
    before = results(experiment)
    again = experiment.run()
    expect(again.returncode == 0 and results(experiment) == before, "a second run does nothing",
           again.stdout + str(redone(before, results(experiment))))


def check_changed(experiment):
    before = results(experiment)
    changed = experiment.run("--seed", "1")
    stages = {path.split("/")[1].removesuffix(".json") for path in redone(before, results(experiment))
              if path.startswith("times/")}
    expect(changed.returncode == 0 and {"reference", "compare", "measure", "summarise", "page"} <= stages,
           f"another seed does anew what it changes: {sorted(stages)}", changed.stdout)
    expect("fit" not in stages, "and not the fits")


def main():
    python = workflow_python()
    with tempfile.TemporaryDirectory(prefix="slopemix-experiment-") as work:
        work = pathlib.Path(work)
        tables = make_tables(work / "tables")
        (tables / "brass.binary").write_bytes(b"no table")
        experiment = Experiment(python, tables, work / "out", FLAGS)
        kept = {}
        for at_kill in check_killed(experiment):
            lost = redone(kept, at_kill)
            expect(len(lost) <= CORES, f"of {len(kept)} finished jobs, done again: {lost}")
            kept = at_kill
        (experiment.out / "gallery").mkdir(exist_ok=True)
        (experiment.out / "gallery" / "brass.html").write_text("of an earlier run")
        said, status = check_refused(experiment)
        lost = redone(kept, experiment.times("times/**/*.json"))
        expect(len(lost) <= CORES, f"of {len(kept)} finished jobs, done again: {lost}")
        check_damaged(experiment, said, status)
        check_same_as_sheet(experiment, os.environ["SLOPEMIX"])
        (tables / "brass.binary").unlink()
        fixed = experiment.run()
        expect(fixed.returncode == 0 and "failed" not in experiment.report(), "without it all is well", fixed.stdout)
        check_again(experiment)
        check_changed(experiment)


if __name__ == "__main__":
    main()

"""Snakemake: what it is called with, and what it says of its jobs."""
import os
import pathlib
import re
import subprocess
import sys

from .folder import Refused

WORKFLOW = pathlib.Path(__file__).parent.parent
STEPS = re.compile(r"(\d+) of (\d+) steps \((\d+)%\) done")
LOG = re.compile(r"^\s+log: (.*?) \(check log file", re.MULTILINE)
NAME = re.compile(r"^\s+wildcards: (?:.*, )?name=([^,\n]+)", re.MULTILINE)
JOBS = re.compile(r"^total\s+(\d+)", re.MULTILINE)


def memory_mb():
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2**20


def place(arguments):
    """Where the jobs run: on so many cores of this machine, or as the profile says."""
    if not arguments.profile:
        return ["--cores", str(arguments.cores), "--resources", f"mem_mb={memory_mb()}"]
    ours = WORKFLOW / "profiles" / arguments.profile
    return ["--profile", str(ours if ours.is_dir() else pathlib.Path(arguments.profile).resolve())]


def command(arguments, out, target):
    """Whose jobs are done stays done: what was begun and not finished is begun again, what changed in settings, inputs
    or version is made anew. Snakemake's own locks are left alone, ours does what they do and goes with its process."""
    return [sys.executable, "-m", "snakemake", target, "--snakefile", str(WORKFLOW / "Snakefile"),
            "--directory", str(out), "--configfile", str(out / "settings.json"), "--keep-going", "--rerun-incomplete",
            "--nolock", "--rerun-triggers", "mtime", "params", "input", "--scheduler", "greedy", *place(arguments),
            *arguments.snakemake]


def run(arguments, out, target, lock, say):
    """Whether all jobs are done, and for each that failed its logs, a cluster's own last. What Snakemake says goes to
    OUT/logs/snakemake.log."""
    (out / "logs").mkdir(exist_ok=True)
    said, shown = [], -1
    with open(out / "logs" / "snakemake.log", "w") as log:
        process = subprocess.Popen(command(arguments, out, target), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, errors="replace", pass_fds=[lock])
        for line in process.stdout:
            log.write(line)
            log.flush()
            said.append(line)
            steps = STEPS.search(line)
            if steps and (int(steps[3]) // 5 > shown or steps[1] == steps[2]):
                shown = int(steps[3]) // 5
                say(f"{steps[1]} of {steps[2]} jobs done")
        status = process.wait()
    return status == 0, {tuple(logs.split(", ")) for logs in LOG.findall("".join(said))}


def unfinished(arguments, out, target):
    """What is still to be done: the number of jobs, and the materials that they are of."""
    done = subprocess.run([*command(arguments, out, target), "--dry-run"], capture_output=True, text=True)
    if done.returncode:
        raise Refused(f"Snakemake cannot plan the jobs:\n{done.stdout}{done.stderr}")
    jobs = JOBS.search(done.stdout + done.stderr)
    return int(jobs[1]) if jobs else 0, set(NAME.findall(done.stdout + done.stderr))

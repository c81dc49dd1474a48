"""Experiments for tests: small tables under names of the catalogue, runs of them, and what a run leaves."""
import os
import pathlib
import subprocess
import sys

SOURCE, SLOPEMIX = pathlib.Path(os.environ["SOURCE"]), os.environ["SLOPEMIX"]
SKIPPED = 77
MATERIALS = {"gold-paint": "analytic:ggx,alpha=0.2,f0=0.9/0.6/0.3", "chrome": "analytic:beckmann,alpha=0.15,f0=0.8"}


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def workflow_python():
    """The Python of the workflow's environment, made if it is missing; without a network the test is skipped."""
    made = subprocess.run([SOURCE / "tools" / "workflow" / "venv"], capture_output=True, text=True)
    if made.returncode:
        skip(f"there is no Python environment for the workflow:\n{made.stderr}")
    return made.stdout.strip()


def make_tables(folder, materials=MATERIALS):
    folder.mkdir(parents=True)
    for name, material in materials.items():
        subprocess.run([SLOPEMIX, "synth", material, "--out", folder / f"{name}.binary"], check=True,
                       stdout=subprocess.DEVNULL)
    return folder


class Experiment:
    """tools/experiment without setting up and building."""

    def __init__(self, python, tables, out, flags):
        self.python, self.tables, self.out, self.flags = python, tables, out, flags

    def command(self, *more):
        return [self.python, "-m", "experiment", str(self.tables), str(self.out), *self.flags, *more]

    def environment(self, base=os.environ):
        return base | {"PYTHONPATH": str(SOURCE / "tools" / "workflow"), "PYTHONDONTWRITEBYTECODE": "1"}

    def run(self, *more, base=os.environ):
        return subprocess.run(self.command(*more), env=self.environment(base), stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def start(self, *more):
        """In a process group of its own, to be killed with all its jobs."""
        return subprocess.Popen(self.command(*more), env=self.environment(), stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def report(self):
        return (self.out / "report.txt").read_text()

    def times(self, pattern):
        """When each of these files was written, by its path."""
        return {str(file.relative_to(self.out)): file.stat().st_mtime_ns for file in self.out.glob(pattern)}

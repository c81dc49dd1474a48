"""A Slurm of one node in a folder: munged, slurmctld and slurmd, with a key, socket, ports and state of their own.

It needs root, and Debian's munge, slurmctld, slurmd and slurm-client; no systemd, no cgroups, no accounting. A text
file tells of finished jobs.
"""
import os
import pathlib
import shutil
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "squeue", "sinfo", "scontrol")
START_SECONDS = 30
CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthInfo=socket={folder}/munge.socket
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc={folder}/jobs.txt
MpiDefault=none
ReturnToService=2
MinJobAge=3600
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory}
PartitionName=main Nodes={host} Default=YES State=UP
"""


class CannotStart(Exception):
    """Why there is no Slurm here."""


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class OneNodeSlurm:
    """A context: the environment by which Slurm's commands find it. Leaving it ends what it started."""

    def __init__(self, folder):
        self.folder, self.processes = pathlib.Path(folder), []

    def __enter__(self):
        missing = [program for program in PROGRAMS if not shutil.which(program, path=self.path())]
        if missing or os.geteuid() != 0:
            raise CannotStart(f"it needs root and {', '.join(PROGRAMS)}; missing: {', '.join(missing) or 'root'}")
        self.write_configuration()
        try:
            self.start_munge()
            self.start("slurmctld", "-D", "-c")
            self.start("slurmd", "-D")
            self.wait_until("the node is idle", lambda: "idle" in self.said("sinfo", "--noheader", "--format=%T"))
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def path(self):
        return f"{self.folder}/bin:{os.environ['PATH']}:/usr/sbin:/sbin"

    @property
    def environment(self):
        return os.environ | {"SLURM_CONF": str(self.folder / "slurm.conf"), "PATH": self.path()}

    def write_configuration(self):
        for name in ("state", "spool", "bin"):
            (self.folder / name).mkdir(parents=True)
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2**20 * 9 // 10
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            folder=self.folder, host=socket.gethostname().split(".")[0], controller_port=free_port(),
            node_port=free_port(), cpus=os.cpu_count(), memory=memory).lstrip())
        # Nothing here uses control groups; the first version's plugin asks for no systemd.
        (self.folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")

        # Snakemake's plugin takes SLURM_CONF from the environment of the steps that it starts.
        srun = self.folder / "bin" / "srun"
        srun.write_text(f"#!/bin/sh\nSLURM_CONF={self.folder}/slurm.conf exec {shutil.which('srun')} \"$@\"\n")
        srun.chmod(0o755)

    def start_munge(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        files = {"socket": "munge.socket", "pid-file": "munge.pid", "log-file": "munge.log", "seed-file": "munge.seed"}
        self.start("munged", "--foreground", "--force", f"--key-file={key}",
                   *(f"--{option}={self.folder / name}" for option, name in files.items()))
        self.wait_until("munge answers", (self.folder / "munge.socket").exists)

    def start(self, *command):
        with open(self.folder / f"{command[0]}.out", "w") as out:
            self.processes.append(subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=out,
                                                   stderr=subprocess.STDOUT))

    def said(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True).stdout

    def wait_until(self, what, is_so):
        for _ in range(10 * START_SECONDS):
            if is_so():
                return
            ended = [process.args[0] for process in self.processes if process.poll() is not None]
            if ended:
                break
            time.sleep(0.1)
        logs = "".join(f"{log}:\n{log.read_text(errors='replace')[-1500:]}\n"
                       for log in sorted(self.folder.glob("*.out")))
        raise CannotStart(f"not so after {START_SECONDS} s: {what}\n{logs}")

    def finished_jobs(self):
        """State of every job that has ended."""
        file = self.folder / "jobs.txt"
        lines = file.read_text().splitlines() if file.exists() else []
        return [dict(part.split("=", 1) for part in line.split() if "=" in part).get("JobState") for line in lines]

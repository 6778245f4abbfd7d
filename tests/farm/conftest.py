# SPDX-License-Identifier: GPL-3.0-or-later
"""Slurm on this machine alone: its controller and one node, started for these tests."""

from __future__ import annotations

import os
import pwd
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests"), str(ROOT / "tests" / "core")]

from processor_time import pytest_runtest_protocol  # noqa: E402, F401

CONFIGURATION = """\
ClusterName=meander
SlurmctldHost={host}
SlurmUser=root
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdParameters=config_overrides
NodeName={host} CPUs=4 RealMemory={megabytes} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


@pytest.fixture(scope="session")
def slurm(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """The environment in which Slurm's commands find the one that was started."""
    for program in ("munged", "slurmctld", "slurmd", "sbatch"):
        assert shutil.which(program), f"{program} is missing; scripts/test_farm.sh installs it"
    assert os.geteuid() == 0, "Slurm's daemons have to be started by root"
    folder = tmp_path_factory.mktemp("slurm")
    for name in ("state", "spool"):
        (folder / name).mkdir()
    megabytes = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20
    text = CONFIGURATION.format(host=socket.gethostname(), folder=folder, megabytes=megabytes)
    (folder / "slurm.conf").write_text(text)
    environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
    munge = start_munge()
    daemons = [
        subprocess.Popen([program, "-D"], env=environment, stderr=subprocess.DEVNULL)
        for program in ("slurmctld", "slurmd")
    ]
    try:
        end = time.monotonic() + 30
        while "idle" not in answer(["sinfo", "-h", "-o", "%T"], environment):
            assert time.monotonic() < end, (folder / "slurmctld.log").read_text()[-2000:]
            time.sleep(0.2)
        yield environment
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
            daemon.wait(timeout=20)
        if munge is not None:
            munge.terminate()
            munge.wait(timeout=20)


def start_munge() -> subprocess.Popen | None:
    """Starts what Slurm knows its own by; None: it runs already."""
    if Path("/run/munge/munge.socket.2").exists() and not subprocess.run(
        "munge -n | unmunge", shell=True, capture_output=True
    ).returncode:
        return None
    user = pwd.getpwnam("munge")
    os.makedirs("/run/munge", mode=0o755, exist_ok=True)
    os.chown("/run/munge", user.pw_uid, user.pw_gid)
    command = ["runuser", "-u", "munge", "--", "munged", "--foreground", "--force"]
    started = subprocess.Popen(command)
    time.sleep(1)
    return started


def answer(command: list[str], environment: dict[str, str]) -> str:
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    return done.stdout

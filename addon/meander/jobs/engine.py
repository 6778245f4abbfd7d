# SPDX-License-Identifier: GPL-3.0-or-later
"""What fills an item: the batch command in Blender, or in plain Python where that is enough."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

from . import options
from .items import Item
from .job_file import JobError, JobFile

_PACKAGE = Path(__file__).resolve().parents[1]
# Scripts for Blender, which the Python package does not have.
_BATCH = _PACKAGE / "batch.py"
_FARM = _PACKAGE / "farm.py"


def _running_blender() -> str:
    """The Blender that this runs in; empty: none."""
    bpy = sys.modules.get("bpy")
    return "" if bpy is None else bpy.app.binary_path


def blender_of(job: JobFile) -> list[str]:
    """Blender in the background and without the user's settings, before all other arguments."""
    program = job.blender or _running_blender() or "blender"
    return [program, "--background", "--factory-startup"]


def _python_of(job: JobFile) -> str:
    """A Python with numpy; empty: none is known."""
    # In Blender sys.executable may be any program.
    return job.python or ("" if _running_blender() else sys.executable)


def command_of(job: JobFile, item: Item, threads: int) -> list[str]:
    """The command line of an item, its threads included. Raises JobError."""
    flags = [*item.arguments, f"--report={item.report}"]
    if item.options.threads == 0:
        flags.append(f"--threads={threads}")
    if job.command:
        return [*job.command, *flags]
    in_blender = options.needs_blender(item.options)
    if job.engine == "python":
        if in_blender:
            raise JobError(
                f'{item.name} needs Blender, and [job] says engine = "python"; write '
                'engine = "auto"'
            )
        if not _python_of(job):
            raise JobError('which Python is to be used? Name it with python = "..." in [job]')
    if not _BATCH.is_file():
        if in_blender or job.engine == "blender":
            raise JobError(
                f"{item.name} needs Blender, which the Python package does not know; start the "
                "job by farm.py of the add-on"
            )
        return [_python_of(job), "-m", _PACKAGE.name, *flags]
    if job.engine == "blender" or in_blender or not _python_of(job):
        return [*blender_of(job), "--python-exit-code", "1", "--python", str(_BATCH), "--", *flags]
    return [_python_of(job), str(_BATCH), "--", *flags]


def missing_program(job: JobFile, items: list[Item]) -> str | None:
    """A sentence about the first program that is needed and not there, or None."""
    for program in dict.fromkeys(command_of(job, item, 1)[0] for item in items):
        if shutil.which(program) is None:
            key = "command" if job.command else "blender or python"
            return f"there is no program {program!r}; name it with {key} in [job]"
    return None


def name_of_command() -> str:
    """What this command is called in its own help."""
    return _FARM.name if _FARM.is_file() else f"python -m {_PACKAGE.name}.jobs"


def this_command() -> list[str]:
    """How this very command is started again, before its own arguments."""
    blender = _running_blender()
    if not _FARM.is_file():
        return [sys.executable, "-m", f"{_PACKAGE.name}.jobs"]
    if not blender:
        return [sys.executable, str(_FARM)]
    start = [blender, "--background", "--factory-startup", "--python-exit-code", "1"]
    return [*start, "--python", str(_FARM), "--"]


def processors() -> int:
    """How many processors this process may use; Slurm says how many are meant for it."""
    granted = os.environ.get("SLURM_CPUS_PER_TASK", "")
    if granted.isdigit() and int(granted) > 0:
        return int(granted)
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1

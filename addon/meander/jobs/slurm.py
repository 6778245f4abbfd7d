# SPDX-License-Identifier: GPL-3.0-or-later
"""A script that Slurm runs as an array: each of its tasks does one shard of a job."""

from __future__ import annotations

import math
import os
import shlex

from .engine import this_command
from .folder import Folder
from .items import Item, shard_of
from .job_file import JobFile

# What this command itself needs beside the items, and how long it needs to begin.
_OWN_MEGABYTES = 200
_OWN_SECONDS = 60


def script_of(job: JobFile, items: list[Item], folder: Folder, tasks: int, at_once: int) -> str:
    """The text of an sbatch script.

    tasks    of the array; those that would have no item are left out
    at_once  how many items a task runs at the same time, on a processor each

    Time and memory are asked for where every item has a limit of its own.
    """
    tasks = min(tasks, len(items))
    name = job.path.stem
    lines = [
        "#!/bin/sh",
        f"#SBATCH --job-name={_word(name)}",
        f"#SBATCH --array=1-{tasks}",
        f"#SBATCH --cpus-per-task={at_once}",
        f'#SBATCH --output="{os.path.abspath(folder.path)}/slurm-%A-%a.log"',
    ]
    memory = [item.memory for item in items if item.memory is not None]
    if len(memory) == len(items):
        lines.append(f"#SBATCH --mem={math.ceil(_OWN_MEGABYTES + at_once * max(memory))}M")
    times = [item.timeout for item in items if item.timeout is not None]
    if len(times) == len(items):
        longest = max(_seconds_of(items, task, tasks, at_once) for task in range(1, tasks + 1))
        lines.append(f"#SBATCH --time={math.ceil((_OWN_SECONDS + longest) / 60)}")
    command = [*this_command(), os.path.abspath(job.path), "--jobs", str(at_once)]
    lines += [
        "# Submitted again, it goes on with what is not done.",
        f'exec {shlex.join(command)} --shard "$SLURM_ARRAY_TASK_ID/{tasks}"',
    ]
    return "\n".join(lines) + "\n"


def _seconds_of(items: list[Item], task: int, tasks: int, at_once: int) -> float:
    """The longest that a task may take, if every item took all of its time."""
    times = [item.timeout or 0.0 for item in shard_of(items, task, tasks)]
    return math.ceil(len(times) / at_once) * max(times)


def _word(text: str) -> str:
    return "".join(letter if letter.isalnum() or letter in "-_." else "_" for letter in text)

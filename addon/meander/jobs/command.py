# SPDX-License-Identifier: GPL-3.0-or-later
"""The command that runs a job, from its options to its exit code."""

from __future__ import annotations

import argparse
import os
import re
import shlex
import sys
import traceback
from collections.abc import Iterator, Sequence
from pathlib import Path

from ..cli.exit_code import print_any_letters, sent
from ..cli.values import BadInput, Parser, file_name, reader
from ..model.files.whole import FileError
from . import engine
from .folder import Folder
from .items import Item, items_of, shard_of
from .job_file import JobError, JobFile, read
from .objects import Meshes
from .progress import Progress, said, write_summary
from .slurm import script_of
from .worker import Worker

_ELSEWHERE = "send it elsewhere"
_SHARD = re.compile(r"(\d{1,6})/(\d{1,6})")


def main(argv: Sequence[str]) -> int:
    """Runs the command and returns its exit code: 0 all items are done, 1 some are not, 2 the job
    cannot be run, 130 interrupted.

    argv   its arguments
    """
    print_any_letters()
    try:
        return _run(_parser().parse_args(argv))
    except (BadInput, JobError, FileError) as problem:
        said(" ".join(str(problem).split()))
        return 2
    except KeyboardInterrupt:  # before anything runs, or after that
        said("interrupted")
        return 130
    except Exception:
        traceback.print_exc()
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog=engine.name_of_command(),
        description="Fill many surfaces: run what a job file says and is not done yet.",
        allow_abbrev=False,
    )
    add = parser.add_argument
    add("job", type=file_name, metavar="JOB", help="the job file, TOML")
    add("--jobs", type=reader(int, 1, 1024), default=1, metavar="N", help="items run at once")
    add("--shard", metavar="I/N", help="only part I of N, counted from 1")
    add("--again", action="store_true", help="run what is done, too")
    add("--quiet", action="store_true", help="say nothing but what fails")
    add(
        "--summary",
        type=file_name,
        metavar="JSON",
        help="default: summary.json in the job's folder",
    )
    instead = parser.add_mutually_exclusive_group()
    add = instead.add_argument
    add("--list", action="store_true", help="run nothing: print every item and its state")
    add("--dry-run", action="store_true", help="run nothing: print the commands")
    add("--status", action="store_true", help="run nothing: say what is done and what failed")
    add(
        "--slurm",
        type=reader(int, 1, 100000),
        metavar="N",
        help="run nothing: print a script for sbatch, an array of N tasks",
    )
    return parser


def _run(arguments: argparse.Namespace) -> int:
    number, count = _shard(arguments.shard)
    job = read(arguments.job)
    folder = Folder(job.folder)
    looks = arguments.list or arguments.dry_run or arguments.status or arguments.slurm
    # A look at a job leaves nothing behind.
    kept = folder.state / "objects" if not looks or folder.state.is_dir() else None
    name = "summary.json" if count == 1 else f"summary-{number}-of-{count}.json"
    summary = arguments.summary or folder.path / name
    if arguments.summary is not None and not looks:
        _check_place(summary)
    items = items_of(job, Meshes(engine.blender_of(job), kept), summary)
    if arguments.slurm is not None:
        if arguments.shard is not None:
            raise JobError("--slurm makes the shards itself; leave --shard out")
        folder.make(items)  # Slurm writes its logs there
        script = script_of(job, items, folder, arguments.slurm, arguments.jobs)
        sent(lambda: print(script, end=""), _ELSEWHERE)
        return 0
    items = shard_of(items, number, count)
    if arguments.list or arguments.dry_run:
        lines = _listed if arguments.list else _commands
        sent(lambda: _print(lines(job, items, folder, arguments)), _ELSEWHERE)
        return 0
    progress = Progress(len(items), arguments.jobs, arguments.quiet)
    finished = True
    if arguments.status:
        _look(items, folder, progress)
    else:
        missing = engine.missing_program(job, items)
        if missing is not None:
            raise JobError(missing)
        if sys.platform != "linux" and any(item.memory is not None for item in items):
            said("memory is limited on Linux only; here it is not")
        folder.make(items)
        shared = arguments.shard is None
        worker = Worker(job, items, folder, progress, arguments.jobs, shared, arguments.again)
        finished = worker.run()
    progress.conclude(interrupted=not finished)
    if not arguments.status or arguments.summary is not None:
        told = {"job": str(job.path), "shard": arguments.shard, "interrupted": not finished}
        write_summary(summary, told | progress.summary())
    if not finished:
        return 130
    return 1 if progress.failures or progress.left else 0


def _check_place(summary: Path) -> None:
    """Refuses a summary that could not be written when all is done. Raises JobError."""
    if summary.is_dir():
        raise JobError(f"--summary {summary} is a folder; give a file name")
    if not summary.absolute().parent.is_dir():
        raise JobError(f"the folder of --summary {summary} does not exist; make it first")


def _shard(text: str | None) -> tuple[int, int]:
    if text is None:
        return 1, 1
    match = _SHARD.fullmatch(text)
    number, count = (0, 0) if match is None else map(int, match.groups())
    if not 1 <= number <= count:
        raise BadInput(f"--shard {text} is no part of a whole; give one such as 2/4")
    return number, count


def _state_of(item: Item, folder: Folder) -> tuple[str, str]:
    """Of an item: "done", "failed" and why, or "left"."""
    key = folder.key_of(item)
    if folder.is_done(item, key):
        return "done", ""
    failure = folder.failure_since(item, key, 0.0)
    return ("failed", failure) if failure else ("left", "")


def _print(lines: Iterator[str]) -> None:
    for line in lines:
        print(line)


def _listed(
    job: JobFile, items: list[Item], folder: Folder, _arguments: argparse.Namespace
) -> Iterator[str]:
    for item in items:
        state, _sentence = _state_of(item, folder)
        source = os.path.relpath(item.options.input, job.path.parent)
        yield f"{state:6}  {item.name}  from {source}"


def _commands(
    job: JobFile, items: list[Item], folder: Folder, arguments: argparse.Namespace
) -> Iterator[str]:
    threads = max(1, engine.processors() // arguments.jobs)
    for item in items:
        if arguments.again or _state_of(item, folder)[0] != "done":
            yield shlex.join(engine.command_of(job, item, threads))


def _look(items: list[Item], folder: Folder, progress: Progress) -> None:
    for item in items:
        state, sentence = _state_of(item, folder)
        if state == "done":
            progress.was_done(item)
        elif state == "failed":
            progress.had_failed(item, sentence)

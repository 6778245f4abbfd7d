# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the sweep: which there are, how one is run within its limits, the file of their rows."""

from __future__ import annotations

import hashlib
import itertools
import json
import signal
import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "sweep_run"

FACTORS = (0.1, 0.3, 1.0, 3.0, 10.0)
PRESETS = ("even", "paper", "finest")
MEASURES = ("euclidean", "geodesic")
SEEDS = (1, 2, 3)  # see seed_of() in inputs.py


@dataclass(frozen=True)
class Run:
    """One run: everything that decides what comes out. `factor` is of the nominal radius."""

    model: str
    factor: float
    preset: str
    measure: str
    seed: int
    threads: int = 1
    most_iterations: int = 0  # 0: as the preset has it


@dataclass(frozen=True)
class Limits:
    """What a run may take: processor seconds after which no iteration begins (0: any number), and
    what ends it by force: seconds of a processor and by the clock, and bytes of memory."""

    seconds: float = 0.0
    processor: int = 3600
    clock: float = 36000.0
    memory: int = 6 << 30


def all_runs(
    models: Iterable[str], factors: Iterable[float] = FACTORS, threads: int = 1
) -> list[Run]:
    """Every model with every combination, in an order that is always the same and favours none: a
    sweep that is ended early is a sample of the whole."""
    combinations = itertools.product(models, factors, PRESETS, MEASURES, SEEDS)
    runs = [Run(*combination, threads) for combination in combinations]
    return sorted(runs, key=lambda run: hashlib.sha256(repr(run).encode()).digest())


def short_runs(models: Iterable[str]) -> Iterator[Run]:
    """One short run of every model; together they have every radius, preset, measure and seed."""
    for i, name in enumerate(models):
        factor = (1.0, 3.0, 0.3)[i % 3]
        yield Run(name, factor, PRESETS[i // 2 % 3], MEASURES[i % 2], SEEDS[i // 3 % 3], 1, 12)


def run_one(
    run: Run, input_file: Path, radius: float, limits: Limits, program: Path = PROGRAM
) -> dict[str, Any]:
    """The row of a run: what it was, and what came of it.

    The run is a process of its own. One that crashes has the outcome "crash" and the name of the
    signal as its reason, one that takes too long "hang", one without an answer "no answer".
    """
    # Of util-linux; a preexec_fn is not safe where several threads start runs.
    command = ["prlimit", f"--as={limits.memory}", f"--cpu={limits.processor}:", "--core=0"]
    command += [str(program), str(input_file), repr(radius), run.preset, run.measure]
    command += [str(run.most_iterations), str(run.threads), repr(limits.seconds)]

    row: dict[str, Any] = {**asdict(run), "radius": radius}
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limits.clock)
    except subprocess.TimeoutExpired:
        return {**row, "outcome": "hang", "reason": f"not done after {limits.clock:g} s"}
    if done.returncode == -signal.SIGXCPU:
        reason = f"not done after {limits.processor} s of a processor"
        return {**row, "outcome": "hang", "reason": reason}
    if done.returncode < 0:
        return {**row, "outcome": "crash", "reason": signal.Signals(-done.returncode).name}
    try:
        return {**row, **json.loads(done.stdout)}
    except json.JSONDecodeError:
        text = (done.stderr.strip().splitlines() or ["it said nothing"])[-1]
        return {**row, "outcome": "no answer", "reason": f"exit code {done.returncode}: {text}"}


def read_rows(path: Path) -> list[dict[str, Any]]:
    """The rows of a file, which may not be there; a last line that was cut off is left out."""
    if not path.is_file():
        return []
    rows = []
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            rows.append(json.loads(line))
        except json.JSONDecodeError:
            continue
    return rows


def run_of(row: dict[str, Any]) -> Run:
    """Which run a row is of."""
    return Run(**{name: row[name] for name in Run.__dataclass_fields__})


def append_row(path: Path, row: dict[str, Any]) -> None:
    """Adds a row; also after a line that was cut off."""
    begin = "" if not path.is_file() or path.read_bytes()[-1:] in (b"", b"\n") else "\n"
    with open(path, "a", encoding="utf-8") as file:
        file.write(begin + json.dumps(row) + "\n")


# Outcomes that a run may have, and those that only a defect explains.
EXPECTED = ("converged", "limit", "stalled", "time", "refused")


def failed(row: dict[str, Any]) -> bool:
    """Is anything wrong with the run of this row?"""
    if row["outcome"] not in EXPECTED:
        return True
    return row["outcome"] == "refused" and not row["reason"] or bool(row.get("faults"))

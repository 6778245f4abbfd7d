# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the sweep: every surface of shapes.py and meshes_at_the_limit.py, and of a folder, with all
radii, presets, measures of distance and seeds; each curve is checked after every iteration.

    python3 tests/sweep/sweep.py --rows build/sweep/rows.jsonl [--models FOLDER] [--seconds 20]

Every run is a line of JSON in the file. Runs that stand there already are left out, so that the
same command goes on where it was interrupted. summary.py makes a table of the file.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests" / "core"), str(ROOT / "addon")]

from geometry import Mesh  # noqa: E402
from inputs import seed_of, write_input  # noqa: E402
from meander.model.files.meshes import SUFFIXES, read_mesh  # noqa: E402
from meshes_at_the_limit import FAULTY  # noqa: E402
from rows import (  # noqa: E402
    FACTORS,
    PROGRAM,
    Limits,
    Run,
    all_runs,
    append_row,
    failed,
    read_rows,
    run_of,
    run_one,
    short_runs,
)
from shapes import SHAPES, nominal_radius  # noqa: E402

Models = dict[str, Callable[[], Mesh]]


def models_in(folder: Path) -> Models:
    """The meshes in the files of a folder, by their names."""

    def reader(path: Path) -> Callable[[], Mesh]:
        return lambda: Mesh(*read_mesh(path))

    files = sorted(path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES)
    if not files:
        sys.exit(f"sweep.py: {folder} has no {', '.join(SUFFIXES)} files; name another folder")
    return {path.name: reader(path) for path in files}


class Sweep:
    """The models of a sweep, and the files that its runs read, which are made once each. Runs may
    be asked for by several threads."""

    def __init__(
        self, models: Models, folder: Path, limits: Limits, program: Path = PROGRAM
    ) -> None:
        self.models = models
        self.folder = folder
        self.limits = limits
        self.program = program
        self.inputs: dict[tuple[str, int], tuple[Path, float]] = {}
        self.making = threading.Lock()

    def run(self, run: Run) -> dict:
        """The row of a run."""
        with self.making:
            path, radius = self._input(run.model, run.seed)
        return run_one(run, path, run.factor * radius, self.limits, self.program)

    def _input(self, model: str, number: int) -> tuple[Path, float]:
        """The file of a model with a seed, and the nominal radius."""
        if (model, number) not in self.inputs:
            path = self.folder / f"{len(self.inputs)}.bin"
            mesh = self.models[model]()
            # What is no surface has no seeds that lie on it, and perhaps no area.
            write_input(path, mesh, None if model in FAULTY else seed_of(mesh, number))
            radius = 0.1 if model in FAULTY else nominal_radius(mesh)
            self.inputs[model, number] = path, radius
        return self.inputs[model, number]


def rows_of(sweep: Sweep, runs: Iterable[Run], jobs: int) -> Iterator[dict]:
    """The rows of runs, `jobs` at a time, as they end. No run begins that is not asked for."""
    left = iter(runs)
    pending: set[Future[dict]] = set()
    with ThreadPoolExecutor(jobs) as pool:
        while True:
            while len(pending) < jobs and (run := next(left, None)) is not None:
                pending.add(pool.submit(sweep.run, run))
            if not pending:
                return
            done, pending = wait(pending, return_when=FIRST_COMPLETED)
            yield from (future.result() for future in done)


def said(row: dict) -> str:
    """A row in one line."""
    of = f"{row['model']} {row['factor']:g} {row['preset']} {row['measure']} {row['seed']}"
    return f"{of}: {row['outcome']} {row.get('reason', '')} {row.get('first_fault', '')}".rstrip()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--rows", type=Path, required=True, help="the file of rows, added to")
    parser.add_argument("--models", type=Path, metavar="FOLDER", help="more meshes: OBJ, PLY, STL")
    parser.add_argument("--only", default="", metavar="SUBSTRING", help="of the names of models")
    factors = ",".join(f"{factor:g}" for factor in FACTORS)
    parser.add_argument("--factors", default=factors, help="radii, in nominal radii, with commas")
    parser.add_argument(
        "--seconds", type=float, default=20, help="of a processor, after which a run ends; 0: never"
    )
    parser.add_argument("--threads", type=int, default=1, help="of each run")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--minutes", type=float, default=0.0, help="of all runs together; 0: any")
    parser.add_argument("--program", type=Path, default=PROGRAM, help="that makes one run")
    parser.add_argument("--short", action="store_true", help="a short run of every model")
    arguments = parser.parse_args()

    models: Models = {**SHAPES, **FAULTY}
    if arguments.models is not None:
        models |= models_in(arguments.models)
    models = {name: make for name, make in models.items() if arguments.only in name}
    factors = [float(part) for part in arguments.factors.split(",")]
    sound = [name for name in models if name not in FAULTY]
    runs = [Run(name, 1.0, "even", "geodesic", 1) for name in models if name in FAULTY]
    runs += short_runs(sound) if arguments.short else all_runs(sound, factors, arguments.threads)
    # By a processor, so that on a busy machine a run that waits is not taken for one that hangs.
    most = int(20 * arguments.seconds * arguments.threads) + 120
    limits = Limits(arguments.seconds, most, clock=20.0 * most)
    arguments.rows.parent.mkdir(parents=True, exist_ok=True)
    done = {run_of(row) for row in read_rows(arguments.rows)}
    begin, bad, count = time.monotonic(), 0, 0

    def left() -> Iterator[Run]:
        for run in runs:
            if run in done:
                continue
            if arguments.minutes and time.monotonic() - begin > 60 * arguments.minutes:
                print("sweep.py: the minutes are over; the same command goes on from here")
                return
            yield run

    with tempfile.TemporaryDirectory() as folder:
        sweep = Sweep(models, Path(folder), limits, arguments.program)
        for row in rows_of(sweep, left(), arguments.jobs):
            append_row(arguments.rows, row)
            count += 1
            if failed(row):
                bad += 1
                print(said(row), flush=True)
    print(f"sweep.py: {count} runs, {bad} of them failed")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

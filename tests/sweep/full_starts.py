# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts full starts: every surface of shapes.py and meshes_at_the_limit.py, and of a folder, at
twelve spacings and with three first faces, each for one iteration, whose curve is checked.

    python3 tests/sweep/full_starts.py [--models FOLDER] [--only torus] [--least 0.4] [--rows FILE]
    python3 tests/sweep/full_starts.py --summary FILE

A line for every start that is shorter than a share of a curve that fills the surface, for every one
with a part that grows, and for every fault; then how many there are. Radii are from a 20th to a
200th of the root of the area. With --rows every start is added to a file as JSON, and those that
are there already are left out. --summary prints a JSON object for every radius of such a file,
which scripts/result_tables.py keeps for docs/reliability.md.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests" / "core"), str(ROOT / "addon")]

from geometry import Mesh  # noqa: E402
from inputs import write_input  # noqa: E402
from meshes_at_the_limit import FAULTY  # noqa: E402
from rows import Limits, Run, append_row, read_rows, run_one  # noqa: E402
from shapes import SHAPES, area_of  # noqa: E402
from sweep import models_in  # noqa: E402

Row = dict[str, Any]
Key = tuple[str, float, int, int]

SPACINGS, FIRST_FACES = 12, 3
LIMITS = Limits(processor=60)  # a start takes a few seconds; what takes longer is told as a hang


def key_of(row: Row) -> Key:
    return row["model"], row["side"], row["first_face"], row["most_iterations"]


def starts_of(name: str, mesh: Mesh, folder: Path, iterations: int, known: set[Key]) -> Iterator:
    """A row for each spacing and first face that is not known, with `side`, the root of the area in
    radii, and `filled`, the length over that of a full curve."""
    root = area_of(mesh) ** 0.5
    path = folder / f"{abs(hash(name))}.bin"
    for turn in range(FIRST_FACES):
        faces = np.roll(mesh.faces, -(turn * len(mesh.faces) // FIRST_FACES), axis=0)
        write_input(path, Mesh(mesh.vertices, faces), None)
        for side in np.geomspace(20, 200, SPACINGS).round(1).tolist():
            if (name, side, turn, iterations) in known:
                continue
            run = Run(name, 20 / side, "full", "preset", 1, 1, iterations)
            row = run_one(run, path, root / side, LIMITS)
            filled = row.get("length", 0.0) * 2 / root / side
            yield row | {"side": side, "first_face": turn, "filled": filled}
    path.unlink()


def grown_parts(row: Row) -> int:
    return row.get("no_room_parts", 0) + row.get("crossing_parts", 0)


def grown_as_a_whole(row: Row) -> bool:
    return row["outcome"] in ("limit", "converged") and row["full_parts"] == 0


def is_wrong(row: Row) -> bool:
    return bool(row.get("faults")) or row["outcome"] not in ("limit", "converged")


def said(row: Row) -> str:
    parts = "".join(
        f", {row.get(name, 0)} parts {what}"
        for name, what in (
            ("full_parts", "full"),
            ("no_room_parts", "without room"),
            ("crossing_parts", "not laid without a crossing"),
        )
        if row.get(name, 0)
    )
    return (
        f"{row['model']}, root of the area {row['side']:g} r, first face {row['first_face']}: "
        f"{row['outcome']}, filled {row['filled']:.2f}, empty {row.get('empty', 1):.4f}{parts} "
        f"{row.get('reason', '')} {row.get('first_fault', '')}"
    ).rstrip()


def summary(rows: list[Row]) -> list[Row]:
    """A row for every radius."""
    by_side: dict[float, list[Row]] = defaultdict(list)
    for row in rows:
        by_side[row["side"]].append(row)
    return [
        {
            "side": side,
            "starts": len(starts),
            "full_parts": sum(row.get("full_parts", 0) for row in starts),
            "no_room": sum(row.get("no_room_parts", 0) for row in starts),
            "not_laid": sum(row.get("crossing_parts", 0) for row in starts),
            "whole": sum(grown_as_a_whole(row) for row in starts),
            "crossings": sum(row.get("crossings", 0) for row in starts),
            "wrong": sum(is_wrong(row) for row in starts),
        }
        for side, starts in sorted(by_side.items())
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--models", type=Path, metavar="FOLDER", help="more meshes: OBJ, PLY, STL")
    parser.add_argument("--no-shapes", action="store_true", help="only those of the folder")
    parser.add_argument("--only", default="", metavar="SUBSTRING", help="of the names of models")
    parser.add_argument("--least", type=float, default=0.4, help="share of a full curve's length")
    parser.add_argument("--iterations", type=int, default=1, help="of each start; 0: to its end")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--rows", type=Path, help="of starts that were made, and of those to come")
    parser.add_argument("--summary", type=Path, metavar="FILE", help="only prints what is in it")
    options = parser.parse_args()
    if options.summary:
        for row in summary(read_rows(options.summary)):
            print(json.dumps(row))
        return 0
    models = {name: make for name, make in SHAPES.items() if name not in FAULTY}
    if options.no_shapes:
        models = {}
    if options.models:
        models |= models_in(options.models)
    names = [name for name in models if options.only in name]
    known = {key_of(row) for row in read_rows(options.rows)} if options.rows else set()
    total = short = grown = whole = wrong = 0

    def made_of(name: str, folder: Path) -> list[Row]:
        rows = []
        for row in starts_of(name, models[name](), folder, options.iterations, known):
            rows.append(row)
            if options.rows:
                append_row(options.rows, row)
        return rows

    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.jobs) as pool:
        for rows in pool.map(lambda name: made_of(name, Path(folder)), names):
            for row in rows:
                total += 1
                short += row["filled"] < options.least
                grown += grown_parts(row)
                whole += grown_as_a_whole(row)
                wrong += is_wrong(row)
                if row["filled"] < options.least or grown_parts(row) or is_wrong(row):
                    print(said(row), flush=True)
    print(
        f"{total} full starts, {short} shorter than {options.least}, {wrong} wrong, {whole} grown "
        f"as a whole, {grown} parts grown"
    )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

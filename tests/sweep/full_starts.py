# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts full starts: every surface of shapes.py and meshes_at_the_limit.py, and of a folder, at
twelve spacings and with three first faces, each for one iteration, whose curve is checked.

    python3 tests/sweep/full_starts.py [--models FOLDER] [--only torus] [--least 0.4]

A line for every start that is shorter than a share of a curve that fills the surface, and for every
fault; then how many there are. Radii are from a 20th to a 200th of the root of the area.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests" / "core"), str(ROOT / "addon")]

from geometry import Mesh  # noqa: E402
from inputs import write_input  # noqa: E402
from meshes_at_the_limit import FAULTY  # noqa: E402
from rows import Limits, Run, run_one  # noqa: E402
from shapes import SHAPES, area_of  # noqa: E402
from sweep import models_in  # noqa: E402

SPACINGS, FIRST_FACES = 12, 3


def starts_of(name: str, mesh: Mesh, folder: Path) -> Iterator[dict]:
    """A row for each spacing and first face, with `filled`: length over that of a full curve."""
    root = area_of(mesh) ** 0.5
    path = folder / f"{abs(hash(name))}.bin"
    for turn in range(FIRST_FACES):
        faces = np.roll(mesh.faces, -(turn * len(mesh.faces) // FIRST_FACES), axis=0)
        write_input(path, Mesh(mesh.vertices, faces), None)
        for side in np.geomspace(20, 200, SPACINGS):
            run = Run(name, 20 / side, "full", "preset", 1, 1, 1)
            row = run_one(run, path, root / side, Limits(seconds=60))
            row["filled"] = row.get("length", 0.0) * 2 / root / side
            row["first_face"] = turn
            yield row
    path.unlink()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--models", type=Path, metavar="FOLDER", help="more meshes: OBJ, PLY, STL")
    parser.add_argument("--only", default="", metavar="SUBSTRING", help="of the names of models")
    parser.add_argument("--least", type=float, default=0.4, help="share of a full curve's length")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    models = {name: make for name, make in SHAPES.items() if name not in FAULTY}
    if options.models:
        models |= models_in(options.models)
    names = [name for name in models if options.only in name]
    total = short = wrong = 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.jobs) as pool:
        made = pool.map(lambda n: list(starts_of(n, models[n](), Path(folder))), names)
        for row in (row for rows in made for row in rows):
            total += 1
            short += row["filled"] < options.least
            wrong += bool(row.get("faults")) or row["outcome"] not in ("limit", "converged")
            if row["filled"] < options.least or row.get("faults") or row["outcome"] != "limit":
                print(
                    f"{row['model']} {row['factor']:.3f} of the nominal radius, first face "
                    f"{row['first_face']}: {row['outcome']}, filled {row['filled']:.2f}, "
                    f"{row.get('first_fault', '')}"
                )
    print(f"{total} full starts, {short} shorter than {options.least}, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

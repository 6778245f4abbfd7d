# SPDX-License-Identifier: GPL-3.0-or-later
"""Fills long and narrow surfaces, and says how much of each stays empty.

    python3 tests/sweep/long_surfaces.py [--only strip] [--lengths 10,100] [--widths 0.8,4]
                                         [--rows FILE] [--seconds N]
    python3 tests/sweep/long_surfaces.py --summary FILE

A line for every shape, length and width in spacings, with few faces and with many, from nothing,
from a stroke at one end, and full. `work` is the nodes of all iterations over those of a square of
as many faces and the same area from nothing. With --rows every run is added to a file as JSON, and
those that are there already are left out. --summary prints a JSON object for every width of such a
file, which scripts/result_tables.py keeps for docs/reliability.md.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import statistics
import sys
import time
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests" / "core"), str(ROOT / "addon")]

from geometry import Mesh  # noqa: E402
from long_shapes import SHAPES, area_of, square  # noqa: E402
from meander import core  # noqa: E402

Row = dict[str, Any]


def stroke_at_the_end(mesh: Mesh) -> core.Seed:
    """A short one, near to the edge of the mesh that comes first."""
    corners = mesh.vertices[mesh.faces[0]]
    to = corners.mean(0) - corners[0]
    far = np.linalg.norm(to)
    ends = corners[0] + np.outer([0.3 / max(far, 1), min(0.6, 1.8 / far)], to)
    return core.Seed(ends, np.array([0, 2], dtype=np.uint32), np.zeros(1, dtype=np.uint8))


def fill(mesh: Mesh, seed: core.Seed | None, start: str, limit: int) -> Row:
    options = core.default_options("even")
    options.radius = 0.5
    options.threads = 1
    if limit:
        options.iteration_limit = limit
    if start == "full":
        options.start = core.Start.FULL
    begin = time.process_time()
    with core.Surface(mesh.vertices, mesh.faces) as surface:
        flow = core.Flow(surface, options, seed)
    with flow:
        reason = flow.run()
        seconds = time.process_time() - begin
        gaps = flow.gaps()
        figures = flow.statistics()
        work = sum(int(iteration["nodes"]) for iteration in flow.history())
    kept = ("iterations", "nodes", "strands", "crossings")
    return {
        "empty": gaps.empty_share,
        "narrow": gaps.narrow_share,
        "reason": reason,
        "seconds": round(seconds, 3),
        "node_iterations": work,
        **{name: figures[name] for name in kept},
    }


def fill_within(seconds: int, mesh: Mesh, seed: core.Seed | None, start: str, limit: int) -> Row:
    """The same in a process of its own, which ends after so many seconds of a processor."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        os.write(writing, json.dumps(fill(mesh, seed, start, limit)).encode())
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as answer:
        text = answer.read()
    os.waitpid(child, 0)
    return json.loads(text) if text else {"reason": "time"}


def is_wrong(row: Row) -> bool:
    return row["reason"] != "converged" or row["empty"] > 1e-3 or row["crossings"] > 0


def line_of(row: Row, of_square: Row) -> str:
    size = f"{row['length']:5g} x {row['width']:3g} {row['pieces']:3}"
    what = f"{row['shape']:12} {size} {row['start']:7}"
    if row["reason"] == "time":
        return f"! {what} did not end in time"
    work = row["node_iterations"] / max(of_square.get("node_iterations", 0), 1)
    return (
        f"{'!' if is_wrong(row) else ' '} {what} empty {row['empty']:.4f} "
        f"narrow {row['narrow']:.4f} {row['reason']:9} {row['iterations']:4} iterations "
        f"{row['nodes']:6} nodes {row['crossings']} crossings work {work:4.1f}"
    )


class Table:
    """Runs that were made, by what they are runs of, and a file that has them."""

    def __init__(self, path: Path | None) -> None:
        self.path = path
        lines = path.read_text().splitlines() if path and path.exists() else []
        self.rows: dict[str, Row] = {self.key(row): row for row in map(json.loads, lines)}

    @staticmethod
    def key(row: Row) -> str:
        return " ".join(str(row[name]) for name in ("shape", "length", "width", "pieces", "start"))

    def get(self, row: Row, mesh: Mesh, seed: core.Seed | None, seconds: int, limit: int) -> Row:
        known = self.rows.get(self.key(row))
        if known is not None:
            return known
        row = {**row, **fill_within(seconds, mesh, seed, row["start"], limit)}
        self.rows[self.key(row)] = row
        if self.path:
            with self.path.open("a") as file:
                file.write(json.dumps(row) + "\n")
        return row

    def square_of(self, row: Row, area: float, seconds: int) -> Row:
        side = round(area**0.5, 2)
        like = {"shape": "square", "length": side, "width": side, "pieces": row["pieces"]}
        made = square(area, row["pieces"])
        return self.get({**like, "start": "nothing"}, made, None, seconds, 0)


def summary(rows: list[Row]) -> list[Row]:
    """A row for every width and start, of all shapes but squares."""
    of_side = {(r["length"], r["pieces"]): r for r in rows if r["shape"] == "square"}
    by_width: dict[tuple[float, str], list[Row]] = defaultdict(list)
    for row in rows:
        if row["shape"] != "square":
            by_width[row["width"], row["start"]].append(row)
    made = []
    for (width, start), runs in sorted(by_width.items()):
        ended = [row for row in runs if row["reason"] != "time"]
        work = []
        for row in ended:
            mesh = SHAPES[row["shape"]](row["length"], row["width"], row["pieces"])
            like = of_side.get((round(area_of(mesh) ** 0.5, 2), row["pieces"]))
            if like and "node_iterations" in like:
                work.append(row["node_iterations"] / like["node_iterations"])
        made.append(
            {
                "width": width,
                "start": start,
                "filled": f"{sum(not is_wrong(row) for row in ended)} of {len(runs)}",
                "empty": max((row["empty"] for row in ended), default=None),
                "narrow": max((row["narrow"] for row in ended), default=None),
                "iterations": max((row["iterations"] for row in ended), default=None),
                "work": statistics.median(work) if work else None,
                "most_work": max(work, default=None),
            }
        )
    return made


def numbers(text: str) -> list[float]:
    return [float(part) for part in text.split(",")]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--only", default="", metavar="NAMES", help="of shapes, with commas")
    parser.add_argument("--lengths", type=numbers, default=[10, 50, 200], help="in spacings")
    widths = [0.8, 1.2, 2, 3, 4, 8]
    parser.add_argument("--widths", type=numbers, default=widths, help="in spacings")
    parser.add_argument("--pieces", type=numbers, default=[1, 200], help="along the surface")
    parser.add_argument("--starts", default="nothing,stroke,full")
    parser.add_argument("--limit", type=int, default=0, help="of iterations; 0: as it is")
    parser.add_argument("--seconds", type=int, default=60, help="of a processor, for each run")
    parser.add_argument("--rows", type=Path, help="of runs that were made, and of those to come")
    parser.add_argument("--summary", type=Path, metavar="FILE", help="only prints what is in it")
    options = parser.parse_args()
    if options.summary:
        for row in summary(list(Table(options.summary).rows.values())):
            print(json.dumps(row))
        return 0
    names = [name for name in SHAPES if not options.only or name in options.only.split(",")]
    table = Table(options.rows)
    wrong = 0
    for name in names:
        for length in options.lengths:
            for width in options.widths:
                for pieces in map(int, options.pieces):
                    mesh = SHAPES[name](length, width, pieces)
                    for start in options.starts.split(","):
                        row = {"shape": name, "length": length, "width": width, "pieces": pieces}
                        seed = stroke_at_the_end(mesh) if start == "stroke" else None
                        row = {**row, "start": start}
                        made = table.get(row, mesh, seed, options.seconds, options.limit)
                        like = table.square_of(made, area_of(mesh), options.seconds)
                        wrong += made["reason"] == "time" or is_wrong(made)
                        print(line_of(made, like), flush=True)
    print(f"{wrong} not filled")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

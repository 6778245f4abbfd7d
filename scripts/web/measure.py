#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of build/web/meander.mjs in Node beside native ones with one thread, in turn.

    measure.py [--pairs N] [--around N] [--radius R]

One line: faces, nodes, medians of seconds in Node and natively, median of their ratios, and the
bytes that the module has had to take.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "web")]

import fingerprint_cases  # noqa: E402
import fingerprints  # noqa: E402
from node_core import NodeCore  # noqa: E402


def seconds(core, mesh, radius: float) -> tuple[float, int]:
    """Of a run from the mesh to the end, and how many nodes there are then."""
    begin = time.perf_counter()
    options = core.default_options("even")
    options.radius, options.threads = radius, 1
    with core.Surface(*mesh, None, 1) as surface, core.Flow(surface, options) as flow:
        flow.run()
        spent = time.perf_counter() - begin
        return spent, flow.statistics()["nodes"]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--around", type=int, default=40, help="of a torus, half as many across")
    parser.add_argument("--radius", type=float, default=0.074)
    arguments = parser.parse_args()
    native = fingerprints.load_core(ROOT / "addon" / "meander")
    node = NodeCore()
    mesh = fingerprint_cases.torus(arguments.around, arguments.around // 2)
    pairs = []
    for _ in range(arguments.pairs):
        (there, nodes), (here, _same) = (
            seconds(core, mesh, arguments.radius) for core in (node, native)
        )
        pairs.append((there, here))
    in_node, natively = (statistics.median(column) for column in zip(*pairs, strict=True))
    ratio = statistics.median(a / b for a, b in pairs)
    print(
        f"{len(mesh[1])} faces, {nodes} nodes: node {in_node:.2f} s, native {natively:.2f} s, "
        f"{ratio:.2f} times; {node.ask('memoryInUse') / 1e6:.0f} MB"
    )
    node.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())

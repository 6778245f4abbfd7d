# SPDX-License-Identifier: GPL-3.0-or-later
"""Large curves, from a mesh file to a curve file, by the batch command: what
`bench.py --group scale` measures. A process a case; a row says where its seconds went, and how much
memory it took at most.

The mesh is a torus with bumps of 59,664 faces, filled from a full start.
"""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "tests" / "sweep"))
import written_curves  # noqa: E402

COMMAND = ROOT / "addon" / "meander" / "batch.py"
NODES = (100_000, 300_000, 1_000_000, 3_000_000, 10_000_000)
# n r^2 / A of a finished curve of n nodes on an area A.
NODES_PER_AREA = 1.467
# What a line of the command begins with, and the phase that it begins.
PHASES = (("meander: measuring", "measure"), ("meander: writing", "write"))


def torus(around: int = 226, across: int = 132) -> tuple[np.ndarray, np.ndarray]:
    u, v = np.meshgrid(
        2 * np.pi * np.arange(around) / around,
        2 * np.pi * np.arange(across) / across,
        indexing="ij",
    )
    tube = 0.4 + 0.03 * np.sin(5 * u) * np.cos(4 * v)
    ring = 1.0 + tube * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), tube * np.sin(v)], axis=-1)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    following, above = (i + 1) % around, (j + 1) % across
    a, b = i * across + j, following * across + j
    c, d = following * across + above, i * across + above
    faces = np.concatenate([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)])
    return points.reshape(-1, 3), faces.reshape(-1, 3)


def write_mesh(path: Path) -> float:
    """Writes the torus, and returns its area."""
    vertices, faces = torus()
    with path.open("w", encoding="ascii") as file:
        file.writelines(f"v {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in vertices.tolist())
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in (faces + 1).tolist())
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def measure(
    library: Path, mesh: Path, area: float, nodes: int, threads: str, checked: bool = False
) -> dict:
    """The row of one case.

    checked   the curve is written with its faces and weights, and the checker of the sweep, which
              is part of the build, looks at it
    """
    row = {"row": "scale", "group": "scale", "case": f"torus_{nodes // 1000}k"}
    row["threads"] = int(threads)
    output = mesh.with_name("curve.npz" if checked else "curve.obj")
    report = mesh.with_name("report.json")
    spacing = 2 * math.sqrt(NODES_PER_AREA * area / nodes)
    options = ["--input", mesh, "--output", output, "--report", report, "--start", "full"]
    options += ["--spacing", spacing, "--threads", threads]
    began = time.monotonic()
    child = subprocess.Popen(
        [sys.executable, str(COMMAND), *map(str, options)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"MEANDER_LIBRARY": str(library)},
    )
    at, silent, last, lines = {"grow": began}, 0.0, began, []
    for line in child.stdout:
        now = time.monotonic()
        silent, last = max(silent, now - last), now
        lines.append(line)
        for begin, phase in PHASES:  # later lines of a phase say how far it is
            if line.startswith(begin):
                at.setdefault(phase, now)
    _pid, status, used = os.wait4(child.pid, 0)
    ended = time.monotonic()
    if os.waitstatus_to_exitcode(status) != 0:
        return row | {"error": "".join(lines[-3:]).strip()}
    ends = [*at.values(), ended][1:]
    found = json.loads(report.read_text(encoding="utf-8"))
    row |= {"nodes": found["nodes"], "iterations": found["iterations"]}
    row["seconds"] = ended - began
    row |= {f"{phase}_seconds": end - at[phase] for phase, end in zip(at, ends, strict=True)}
    row |= {"cpu_seconds": used.ru_utime + used.ru_stime, "memory_bytes": 1024 * used.ru_maxrss}
    row |= {"bytes_a_node": row["memory_bytes"] / found["nodes"]}
    row |= {"longest_silence": silent, "file_bytes": output.stat().st_size}
    row |= {"stop_reason": found["stop_reason"]}
    row["spacing_median"] = found["spacing"]["median"] / spacing
    row |= {"estimate": found["estimate"]}
    if checked:
        found = written_curves.found_in(*torus(), output)
        row |= {key: found[key] for key in ("points", "crossings", "faults")}
    return row


def rows(library: Path, most_nodes: int, threads: str, checked: bool) -> Iterator[dict]:
    """A row for each number of nodes up to `most_nodes`; see measure()."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder) / "torus.obj"
        area = write_mesh(mesh)
        for nodes in NODES:
            if nodes <= most_nodes:
                yield measure(library, mesh, area, nodes, threads, checked)

# SPDX-License-Identifier: GPL-3.0-or-later
"""What the checker of the sweep finds in a curve that stands in a file, also of ten million nodes:
it has 180 bytes of memory for each point.

    python3 tests/sweep/written_curves.py MESH CURVE.npz
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "sweep_check"


def write_mesh(path: Path, vertices: np.ndarray, faces: np.ndarray) -> None:
    """The mesh of a file that inputs.py writes."""
    with path.open("wb") as file:
        np.array([len(vertices), len(faces), 0, 0, 0], dtype=np.uint64).tofile(file)
        np.ascontiguousarray(vertices, dtype=np.float64).tofile(file)
        np.ascontiguousarray(faces, dtype=np.uint32).tofile(file)


def write_curve(path: Path, curve: Path) -> None:
    """Writes what sweep_check reads of a .npz file of the batch command, one array at a time."""
    with path.open("wb") as file, np.load(curve) as arrays:
        closed, offsets = arrays["closed"], arrays["offsets"]
        np.array([offsets[-1], len(closed)], dtype=np.uint64).tofile(file)
        for name, kind in (("faces", np.uint32), ("weights", np.float64), ("points", np.float64)):
            np.ascontiguousarray(arrays[name], dtype=kind).tofile(file)
        offsets.astype(np.uint64).tofile(file)
        closed.astype(np.uint8).tofile(file)


def found_in(
    vertices: np.ndarray, faces: np.ndarray, curve: Path, program: Path = PROGRAM
) -> dict[str, int | str]:
    """The line that sweep_check prints of a curve, a .npz file, on a mesh."""
    with tempfile.TemporaryDirectory(dir=curve.parent) as folder:
        mesh_file, curve_file = Path(folder) / "mesh", Path(folder) / "curve"
        write_mesh(mesh_file, vertices, faces)
        write_curve(curve_file, curve)
        done = subprocess.run(
            [str(program), str(mesh_file), str(curve_file)],
            check=True, capture_output=True, text=True,
        )  # fmt: skip
    return json.loads(done.stdout)


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.path += [str(ROOT / "addon")]
    from meander.model.files.meshes import read_mesh

    print(json.dumps(found_in(*read_mesh(Path(sys.argv[1])), Path(sys.argv[2]))))


if __name__ == "__main__":
    main()

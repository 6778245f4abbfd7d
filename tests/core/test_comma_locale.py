# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of the native library where a comma is the point, as in de_DE: sentences have a point,
and files are read by it.

The locale is made here, so that none has to be installed: glibc's file of LC_NUMERIC is a table of
six entries, and is asked for by LOCPATH, which is read when a process starts.
"""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NAME = "comma_is_the_point"

# In a process of its own: whatever else runs here keeps its locale.
CHILD = '''
import ctypes, json, locale, sys
from pathlib import Path
sys.path[:0] = [sys.argv[1], sys.argv[2]]
import geometry
import numpy as np
from meander import core
from meander.model.files import meshes

locale.setlocale(locale.LC_NUMERIC, sys.argv[4])
text = ctypes.create_string_buffer(32)
ctypes.CDLL(None).snprintf(text, 32, b"%g", ctypes.c_double(1234.5))
said, vertices, faces = {}, *geometry.grid(6)

def options(**changes):
    chosen = core.default_options("even")
    chosen.radius = 0.1
    for name, value in changes.items():
        setattr(chosen, name, value)
    return chosen

def refused(name, call):
    try:
        call()
    except core.MeanderError as refusal:
        said[name] = str(refusal)

surface = core.Surface(vertices, faces)
refused("radius", lambda: core.Flow(surface, options(radius=-0.25)))
refused("large radius", lambda: core.Flow(surface, options(radius=1234.5)))
refused("option", lambda: core.Flow(surface, options(boundary_distance=2.75)))
refused("density", lambda: core.Flow(surface, options(), density=np.geomspace(1, 12345.5, 49)))
refused("smoothing", lambda: surface.curvature("mean", -1.5))
refused("outline", lambda: surface.outlines(0.1, -0.75))
refused("angle", lambda: surface.turned_directions(vertices, np.full(49, 2.5e15)))
far = np.array([(0.0, 0.0, 7.25), (1.0, 1.0, 7.25)])
seed = core.Seed(far, [0, 2], [0])
refused("seed", lambda: core.Flow(surface, options(), seed))
refused("merge", lambda: core.Surface(vertices, faces, core.SurfaceOptions(merge_distance=-0.5)))
refused("part", lambda: core.Surface(vertices, faces, core.SurfaceOptions(smallest_part=99.5)))
said["warning"] = "; ".join(core.option_warnings(options(bending_weight=12.5)))
folder = Path(sys.argv[3])
places = "".join(f"v {x!r} {y!r} {z!r}\\n" for x, y, z in vertices.tolist())
corners = "".join("f {} {} {}\\n".format(*(face + 1)) for face in faces)
(folder / "a.obj").write_text(places + corners)
corners = "".join(
    "facet normal 0 0 1\\nouter loop\\n"
    + "".join("vertex {!r} {!r} {!r}\\n".format(*vertices[v].tolist()) for v in face)
    + "endloop\\nendfacet\\n" for face in faces)
(folder / "a.stl").write_text("solid a\\n" + corners + "endsolid a\\n")
read = [meshes.read(folder / name).vertices for name in ("a.obj", "a.stl")]
print(json.dumps({
    "printf": text.value.decode(), "said": said, "same": bool((read[0] == vertices).all()),
    "bounds": [float(read[1].min()), float(read[1].max()), len(np.unique(read[1][:, 0]))],
}))
'''


def write_locale(folder: Path) -> None:
    """LC_NUMERIC of glibc: a magic number, six offsets, and decimal point, separator of thousands,
    its groups, both as wide characters, and the name of the character set."""
    wide = [struct.pack("=I", ord(letter)) for letter in ",."]
    entries = [b",\0", b".\0", b"\3\3\0\0", *wide, b"UTF-8\0"]
    begin = 8 + 4 * len(entries)
    offsets = [begin + sum(map(len, entries[:index])) for index in range(len(entries))]
    folder.mkdir()
    (folder / "LC_NUMERIC").write_bytes(
        struct.pack("=II6I", 0x20031114, len(entries), *offsets) + b"".join(entries)
    )


@pytest.fixture(scope="module")
def child(tmp_path_factory: pytest.TempPathFactory) -> dict:
    if not sys.platform.startswith("linux") or not os.confstr("CS_GNU_LIBC_VERSION"):
        pytest.skip("the locale is made for glibc, and this system has another C library")
    folder = tmp_path_factory.mktemp("locale")
    write_locale(folder / NAME)
    program = folder / "child.py"
    program.write_text(CHILD)
    arguments = [ROOT / "addon", ROOT / "tests" / "core", folder, NAME]
    done = subprocess.run(
        [sys.executable, program, *map(str, arguments)], capture_output=True, text=True,
        timeout=120, env={**os.environ, "LOCPATH": str(folder)}, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_process_has_a_comma(child: dict) -> None:
    assert child["printf"] == "1234,5"


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("radius", "it is -0.5"), ("large radius", "2469"), ("option", "is 2.75;"),
        ("density", "factor of 12345.5"), ("smoothing", "is -1.5;"), ("outline", "-0.75"),
        ("angle", "2.5e+15"), ("seed", "7.25 away"), ("merge", "is -0.5;"), ("part", "99.5"),
        ("warning", "is 12.5;"),
    ],
)  # fmt: skip
def test_sentences_have_a_point(child: dict, name: str, number: str) -> None:
    assert number in child["said"][name], child["said"][name]


def test_files_are_read_by_the_point(child: dict) -> None:
    assert child["same"]
    assert child["bounds"] == [0.0, 1.0, 7]

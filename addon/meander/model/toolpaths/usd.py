# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands as USD: BasisCurves with widths, normals and what is known of the points; no bpy.

The text form (.usda) is written here. The binary one (.usdc, and .usd, which may be either) is what
Pixar's package makes of that text; it is `usd-core` on the Python index, and Blender from 4.4 on
brings it along.
"""

from __future__ import annotations

import importlib.util
import json
import re
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..files.whole import FileError
from .drawing import Drawing, far_away
from .toolpath import Strand

SUFFIXES = (".usda", ".usdc", ".usd")
PACKAGE = "usd-core"

# The names of prims, by whether strands are closed, which USD says of all curves in a prim.
_PRIMS = {True: "Closed", False: "Open"}
_WRAPS = {True: "periodic", False: "nonperiodic"}


def is_there() -> bool:
    """Whether the binary form can be written."""
    try:
        return importlib.util.find_spec("pxr.Sdf") is not None
    except ModuleNotFoundError:
        return False


def missing_text() -> str:
    """What to do where it cannot, as a sentence."""
    return (
        f"Binary USD needs the Python package {PACKAGE}, which is not there; install it with "
        f"python3 -m pip install {PACKAGE}, or write a .usda file"
    )


def usd_bytes(drawing: Drawing, width: float, title: str, version: str, suffix: str) -> bytes:
    """The content of a file.

    drawing   in metres; its frames become time samples
    width     of the curve, in metres; 0: whoever renders it decides
    suffix    one of SUFFIXES

    Raises FileError where the binary form is wanted and its package is missing.
    """
    text = usd_text(drawing, width, title, version)
    if suffix == ".usda":
        return text.encode("utf-8")
    if not is_there():
        raise FileError(missing_text())
    from pxr import Sdf

    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    with tempfile.TemporaryDirectory(prefix="meander-") as folder:
        path = Path(folder) / "curve.usdc"
        layer.Export(str(path))
        return path.read_bytes()


def usd_text(drawing: Drawing, width: float, title: str, version: str) -> str:
    """The text of a .usda file; see usd_bytes."""
    frames = drawing.frames or ((None, drawing.strands),)
    origin = far_away([strand for _time, strands in frames for strand in strands])
    name = re.sub(r"[^A-Za-z0-9_]", "_", title) or "Curve"
    name = f"_{name}" if name[0].isdigit() else name
    lines = ["#usda 1.0", "(", f'    defaultPrim = "{name}"', f"    doc = {_text(title, version)}"]
    if drawing.frames:
        times = [time for time, _strands in drawing.frames]
        lines += [f"    startTimeCode = {min(times):.9g}", f"    endTimeCode = {max(times):.9g}"]
        lines += [f"    timeCodesPerSecond = {drawing.rate:.9g}"]
    lines += ["    metersPerUnit = 1", '    upAxis = "Z"', ")", "", f'def Xform "{name}"', "{"]
    if origin.any():
        lines.append(f"    double3 xformOp:translate = {_tuple(origin, '.17g')}")
        lines.append('    uniform token[] xformOpOrder = ["xformOp:translate"]')
    for closed in (True, False):
        of_kind = [
            (time, [strand for strand in strands if strand.closed == closed])
            for time, strands in frames
        ]
        if any(strands for _time, strands in of_kind):
            lines += ["", *(f"    {line}" for line in _curves(closed, of_kind, width, origin))]
    return "\n".join([*lines, "}", ""])


def _text(title: str, version: str) -> str:
    """A comment of the layer; what USD would not read as text is left out."""
    plain = "".join(letter if letter.isprintable() else "?" for letter in title)
    return json.dumps(f"{plain}, by Meander {version}", ensure_ascii=True).replace("\\u", "U+")


def _curves(
    closed: bool,
    frames: Sequence[tuple[float | None, Sequence[Strand]]],
    width: float,
    origin: NDArray[np.float64],
) -> list[str]:
    """One prim of all strands that are closed, or of all that are not."""
    lines = [f'def BasisCurves "{_PRIMS[closed]}"', "{", '    uniform token type = "linear"']
    lines += [f'    uniform token wrap = "{_WRAPS[closed]}"']
    if width > 0.0:
        lines.append(f"    float[] widths = [{width:.9g}] (")
        lines += ['        interpolation = "constant"', "    )"]
    everything = [strand for _time, strands in frames for strand in strands]
    for kind, name, interpolation, known, values in _ATTRIBUTES:
        if not all(known(strand) for strand in everything):
            continue
        samples = [(time, values(strands, width, origin)) for time, strands in frames]
        if samples[0][0] is None:
            written = f"{kind} {name} = {samples[0][1]}"
        else:
            written = f"{kind} {name}.timeSamples = {{ {_sampled(samples)} }}"
        if interpolation and samples[0][0] is not None:
            lines += [f"    {kind} {name} (", f'        interpolation = "{interpolation}"', "    )"]
            lines.append(f"    {written}")
        elif interpolation:
            lines += [f"    {written} (", f'        interpolation = "{interpolation}"', "    )"]
        else:
            lines.append(f"    {written}")
    return [*lines, "}"]


def _sampled(samples: Sequence[tuple[float | None, str]]) -> str:
    """Values by time; one that is as before is left out, since the last one holds."""
    kept = [
        sample for k, sample in enumerate(samples) if k == 0 or sample[1] != samples[k - 1][1]
    ]
    return ", ".join(f"{time:.9g}: {text}" for time, text in kept)


def _tuple(values: Sequence[float], form: str = ".9g") -> str:
    return f"({', '.join(format(value, form) for value in values)})"


def _numbers(values: NDArray) -> str:
    if values.dtype.kind in "iu":
        return f"[{', '.join(map(str, values.tolist()))}]"
    return f"[{', '.join(f'{value:.9g}' for value in values.astype(np.float32).tolist())}]"


def _tuples(rows: NDArray[np.float64]) -> str:
    return f"[{', '.join(_tuple(row) for row in rows.astype(np.float32).tolist())}]"


def _stacked(strands: Sequence[Strand], name: str, width: int) -> NDArray[np.float64]:
    return np.vstack([np.empty((0, width)), *(getattr(strand, name) for strand in strands)])


def _joined(strands: Sequence[Strand], values: Callable[[Strand], NDArray]) -> NDArray:
    return np.concatenate([values(strand) for strand in strands] or [np.empty(0)])


def _extent(strands: Sequence[Strand], width: float, origin: NDArray[np.float64]) -> str:
    points = _stacked(strands, "points", 3) - origin
    if not len(points):
        return "[(0, 0, 0), (0, 0, 0)]"
    box = np.array([points.min(axis=0) - width / 2.0, points.max(axis=0) + width / 2.0])
    return _tuples(box)


def _always(_strand: Strand) -> bool:
    return True


def _has_radii(strand: Strand) -> bool:
    return strand.radii is not None


def _has_faces(strand: Strand) -> bool:
    return strand.faces is not None


# Type, name, interpolation, whether it is known of a strand, and the values of strands as text. Of
# linear curves "vertex" and "varying" are the same.
_ATTRIBUTES: tuple[tuple[str, str, str, Callable, Callable], ...] = (
    (
        "int[]",
        "curveVertexCounts",
        "",
        _always,
        lambda strands, _width, _origin: _numbers(
            np.array([len(strand.points) for strand in strands], dtype=np.int64)
        ),
    ),
    ("float3[]", "extent", "", _always, _extent),
    (
        "point3f[]",
        "points",
        "",
        _always,
        lambda strands, _width, origin: _tuples(_stacked(strands, "points", 3) - origin),
    ),
    (
        "normal3f[]",
        "normals",
        "vertex",
        _always,
        lambda strands, _width, _origin: _tuples(_stacked(strands, "normals", 3)),
    ),
    (
        "vector3f[]",
        "primvars:tangent",
        "vertex",
        _always,
        lambda strands, _width, _origin: _tuples(_stacked(strands, "tangents", 3)),
    ),
    (
        "float[]",
        "primvars:arc_length",
        "vertex",
        _always,
        lambda strands, _width, _origin: _numbers(_joined(strands, lambda s: s.arc_lengths)),
    ),
    *(
        (
            "float[]",
            f"primvars:{name}",
            "vertex",
            _has_radii,
            lambda strands, _width, _origin, side=side: _numbers(
                _joined(strands, lambda s: s.radii[:, side])
            ),
        )
        for side, name in enumerate(("r_plus", "r_minus"))
    ),
    (
        "int[]",
        "primvars:face",
        "vertex",
        _has_faces,
        lambda strands, _width, _origin: _numbers(
            _joined(strands, lambda s: s.faces).astype(np.int64)
        ),
    ),
    (
        "float3[]",
        "primvars:weights",
        "vertex",
        _has_faces,
        lambda strands, _width, _origin: _tuples(_stacked(strands, "weights", 3)),
    ),
    (
        "float[]",
        "primvars:length",
        "uniform",
        _always,
        lambda strands, _width, _origin: _numbers(np.array([float(s.length) for s in strands])),
    ),
)

# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run costs: points, time and memory before it begins, and what is left of them; no bpy.

What the curve comes to is the library's own estimate: core.estimate_cost. Here stand what holds the
curve afterwards, how fast this machine is, how much memory it still gives, and the words.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

import numpy as np
from numpy.typing import NDArray

from .. import core
from .geometry.blocks import blocks

# Bytes for each point of the curve object: itself, an undo step, and its body where it has
# one.
BYTES_PER_POINT = 330
BYTES_PER_BEVELLED_POINT = 1600
# Blender hangs so long for each point while it takes the curve of a run in, with a body and without
# one; see docs/performance.md. What hangs longer than this is spoken of.
SECONDS_PER_POINT = 3.3e-6
SECONDS_PER_BARE_POINT = 1e-6
_MOST_SECONDS = 2.0
# Runs of fewer nodes say nothing of the machine's speed.
LEAST_NODES = 2000
# The share of a run that threads do not share.
_ALONE = 0.1
# Seconds of a processor in which a node of a symmetric curve is laid on the surface: 4.6e-6 to
# 5.7e-6 measured, besides .1 s.
_LAYING = 5e-6


@dataclass(frozen=True)
class Estimate:
    """What a run comes to: points of the curve object, seconds, bytes."""

    points: int
    seconds: float
    memory: int


def extent_of(
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer],
    density: NDArray[np.float64] | None = None,
    share: float = 1.0,
) -> core.Extent:
    """The extent of triangles, of whose area only a share is to be filled.

    The same as core.Surface.extent of a surface made of them, without making one.

    vertices (n, 3), faces (m, 3), density (n,) or None for 1 everywhere.
    """
    sides = area = length_area = node_area = 0.0
    # With room on both sides: where its result lies right beside an argument, numpy takes another
    # arctan2, which differs in the last bit, and the same mesh would have two estimates.
    angles = np.empty(3 * len(faces) + 2)[1:-1].reshape(3, -1)
    for begin, end in blocks(len(faces)):
        some = slice(begin, end)
        # Space by space, each of three corners, so that all numpy touches lies side by side.
        x, y, z = np.moveaxis(vertices[faces[some].T], 2, 0).copy()
        dx, dy, dz = (np.roll(axis, -1, axis=0) - axis for axis in (x, y, z))
        sides += float(np.sqrt(dx * dx + dy * dy + dz * dz).sum())
        across = np.sqrt(
            (dx[0] * dy[1] - dy[0] * dx[1]) ** 2
            + (dy[0] * dz[1] - dz[0] * dy[1]) ** 2
            + (dz[0] * dx[1] - dx[0] * dz[1]) ** 2
        )
        for corner in range(3):
            along = -(dx[corner] * dx[corner - 1])
            along -= dy[corner] * dy[corner - 1]
            along -= dz[corner] * dz[corner - 1]
            np.arctan2(across, along, out=angles[corner, some])
        area += float(across.sum()) / 2.0
        if density is not None:
            of_face = density[faces[some]]
            length_area += float((across * np.sqrt(of_face).mean(axis=1)).sum()) / 2.0
            node_area += float((across * of_face.mean(axis=1)).sum()) / 2.0
    if density is None:
        length_area = node_area = area
    # An edge is a side of two faces.
    edges = sides / (2.0 * area) if area > 0.0 else 0.0
    curvature = _curvature(faces, angles, len(vertices)) / area if area > 0.0 else 0.0
    return core.Extent(len(faces), share * length_area, share * node_area, edges, curvature)


def _curvature(faces: NDArray[np.integer], angles: NDArray[np.float64], count: int) -> float:
    """The sum of the angle defects of the vertices, in absolute value; angles (3, m) of corners.

    What lies on the boundary is not looked for, which would take longer than all the rest: a defect
    of more than three eighths of a turn is taken for one there.
    """
    sums = np.zeros(count)
    for corner in range(3):
        sums += np.bincount(faces[:, corner], angles[corner], count)
    defects = np.abs(2.0 * np.pi - sums[sums > 0.0])
    return float(defects[defects < 0.75 * np.pi].sum())


class Speeds:
    """How many seconds a run takes on this machine, learned from the runs that ended here."""

    def __init__(self) -> None:
        self._factor: float | None = None

    def learn(
        self, options: core.FlowOptions, nodes: int, seconds: float, faces: int = 0
    ) -> None:
        """Takes the figures of a whole run into account; of a small one it takes none.

        faces   of the surface: of many a run takes longer, and the machine is no slower for it
        """
        if nodes < LEAST_NODES:
            return
        factor = seconds / _seconds(options, _cost_of(options, nodes, faces))
        # The machine may be busy with other things: half new, half old.
        self._factor = factor if self._factor is None else math.sqrt(self._factor * factor)

    def seconds(self, options: core.FlowOptions, cost: core.Cost) -> float:
        """How long a run of this cost takes."""
        return (self._factor or 1.0) * _seconds(options, cost)


def _cost_of(options: core.FlowOptions, nodes: float, faces: int) -> core.Cost:
    """The cost of a curve of `nodes` nodes, on a surface of so many faces that are all alike."""
    of_one = core.estimate_cost(core.Extent(0, 1.0, 1.0, 0.0), options)
    area = nodes / of_one.nodes
    # Edges over the area, of equilateral triangles.
    edges = 3.0**0.75 * math.sqrt(faces / area)
    return core.estimate_cost(core.Extent(faces, area, area, edges), options)


def _seconds(options: core.FlowOptions, cost: core.Cost) -> float:
    threads = options.threads or os.cpu_count() or 1
    return cost.processor_seconds * (_ALONE + (1.0 - _ALONE) / threads)


def cost_of(
    extent: core.Extent, options: core.FlowOptions, symmetric: bool = False
) -> core.Cost:
    """What the library needs for a run.

    symmetric   one half grows, and is laid on the surface with its image; the memory is an upper
                bound then

    Raises core.MeanderError for options that are out of range.
    """
    whole = core.estimate_cost(extent, options)
    if not symmetric:
        return whole
    half = replace(
        extent,
        faces=extent.faces // 2,
        length_area=extent.length_area / 2.0,
        node_area=extent.node_area / 2.0,
    )
    growing = core.estimate_cost(half, options).processor_seconds
    return replace(whole, processor_seconds=growing + _LAYING * whole.nodes)


def estimated(
    extent: core.Extent,
    options: core.FlowOptions,
    bevelled: bool,
    speeds: Speeds,
    symmetric: bool = False,
) -> Estimate:
    """What a run with these options comes to, whose radius and segment length are chosen; see
    cost_of()."""
    cost = cost_of(extent, options, symmetric)
    of_point = BYTES_PER_BEVELLED_POINT if bevelled else BYTES_PER_POINT
    memory = cost.memory + of_point * cost.points
    return Estimate(_whole(cost.points), speeds.seconds(options, cost), _whole(memory))


def together(estimates: list[Estimate]) -> Estimate | None:
    """What runs one after another come to; None for none. Their memory is that of the largest."""
    if not estimates:
        return None
    return Estimate(
        sum(one.points for one in estimates),
        sum(one.seconds for one in estimates),
        max(one.memory for one in estimates),
    )


def _whole(value: float) -> int:
    """The nearest whole number; the largest that Blender shows for what is infinite."""
    return round(min(value, 1e18))


# ------------------------------------------------------------------------------------------------
# In words


def described(estimate: Estimate) -> str:
    """An estimate in words, to two digits at most: "12,000 points, 3 s, 60 MB"."""
    return (
        f"{_count(estimate.points)} points, {_duration(estimate.seconds)}, "
        f"{_size(estimate.memory)}"
    )


def hanging_in_words(points: int, has_body: bool) -> str:
    """Lines about what to do where Blender would hang too long with a curve of that many points;
    empty where it would not."""
    seconds = (SECONDS_PER_POINT if has_body else SECONDS_PER_BARE_POINT) * points
    if seconds <= _MOST_SECONDS:
        return ""
    return (
        f"Blender hangs for {_duration(seconds)} when it is done\n"
        "The batch command does not, with --output curve.npz"
    )


def cost_in_words(cost: core.Cost) -> str:
    """A cost in words: "1.2 M nodes, 2.5 GB and 12 min of a processor"."""
    return (
        f"{_count(cost.nodes)} nodes, {_size(cost.memory)} and "
        f"{_duration(cost.processor_seconds)} of a processor"
    )


def size_in_words(size: float) -> str:
    """Bytes in words, to two digits: "2.5 GB"."""
    return _size(size)


def _rounded(value: float) -> int:
    """To two significant digits, at least 1."""
    return max(1, int(float(f"{value:.2g}")))


def _count(value: float) -> str:
    value = _rounded(value)
    if value >= 1e9:
        return f"{value / 1e9:,g} G"
    return f"{value / 1e6:,g} M" if value >= 1e6 else f"{value:,}"


def _duration(seconds: float) -> str:
    for limit, unit, name in ((100.0, 1.0, "s"), (6e3, 60.0, "min"), (36e4, 3600.0, "h")):
        if seconds < limit:
            return f"{_rounded(seconds / unit)} {name}"
    return f"{_rounded(seconds / 86400.0):,} days"


def _size(size: float) -> str:
    size = _rounded(size)
    if size >= 1e12:
        return f"{size / 1e12:,g} TB"
    return f"{_rounded(size / 1e6)} MB" if size < 1e9 else f"{size / 1e9:,g} GB"


# What a run is about, as a user reads it, by core.Context.phase; what is done before it, with the
# mesh and then on its surface; of a picture, once more; and what follows its end in Blender.
PHASE_TEXTS = {
    "none": "Preparing",
    "mesh": "Preparing the mesh",
    "surface": "Looking at the surface",
    "growth": "Growing",
    "hairpin_removal": "Removing hairpins",
    "polish": "Evening out",
    "correction": "Correcting tones",
    "search": "Measuring the curve",
}
# Seconds and share of the work before which a guess would jump about.
_LEAST_SECONDS = 0.5
_LEAST_SHARE = 0.05


class Remaining:
    """The seconds that a run will still take.

    note() whenever there is news. A run that goes on after a pause, or whose work has become more
    meanwhile, is measured from there on.
    """

    def __init__(self, expected: float | None = None) -> None:
        """expected   what the whole run was thought to take, which counts until more is known"""
        self._expected = expected
        self._begin: tuple[float, float] | None = None
        self._latest = (0.0, 0.0)

    def note(self, now: float, progress: float) -> None:
        """now   seconds of any clock that does not go back
        progress   the share of the work that is done, in [0, 1]
        """
        if self._begin is None or progress < self._latest[1]:
            self._begin = (now, progress)
        self._latest = (now, progress)

    def seconds(self) -> float | None:
        """None while too little is known."""
        if self._begin is None:
            return self._expected
        spent = self._latest[0] - self._begin[0]
        done = self._latest[1] - self._begin[1]
        if spent < _LEAST_SECONDS or done < _LEAST_SHARE:
            return None if self._expected is None else max(0.0, self._expected - spent)
        return spent / done * (1.0 - self._latest[1])


def told(phase: str, seconds: float | None) -> str:
    """Such as "Growing, 12 s left"; without the seconds where they are not known.

    Rounded up to two digits, so that the last second is not "0 s".
    """
    text = PHASE_TEXTS[phase]
    return text if seconds is None else f"{text}, {in_words(seconds)} left"


def in_words(seconds: float) -> str:
    """Such as "12 s" and "3 min", never less than "1 s"."""
    for limit, unit, name in ((90.0, 1.0, "s"), (5400.0, 60.0, "min")):
        if seconds < limit:
            return f"{max(1, round(seconds / unit))} {name}"
    return f"{max(1, round(seconds / 3600.0)):,} h"


_PROC = Path("/proc")
_GROUPS = Path("/sys/fs/cgroup")


def available_memory(proc: Path = _PROC, groups: Path = _GROUPS) -> int | None:
    """Bytes: what is free on the machine, or less in a container or a job with a limit of its own.

    Where memory runs out, Linux seldom says so: it gives addresses to everybody, and ends a process
    when they are used. Nobody hears a sentence then, so what is known to be too much is refused.

    On Linux what the kernel calls available, and the limits of the control groups (version 2) that
    the process is in; elsewhere all memory of the machine; None: it cannot be known.

    proc, groups   where the kernel tells of processes and of control groups
    """
    found = [_of_machine(proc), *_of_groups(proc, groups)]
    known = [size for size in found if size is not None]
    return min(known) if known else None


def _of_machine(proc: Path) -> int | None:
    for line in _lines(proc / "meminfo"):
        if line.startswith("MemAvailable:"):
            return 1024 * int(line.split()[1])
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):  # Windows
        return None


def _of_groups(proc: Path, groups: Path) -> list[int]:
    """What is left in the process's group, and in each that holds it."""
    left = []
    for line in _lines(proc / "self" / "cgroup"):
        number, _controllers, name = line.split(":", 2)
        if number != "0":  # of version 1
            continue
        inside = PurePosixPath(name.strip().lstrip("/"))
        for part in (inside, *inside.parents):
            folder = groups / part
            limit, used = _number(folder / "memory.max"), _number(folder / "memory.current")
            if limit is not None and used is not None:
                # Files that are kept in memory make room.
                left.append(max(0, limit - used + _kept_files(folder)))
    return left


def _kept_files(folder: Path) -> int:
    for line in _lines(folder / "memory.stat"):
        if line.startswith("inactive_file "):
            return int(line.split()[1])
    return 0


def _number(path: Path) -> int | None:
    """The number in a file; None: there is none, or no limit."""
    text = "".join(_lines(path)).strip()
    return int(text) if text.isdigit() else None


def _lines(path: Path) -> list[str]:
    try:
        return path.read_text(encoding="ascii", errors="replace").splitlines()
    except OSError:
        return []

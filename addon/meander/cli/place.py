# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the command runs, and what it asks of Blender where there is one; no bpy.

The command knows files and arrays. What needs Blender is a `Host`, which `headless` makes; a
command without one refuses what only Blender can do, with a sentence.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..model.picture.image import Image, read_image
from ..model.toolpaths import bridges, toolpath
from .exit_code import while_heard
from .grown import Grown
from .input import Input
from .values import BadInput

# How to come to Blender from where there is none.
_INSTEAD = (
    'run Meander\'s batch.py in Blender, or "blender --command meander" from Blender 4.2 on'
)


class Host(Protocol):
    """Blender, as the command sees it. Everything raises BadInput for what cannot be done."""

    def read_scene(self, arguments: argparse.Namespace) -> Input:
        """What the --input, a .blend, holds, with the objects that other options name."""

    def in_polygons(self, error: core.MeanderError, surface_object: Any) -> core.MeanderError:
        """The same error, with faces counted as Blender counts those of the object."""

    def refuse_points(self, points: str | None) -> None:
        """Refuses a --points that this Blender cannot make."""

    def write_scene(
        self, path: Path, arguments: argparse.Namespace, given: Input, grown: Grown
    ) -> tuple[int, bridges.Joined | None, NDArray[np.float64] | None]:
        """Writes the curve beside its surface into a .blend at `path`. Returns the number of its
        points, what was joined to one line, and where a light curve crosses itself; None: it has
        all points."""

    def baked_frames(
        self, arguments: argparse.Namespace, given: Input, grown: Grown
    ) -> tuple[list[tuple[float, list[toolpath.Strand]]], float]:
        """The strands of each of --bake-frames, in scene units, and how many are a second."""

    def write_cut_scene(
        self, path: Path, arguments: argparse.Namespace, given: Input, cut: core.CutSurface
    ) -> None:
        """Writes the cut beside its surface into a .blend at `path`."""

    def visible(
        self, strands: Sequence[toolpath.Strand], layout: str, given: Input
    ) -> list[toolpath.Strand]:
        """What can be seen of strands on the surface in a layout: top, front or side."""

    def unrolled(
        self, strands: Sequence[toolpath.Strand], given: Input, uv_map: str
    ) -> list[toolpath.Strand]:
        """Strands laid flat by a UV map of the surface; "": the active one."""

    def map_corners(self, given: Input, uv_map: str) -> NDArray[np.float64]:
        """A UV map at the corners of the surface's faces, (n, 3, 2); "": the active one."""

    def image_file(self, name: str) -> Path | None:
        """The file of an image of the scene; None: it has none."""

    def read_picture(self, path: Path) -> Image:
        """The picture in a file."""

    def metres(self) -> float:
        """The length of a scene unit."""


@dataclass(frozen=True)
class Place:
    """Where the command runs.

    program   as --help calls it
    say       prints a line for people who want to know how far it is; not for errors
    host      Blender; None: there is none
    """

    program: str
    say: Callable[[str], None]
    host: Host | None = None

    def warn(self, sentence: str) -> None:
        """Prints what somebody should know, also where nothing else is to be printed."""
        line = f"meander: warning: {sentence}"
        while_heard(print, line, file=sys.stderr, flush=True)

    def picture(self, path: Path) -> Image:
        """The picture in a file, which Blender reads where Pillow is not installed. Raises
        FileError."""
        return read_image(path) if self.host is None else self.host.read_picture(path)

    def blender(self, what: object, reason: str = "") -> Host:
        """Blender. Raises BadInput where there is none.

        what     a file or an option that needs it
        reason   why, where that is not plain
        """
        if self.host is None:
            because = f": {reason}" if reason else ""
            raise BadInput(f"{what} needs Blender{because}; {_INSTEAD}")
        return self.host

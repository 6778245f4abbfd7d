# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines, creases and edges of what a camera sees, as lines beside those that fill it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..model.camera import CameraPage
from ..model.geometry.contours import contours
from ..model.toolpaths.toolpath import Strand, resampled, strand_of
from ..scene.camera import Seen, Sight
from ..scene.visible import seen_parts

# In spacings on paper. No piece is looked at whole that is longer, and no part is drawn that is
# shorter.
LONGEST, SHORTEST = 0.25, 0.5
# Points are left out that change the line by less.
_TOLERANCE = 0.01


def outlines_of(seen: Seen, page: CameraPage, sight: Sight, spacing: float) -> list[Strand]:
    """What can be seen of them, on paper.

    spacing   on paper, in millimetres
    """
    towards, _before = page.towards_eye(seen.mesh.vertices)
    lines = [strand_of(*line) for line in contours(seen.mesh, towards) if len(line[0]) > 1]
    return on_page(lines, page, sight, spacing)


def on_page(
    strands: Sequence[Strand], page: CameraPage, sight: Sight, spacing: float
) -> list[Strand]:
    """What can be seen of strands in the world, on paper, at z = 0."""
    parts = seen_parts(strands, sight, page.on_paper, LONGEST * spacing, SHORTEST * spacing)
    return resampled([_on(page, strand) for strand in parts], tolerance=_TOLERANCE * spacing)


def _on(page: CameraPage, strand: Strand) -> Strand:
    flat = np.column_stack([page.on_paper(strand.points), np.zeros(len(strand.points))])
    return strand_of(flat, np.tile([0.0, 0.0, 1.0], (len(flat), 1)), strand.closed)

# SPDX-License-Identifier: GPL-3.0-or-later
"""A strip of patches to print and measure, and what was measured; no bpy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..files.whole import FileError
from .image import Image, image_of
from .tone import Tone

# The darkness of the patches, from left to right.
PATCHES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
# Which the drawing takes as they are, whatever is wished of a picture.
TONE = Tone("value", darkest=0.9, lightest=0.06)
# Pixels of a patch: fine enough that no cell of a grid averages two of them for long.
_PATCH = 100


def test_strip() -> Image:
    """A picture of patches side by side, whose darkness by value is that of PATCHES."""
    row = np.repeat(1.0 - np.array(PATCHES), _PATCH)
    return image_of(np.tile(row, (3 * _PATCH, 1)))


def read_paper(text: str) -> tuple[tuple[float, float], ...]:
    """What was measured, from SHARE:DARKNESS,SHARE:DARKNESS. Raises FileError with a sentence."""
    found: list[tuple[float, float]] = []
    for part in text.split(","):
        try:
            share, darkness = (float(word) for word in part.split(":"))
        except ValueError:
            raise FileError(
                f"--paper {text}: {part.strip()!r} is no measurement; write SHARE:DARKNESS, such "
                "as 0.5:0.61"
            ) from None
        found.append((share, darkness))
    fault = fault_of(found)
    if fault:
        raise FileError(f"--paper {text}: {fault}")
    return tuple(found)


def fault_of(paper: Sequence[tuple[float, float]]) -> str:
    """What is wrong with shares and how dark they were measured; empty: nothing."""
    last = (0.0, 0.0)
    for share, darkness in paper:
        if not (last[0] < share < 1.0 and last[1] < darkness <= 1.0):
            return (
                "both numbers have to rise, shares between 0 and 1, and darkness up to 1, and "
                f"{share:g}:{darkness:g} does not"
            )
        last = (share, darkness)
    return ""

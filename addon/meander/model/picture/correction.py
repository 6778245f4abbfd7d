# SPDX-License-Identifier: GPL-3.0-or-later
"""What to ask for where a drawing is darker or lighter than it was to be; no bpy.

Strokes and hatching that are finer than the spacing of their strands leave the line no room for the
ink that they want, and one strand more or less across a white place is a choice of the flow's. What
a drawing lacks, seen from where strands run together, is asked for in addition: a feedback by what
is measured, as halftones by error diffusion have it (Floyd and Steinberg 1976). It is added and not
multiplied, so that strokes stay as dark as the pen can be and the places between them change.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..toolpaths.toolpath import Strand
from .drawn import ToneError, ink_of, tone_error
from .image import blurred
from .sheet import Grid
from .tone import Tone

# The least share that is asked for, in times of the lightest: as a place that lies between two
# strands has it, whatever it asks for.
_LEAST = 0.5
# A line that is farther from the tone, at two mean spacings, is corrected; and how often at most.
_NEAR_TONE, _CORRECTIONS = 0.01, 2
# What a correction takes, in times of the first run, and all that there may be with that run.
_COST = 2.0 / 3.0
COSTS = 1.0 + _CORRECTIONS * _COST


@dataclass(frozen=True)
class Tones:
    """The ink that a line is to have on a sheet.

    grid     over the sheet
    share    of ink at its places, 0 where there is no line
    places   the place of each vertex that is filled
    one      the share where the density is 1
    width    of the line, in the units of the grid
    tone     for the darkest and the lightest that the line can be
    onto     (4, 4), from where the line runs to the grid; None: it runs there
    """

    grid: Grid
    share: NDArray[np.float64]
    places: NDArray[np.int64]
    one: float
    width: float
    tone: Tone
    onto: NDArray[np.float64] | None = None

    @property
    def mean_spacing(self) -> float:
        return self.width / float(self.share.ravel()[self.places].mean())

    def density_of(self, share: NDArray[np.float64]) -> NDArray[np.float64]:
        """The density of the vertices for a share of ink at the places of the grid."""
        return (share.ravel()[self.places] / self.one) ** 2

    def revised(self, spacing: float, density: NDArray[np.float64]) -> Tones:
        """Those of another density, and of another spacing where that is 1: the line is as much
        wider as its strands are farther apart."""
        share = np.zeros(self.share.size)
        share[self.places] = np.sqrt(density) * self.one
        return replace(self, share=share.reshape(self.share.shape), width=self.one * spacing)

    def ink_of(self, strands: Sequence[Strand]) -> NDArray[np.float64]:
        """The share of ink that strands have at the places of the grid."""
        if self.onto is not None:
            turn, shift = self.onto[:3, :3].T, self.onto[:3, 3]
            strands = [replace(each, points=each.points @ turn + shift) for each in strands]
        return ink_of(strands, self.width, self.grid)


class Correction:
    """What is asked of a flow, run after run, until its line has the tones.

    error     of the line that is nearest to them; None: none was measured
    nearest   whether that is the last one
    """

    def __init__(self, tones: Tones) -> None:
        self._tones, self._asked = tones, tones.share
        self._ink: NDArray[np.float64] | None = None
        self.made = 0  # how often it was corrected
        self.error: ToneError | None = None
        self.nearest = True

    def measure(self, strands: Sequence[Strand]) -> ToneError:
        """How far a line is from the tones, with which a run has ended."""
        tones = self._tones
        self._ink = tones.ink_of(strands)
        error = tone_error(self._ink, tones.share, tones.mean_spacing, tones.grid)
        self.nearest = self.error is None or error.two < self.error.two
        if self.nearest:
            self.error = error
        return error

    def following(self) -> NDArray[np.float64] | None:
        """The density with which the flow is to go on; None: the line is near enough, or comes no
        nearer."""
        near = self.error is None or self.error.two <= _NEAR_TONE
        if near or not self.nearest or self.made == _CORRECTIONS:
            return None
        self.made += 1
        tones = self._tones
        blur = 2.0 * tones.mean_spacing / tones.grid.cell
        self._asked = corrected(self._asked, tones.share, self._ink, blur, tones.tone)
        return tones.density_of(self._asked)

    def progress(self, of_run: float) -> float:
        """How much is done of the run and all corrections that there may be, in [0, 1].

        of_run   of the present run
        """
        before = 1.0 + _COST * (self.made - 1) if self.made else 0.0
        return (before + (_COST if self.made else 1.0) * of_run) / COSTS


def corrected(
    asked: NDArray[np.float64],
    share: NDArray[np.float64],
    ink: NDArray[np.float64],
    blur: float,
    tone: Tone,
) -> NDArray[np.float64]:
    """The share of ink to ask for next, at the places of a grid.

    asked   the share with which the drawing was made
    share   that it was to have
    ink     that it has
    blur    from where it is seen, in cells
    """
    lacking = blurred(share - ink, blur)
    return (asked + lacking).clip(_LEAST * tone.lightest, tone.darkest)

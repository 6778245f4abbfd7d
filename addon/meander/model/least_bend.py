# SPDX-License-Identifier: GPL-3.0-or-later
"""A radius of bending that no turn of a curve is to fall short of: more stiffness, until it holds.

Turns get wider with the stiffness, but not by a rule: the sharpest of hundreds is what counts, and
where the surface itself bends, or the spacing is too small, no stiffness helps. So the curve that
has grown gets stiffer in steps, and is measured after each. No bpy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from .. import core
from .bend_radius import Bend

# Up to where a curve still turns at the spacing; beyond twice as much the library warns.
STIFFNESSES = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)


class Stiffening:
    """What has been found for a radius that is asked for, in the units of the mesh; 0: for none.

    held   whether the curve keeps the radius, once it has been measured
    best   the bend that came nearest, and the stiffness of its curve; None: nothing was too sharp
    """

    def __init__(self, least: float) -> None:
        self.least = least
        self.held = True
        self.best: tuple[Bend, float] | None = None

    def following(self, bend: Bend | None, options: core.FlowOptions) -> core.FlowOptions | None:
        """The options with which a curve is to go on; None: it holds, or nothing helps.

        bend      its sharpest one, of bend_radius.sharpest_bend()
        options   with which it grew
        """
        self.held = bend is None or bend.radius >= self.least
        if self.held:
            return None
        if self.best is None or bend.radius > self.best[0].radius:
            self.best = bend, options.bending_weight
        return _stiffer(options)

    def refusal(self, length_text: Callable[[float], str]) -> str:
        """Of a radius that is not held, a sentence.

        length_text   writes a length
        """
        bend, stiffness = self.best
        place = ", ".join(f"{value:.4g}" for value in bend.place)
        return (
            f"no stiffness holds a bend radius of {length_text(self.least)}: the curve comes "
            f"nearest with {length_text(bend.radius)}, at a stiffness of {stiffness:g}, and bends "
            f"most sharply at ({place}); choose a larger spacing, a smaller radius, or a surface "
            "that is smoother there"
        )


def _stiffer(options: core.FlowOptions) -> core.FlowOptions | None:
    """The same options with the next stiffness; None: this is the last."""
    now = options.bending_weight
    following = [stiffness for stiffness in STIFFNESSES if stiffness > now]
    if not following:
        return None
    # The polish follows in proportion, as the weight of the table does.
    polish = options.polish_bending_weight * (following[0] / now if now > 0.0 else 1.0)
    return replace(options, bending_weight=following[0], polish_bending_weight=polish)

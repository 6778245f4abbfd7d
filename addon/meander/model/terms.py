# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user may set of the flow's own terms, apart from any preset; no bpy.

Lengths are in units of r, half the spacing, so that they mean the same at every spacing.
"""

from __future__ import annotations

from dataclasses import dataclass

from .. import core


@dataclass(frozen=True)
class Terms:
    """Weights, powers and lengths; None or 0 is the preset's own."""

    length: float | None = None
    bending: float | None = None
    length_power: float | None = None
    medial_power: float | None = None
    segment_share: float = 0.0  # h over r
    reach: float = 0.0  # r_max over r
    start_spacing_factor: float | None = None

    def apply(self, options: core.FlowOptions) -> None:
        """Puts what is set into options, whose radius is."""
        if self.length is not None:
            options.length_weight = self.length
        if self.bending is not None:
            # Both belong to one material: a curve that grows stiff should not be polished limp.
            if options.bending_weight > 0:
                options.polish_bending_weight *= self.bending / options.bending_weight
            options.bending_weight = self.bending
        if self.length_power is not None:
            options.length_power = self.length_power
        if self.medial_power is not None:
            options.medial_power = self.medial_power
        if self.segment_share:
            options.segment_length = self.segment_share * options.radius
        if self.reach:
            options.max_radius = self.reach * options.radius
        if self.start_spacing_factor is not None:
            options.start_spacing_factor = self.start_spacing_factor

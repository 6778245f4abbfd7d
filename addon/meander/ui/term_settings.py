# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights, powers and lengths of the flow, as settings on an object."""

from bpy.props import BoolProperty, FloatProperty


class TermSettings:
    """The part of MeanderSettings that says how the curve behaves."""

    use_weights: BoolProperty(
        name="Custom Weights",
        description="Use the weights and powers below instead of the preset's",
        default=False,
        options=set(),
    )
    length_weight: FloatProperty(
        name="Length",
        description=(
            "Weight of the curve's length: more keeps strands taut and farther apart, "
            "with more corners"
        ),
        default=0.0,
        min=0.0,
        max=1e6,
        soft_max=2.0,
        precision=2,
        step=10,
        options=set(),
    )
    bending_weight: FloatProperty(
        name="Bending",
        description=(
            "Weight of bending: more makes turns rounder and fewer, less lets the curve wind. "
            "The final polish follows in proportion"
        ),
        default=1.0,
        min=0.0,
        max=1e6,
        soft_max=5.0,
        precision=2,
        step=10,
        options=set(),
    )
    length_power: FloatProperty(
        name="Length Power",
        description=(
            "Power p of the length term; 2 is plain, larger values make segments more alike"
        ),
        default=2.0,
        min=1.5,
        max=8.0,
        precision=1,
        step=50,
        options=set(),
    )
    medial_power: FloatProperty(
        name="Spacing Power",
        description=(
            "Power q of the spacing term; 2 is plain, larger values weigh the worst gaps more"
        ),
        default=2.0,
        min=2.0,
        max=8.0,
        precision=1,
        step=50,
        options=set(),
    )
    segment_share: FloatProperty(
        name="Segment Length",
        description=(
            "Shortest segment in halves of the spacing. Longer is faster and coarser; 0 leaves it "
            "to the preset, which takes 0.2"
        ),
        default=0.0,
        min=0.0,
        max=1.0,
        soft_max=0.5,
        precision=2,
        step=5,
        options=set(),
    )
    reach: FloatProperty(
        name="Reach",
        description=(
            "How far strands look for others, in halves of the spacing. Less follows the seed's "
            "shape longer, below 2 parts may stay empty; 0 leaves it to the preset"
        ),
        default=0.0,
        min=0.0,
        max=1e6,
        soft_max=10.0,
        precision=1,
        step=50,
        options=set(),
    )
    start_spacing_factor: FloatProperty(
        name="Start Spacing",
        description=(
            "Fill at this many times the spacing first and shrink to it: fewer corners for more "
            "iterations. 1 is off"
        ),
        default=1.0,
        min=1.0,
        max=16.0,
        soft_max=8.0,
        precision=1,
        step=50,
        options=set(),
    )

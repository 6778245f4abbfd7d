# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the table of options that the flow itself takes, and the spacing."""

from __future__ import annotations

from .option import OF_PRESET, Flag, Option
from .presets import PRESETS

_MAIN, _ADVANCED, _SHAPE, _REGION = "Meander", "Advanced", "Strand Shape", "Region"
_PREFERENCES = "Preferences"
_TERMS, _PART = "terms of the energy", "part to fill"

ROWS: tuple[Option, ...] = (
    Option(
        "spacing",
        "Spacing",
        "Distance between neighbouring strands, in world units. "
        "Half of it takes four times as long; 0 proposes one from the size of the surface",
        _MAIN,
        low="fine lines that show small detail; half of it takes four times as long",
        high="few, bold strands",
        unit="length",
        least=0.0,
        soft_greatest=10.0,
        digits=3,
        step=1,
        flag=Flag(
            "--spacing",
            "distance between neighbouring strands, in scene units; default: automatic, as the "
            "panel proposes it, a thirtieth of the side of a square of the surface's area",
            metavar="S",
            above=0.0,
            entry="spacing",
        ),
    ),
    Option(
        "preset",
        "Quality",
        "How much time is taken to make the curve even",
        _ADVANCED,
        kind=str,
        default="even",
        choices=(
            ("even", "Even", "Evenly spaced, with few hairpins"),
            ("finest", "Finest", "More even than Even, in long rows with a third of the hairpins"),
            ("paper", "As Published", "Faster, more winding, less even: the method as published"),
        ),
        field="preset",
        flag=Flag(
            "--quality",
            "how much time is taken to make the curve even, or a preset of the panel (flowing: a "
            "full start; rows: one along an axis; few-corners; organic), whose other flags may be "
            "given beside it; default: even",
            default="even",
            besides=tuple(PRESETS),
            former=("--preset",),
        ),
    ),
    Option(
        "start",
        "Start",
        "What the curve begins as",
        _ADVANCED,
        kind=str,
        default=OF_PRESET,
        choices=(
            (
                OF_PRESET,
                "Automatic",
                "Full in Finest, and along a direction where nothing is drawn; else Grow",
            ),
            (
                "grow",
                "Grow",
                "A small loop, or what is drawn, grows until it fills the surface, as coral does",
            ),
            (
                "full",
                "Full",
                "A curve that fills the surface already, in long rows along the direction, or "
                "along a smooth one: more even, with a third of the hairpins, in half the time",
            ),
        ),
        numbers=(2, 0, 1),
        field="start",
        flag=Flag(
            "--start",
            "begin with what is drawn or a small loop, which grows (grow), or with a curve that "
            "fills the surface already, in rows along --direction or a smooth field (full); "
            "default: preset, which is full in finest, and along --direction where no seed is "
            "given, and grow else",
            default=OF_PRESET,
        ),
    ),
    Option(
        "medial_axis",
        "Distances",
        "How distances between strands are measured",
        _ADVANCED,
        kind=str,
        default=OF_PRESET,
        choices=(
            (
                OF_PRESET,
                "Automatic",
                "Along the surface in Even and Finest, through space in As Published",
            ),
            (
                "geodesic",
                "Along Surface",
                "Fills every sheet by itself, both sides of thin parts included, and keeps the "
                "spacing across creases",
            ),
            (
                "euclidean",
                "In Space",
                "For a filament of constant width in space, as in printing: strands on sheets "
                "that lie close together keep clear of each other, and one side of a thin part "
                "stays empty",
            ),
        ),
        numbers=(2, 1, 0),
        field="medial_axis",
        flag=Flag(
            "--medial-axis",
            "measure distances between strands along the surface (geodesic, or surface) or through "
            "space, for a filament of constant width there (euclidean); default: preset, which is "
            "through space in paper and along the surface else",
            default=OF_PRESET,
            synonyms=(("surface", "geodesic"),),
        ),
    ),
    Option(
        "roughness",
        "Follow Roughness",
        "How much of a rough surface's bumps the spacing follows. At 0 it is measured on the "
        "surface smoothed at the scale of the spacing; at 1 on every bump, and the curve may "
        "never settle",
        _ADVANCED,
        low="calm lines, also where the surface is crumpled",
        high="lengths over every bump count; slow on rough surfaces, and uneven",
        row="Roughness",
        unit="share",
        least=0.0,
        greatest=1.0,
        step=10,
        field="roughness",
        zero_is_preset=True,
        flag=Flag(
            "--roughness",
            "how much of the surface's roughness the spacing follows, from 0 (measured on the "
            "surface smoothed at the scale of the spacing) to 1 (on the surface as it is); "
            "default: 0, in paper 1",
            _TERMS,
            "W",
            least=0.0,
            greatest=1.0,
        ),
    ),
    Option(
        "variation",
        "Variation",
        "Which of many curves of the same settings it is: each begins elsewhere, and is the same "
        "every time. Fill Again makes it",
        _MAIN,
        low="0: the curve that other numbers are variations of",
        high="one more of as many curves as you like, as even as any other",
        kind=int,
        default=0,
        least=0,
        greatest=2**31 - 1,
        field="variation",
        flag=Flag(
            "--variation",
            "which of many curves of the same options: each begins elsewhere on the surface, and "
            "is the same every time; default: 0",
            metavar="N",
            least=0,
            greatest=2**31 - 1,
            default=0,
        ),
    ),
    Option(
        "iteration_limit",
        "Iteration Limit",
        "Stop after at most this many rounds; 0 leaves it to the quality",
        _PREFERENCES,
        low="ends sooner, less even",
        high="no effect once the curve is even",
        row="Most Steps",
        kind=int,
        default=0,
        least=0,
        soft_greatest=2000,
        field="iteration_limit",
        zero_is_preset=True,
        flag=Flag("--iterations", "iteration limit", metavar="N", least=1, greatest=2**31 - 1),
    ),
    Option(
        "threads",
        "Threads",
        "Number of threads; 0 uses all of the machine's. The result does not depend on it",
        _PREFERENCES,
        low="leaves the machine to other work",
        high="faster, up to the number of cores",
        kind=int,
        default=0,
        least=0,
        greatest=256,
        soft_greatest=16,
        field="threads",
        flag=Flag(
            "--threads",
            "number of threads; 0: all; the result does not depend on it",
            metavar="T",
            least=0,
            greatest=256,
            default=0,
        ),
    ),
    Option(
        "use_weights",
        "Custom Shape",
        "Use the four values below instead of those of the quality",
        _SHAPE,
        row="Custom",
        kind=bool,
        default=False,
    ),
    Option(
        "length_weight",
        "Tension",
        "More keeps strands taut and farther apart, with more corners",
        _SHAPE,
        low="0: strands wind as they like",
        high="taut strands, farther apart, with more corners",
        least=0.0,
        greatest=1e6,
        soft_greatest=2.0,
        field="length_weight",
        switch="use_weights",
        flag=Flag(
            "--length", "weight of the curve's length", _TERMS, "W", least=0.0, entry="length"
        ),
    ),
    Option(
        "bending_weight",
        "Stiffness",
        "More makes turns rounder and fewer, less lets the curve wind",
        _SHAPE,
        low="the curve winds in small, tight turns",
        high="few round turns, which may leave corners empty",
        default=1.0,
        least=0.0,
        greatest=5e5,  # of the polish, which follows, the library takes no more than a million
        soft_greatest=5.0,
        field="bending_weight",
        switch="use_weights",
        # Both belong to one material: a curve that grows stiff should not be polished limp.
        follows="polish_bending_weight",
        flag=Flag(
            "--bending",
            "weight of bending; the polish follows in proportion",
            _TERMS,
            "W",
            least=0.0,
            entry="bending",
        ),
    ),
    Option(
        "length_power",
        "Regularity",
        "Larger values make the segments of the curve more alike; 2 is plain",
        _SHAPE,
        low="segments differ in length",
        high="segments are alike, growth is slower",
        default=2.0,
        least=1.5,
        greatest=8.0,
        digits=1,
        step=50,
        field="length_power",
        switch="use_weights",
        flag=Flag("--length-power", "p of the length term; default: 2", _TERMS, "P", least=0.0),
    ),
    Option(
        "medial_power",
        "Close Gaps",
        "Larger values close the worst gaps first; 2 treats all places alike",
        _SHAPE,
        low="all places count alike",
        high="the worst gaps close first, the rest is less even",
        default=2.0,
        least=2.0,
        greatest=8.0,
        digits=1,
        step=50,
        field="medial_power",
        switch="use_weights",
        flag=Flag("--medial-power", "q of the medial term; default: 2", _TERMS, "Q", least=0.0),
    ),
    Option(
        "segment_share",
        "Segment Length",
        "Shortest segment, in spacings. Longer is faster and coarser; 0 leaves it "
        "to the quality, which takes 0.1",
        _SHAPE,
        low="smoother, slower",
        high="faster, with visible corners",
        row="Detail",
        unit="r",
        least=0.0,
        greatest=1.0,
        soft_greatest=0.5,
        step=5,
        field="segment_length",
        zero_is_preset=True,
        least_used=0.01,
        flag=Flag(
            "--segment-length",
            "length of a segment, in scene units; default: a tenth of the spacing",
            _TERMS,
            "H",
            above=0.0,
            in_scene_units=True,
        ),
    ),
    Option(
        "reach",
        "Sight",
        "How far strands see others, in spacings. Less follows the seed's shape longer, "
        "below 1 parts may stay empty; 0 leaves it to the quality",
        _SHAPE,
        low="the shape of the seed is kept longer; below 1 parts may stay empty",
        high="strands feel each other from afar; slower",
        unit="r",
        least=0.0,
        greatest=1e6,
        soft_greatest=10.0,
        digits=1,
        step=50,
        field="max_radius",
        zero_is_preset=True,
        least_used=1.5,
        flag=Flag(
            "--max-radius",
            "limit of the medial radius, in scene units",
            _TERMS,
            "RMAX",
            above=0.0,
            in_scene_units=True,
        ),
    ),
    Option(
        "start_spacing_factor",
        "Start Spacing",
        "Fill at this many times the spacing first and shrink to it: fewer corners for more "
        "iterations. 1 is off",
        _SHAPE,
        low="1: filled at the spacing at once",
        high="fewer corners, many more iterations",
        row="Start Wide",
        default=1.0,
        least=1.0,
        greatest=16.0,
        soft_greatest=8.0,
        digits=1,
        step=50,
        field="start_spacing_factor",
        flag=Flag(
            "--start-spacing",
            "fill at this many times the spacing first, then come down to it: fewer corners, "
            "more iterations; 1 to 16",
            _TERMS,
            "FACTOR",
            least=0.0,
        ),
    ),
    Option(
        "least_bend_radius",
        "Least Bend Radius",
        "No turn is to be sharper, as a filament or a tube asks: the curve gets stiffer until that "
        "holds, up to a stiffness of 8. 0 asks for none",
        _SHAPE,
        low="0: turns are as sharp as they come",
        high="stiffer, less even; from half a spacing on nothing holds",
        row="Least Bend",
        unit="length",
        least=0.0,
        soft_greatest=10.0,
        digits=3,
        step=1,
        flag=Flag(
            "--least-bend-radius",
            "no turn may be sharper, over an arc of a quarter of the spacing, in scene units: the "
            "curve gets stiffer until that holds, and is refused, with the place, where nothing "
            "holds it",
            _TERMS,
            "L",
            above=0.0,
            entry="least_bend_radius",
        ),
    ),
    Option(
        "border_distance",
        "Boundary Distance",
        "Distance of the last strand from boundaries and holes, in spacings. "
        "At 0 strands run along the boundary",
        _REGION,
        low="0: the last strand runs along the boundary",
        high="an empty rim, up to two spacings wide",
        row="Boundary",
        unit="spacing",
        default=0.5,
        least=0.0,
        greatest=2.0,
        step=5,
        field="boundary_distance",
        flag=Flag(
            "--boundary-distance",
            "distance of the last strand from boundaries, in spacings, from 0 to 2; default: 0.5",
            _PART,
            "D",
            least=0.0,
            greatest=2.0,
            former=("--border-distance",),
        ),
    ),
)

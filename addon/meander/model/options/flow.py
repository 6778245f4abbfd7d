# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the table of options that the flow itself takes, and the spacing."""

from __future__ import annotations

from .option import OF_PRESET, Flag, Option
from .presets import PRESETS
from .shape import SHAPE_ROWS

_MAIN, _ADVANCED, _REGION = "Meander", "Advanced", "Region"
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
            "panel proposes it, a thirtieth of the side of a square of the surface's area, and as "
            "wide as two strands need in the stems of a sheet such as a text",
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
    *SHAPE_ROWS,
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

# SPDX-License-Identifier: GPL-3.0-or-later
"""What came of a run, as a user reads it; no bpy."""

from __future__ import annotations

from .joining import Joining

# What run() returns. That a run has come to its end is nothing to mention.
ENDED = {
    "iteration_limit": "At the iteration limit",
    "stalled": "Nothing could move",
    "cancelled": "Stopped by hand",
}
# Of a surface that was smoothed where its spacing is measured: as short as a panel is wide.
ROUGH = "Rough surface: bumps smoothed, see Roughness"
# Gaps that matter are farther from the curve than this, in half spacings: what the library counts
# as empty. Smaller ones are what is left where strands turn: they are not seen, and no run is
# without them. Two hairpins side by side leave 1.5, and more where they turn along a boundary.
GAP_THAT_MATTERS = 1.6


def lines(strands: int, closed: int, guides: int = 0) -> str:
    """Whether the curve is one line: "One closed line", "One open line", "3 lines".

    strands, closed   how many strands there are, and how many of them are closed; without guides
    guides            how many strands are guides besides
    """
    if strands == 1:
        text = "One closed line" if closed else "One open line"
    else:
        text = f"{strands:,} lines"
    if not guides:
        return text
    return f"{text}, {guides:,} guide" + ("s" if guides > 1 else "")


def why_lines(
    lines: int,
    parts: int,
    small_parts: int,
    guides: int,
    seeded: bool,
    joining: Joining | None = None,
    setting: str = "",
    lying: int = 0,
) -> str:
    """Why a curve is not one line: "the mesh has 201 parts, 199 of them smaller than the spacing";
    empty for one line.

    lines        how many there are, without guides
    parts        components of the surface
    small_parts  how many of them are smaller than the spacing
    guides       how many strands are guides
    seeded       whether somebody gave the strands that it began with
    joining      the distance that would join the parts; None: none is so small
    setting      what sets it
    lying        how many parts lie on others
    """
    if lines < 2:
        return ""
    if lines != parts and seeded:
        return "the seed has as many strands"
    if lines != parts and guides:
        return "guides part the mesh"
    why = f"the mesh has {parts:,} parts"
    if small_parts:
        why = f"{why}, {small_parts:,} of them smaller than the spacing"
    if lying:
        on = "1 of them on another" if lying == 1 else f"{lying:,} of them on others"
        why = f"{why}, {on}: what lies there twice is filled twice, unless it is deleted"
    if joining is None:
        return why
    fewer = "one" if joining.parts == 1 else f"{joining.parts:,}"
    return f"{why}, which {setting} {joining.distance:g} would make {fewer}"


def evenness(share: float) -> str:
    """As per cent; 100 only where nothing at all is uneven."""
    percent = 100.0 * share
    return f"{min(percent, 99.0) if percent < 100.0 else percent:.0f} %"


def is_rough(smoothing: float, stretch: float) -> bool:
    """Whether smoothing a surface makes a difference that is worth a word: half a per cent of its
    lengths."""
    return smoothing > 0.0 and stretch > 1.005


def roughness(smoothing: float, stretch: float) -> str:
    """What a rough surface was smoothed by where its spacing is measured; empty: nothing worth a
    word.

    smoothing  mean width of the Gaussian, in half spacings
    stretch    lengths on the surface in those on the smoothed one
    """
    if not is_rough(smoothing, stretch):
        return ""
    return (
        f"Rough surface: the spacing is measured with bumps smoothed by {smoothing / 2:.2g} "
        f"spacings, which shortens lengths by {100.0 * (1.0 - 1.0 / stretch):.0f} %"
    )


def gaps(count: int, largest: float) -> str:
    """The gaps that matter in words, such as "3 gaps up to 2.1 spacings wide"; empty: none.

    count     how many; -1 where they were not looked for
    largest   distance from the middle of the largest one to the curve, in half spacings
    """
    if count <= 0:
        return ""
    return f"{count:,} gap" + ("s up to" if count > 1 else "") + f" {largest:.1f} spacings wide"

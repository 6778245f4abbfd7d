# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a mesh, in the words of somebody who models; no bpy."""

from __future__ import annotations

import numpy as np

from .. import core

# By core.FAULTS: of one, and of several.
_WORDS = {
    "not_finite": ("1 vertex without a position", "{} vertices without a position"),
    "no_area": ("1 face without area", "{} faces without area"),
    "doubled_face": ("1 face that lies on another", "{} faces that lie on others"),
    "crowded_edge": (
        "1 place where more than two faces share an edge",
        "{} places where more than two faces share an edge",
    ),
    "bow_tie": (
        "1 place where parts touch in one point only",
        "{} places where parts touch in one point only",
    ),
    "one_sided": ("only one side, as a Moebius strip has",) * 2,
    "seam": ("1 edge along an open seam", "{} edges along open seams"),
}


def described(faults: core.Faults) -> str:
    """How many faults of each kind there are, the gravest first; empty if there are none."""
    counts = np.bincount(faults.kinds, minlength=len(core.FAULTS))
    parts = [
        _WORDS[kind][count > 1].format(f"{count:,}")
        for kind, count in zip(core.FAULTS, counts.tolist(), strict=True)
        if count
    ]
    if len(parts) < 2:
        return "".join(parts)
    return f"{', '.join(parts[:-1])} and {parts[-1]}"


def refusal(name: str, faults: core.Faults, strict: bool) -> str:
    """One sentence about a mesh that cannot be filled, and what to do.

    faults   all of them, at least one
    strict   whether those that are safe to repair were not
    """
    text = f"'{name}' has {described(faults)}; press Show Faults to select them"
    if (faults.kinds != core.FAULTS.index("not_finite")).all() and strict:
        return f"{text}, or turn off Strict to have them repaired"
    return f"{text}, and correct them"

# SPDX-License-Identifier: GPL-3.0-or-later
"""Flows for tests, in one line: a preset, what is changed of it, and a mesh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from meander import batch, core
from numpy.typing import NDArray


def options_of(preset: str = "even", /, **changes: Any) -> core.FlowOptions:
    """The options of a preset, some of them changed."""
    options = core.default_options(preset)
    for name, value in changes.items():
        setattr(options, name, value)
    return options


def flow_on(
    mesh: tuple,
    preset: str = "even",
    /,
    seed: core.Seed | None = None,
    density: NDArray | None = None,
    preparation: core.SurfaceOptions | None = None,
    **changes: Any,
) -> core.Flow:
    """A flow on vertices and faces that has not begun; it outlives its surface."""
    with core.Surface(*mesh, preparation) as surface:
        return core.Flow(surface, options_of(preset, **changes), seed, density)


def fill(mesh: Path, output: Path, *words: object) -> int:
    """The exit code of the command that fills a mesh of one file into another."""
    given = ("--input", mesh, "--output", output, *words)
    return batch.main([str(word) for word in given])

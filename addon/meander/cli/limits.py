# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that say how large a run may be; no bpy."""

from __future__ import annotations

import argparse
from dataclasses import replace

from .. import core
from ..model.estimate import BYTES_PER_POINT, available_memory, cost_in_words, size_in_words
from ..model.problem import Problem
from . import values
from .values import BadInput

# Where nobody knows how much memory there is.
_MOST_NODES = 5_000_000
_MEGABYTE = 1_000_000
# Bytes of Python, numpy and the library before a mesh is read.
_PROGRAM = 45 * _MEGABYTE
# What of a run's memory is left while it is written: the curve, and what its nodes carry.
_KEPT = 0.3
# From here on the library refuses by itself, and no flag helps.
MOST_OF_LIBRARY = 500_000_000


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "limits", "A run that is expected to be larger is refused before it begins."
    )
    group.add_argument(
        "--limit-nodes",
        type=values.reader(int, least=1),
        metavar="N",
        help="of the curve; default: as many as the memory holds, and where nobody knows how much "
        f"that is, {_MOST_NODES:,}",
    )
    group.add_argument(
        "--limit-memory",
        type=values.reader(float, above=0.0),
        metavar="MB",
        help="default: what the machine has available",
    )


def add_failing(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--fail-on-gaps",
        action="store_true",
        help="end with exit code 3, after all files are written, where more than a thousandth of "
        "the surface is farther than 0.8 spacings from the curve; parts narrower than a spacing "
        "do not count",
    )


def of_process(cost: core.Cost, problem: Problem) -> core.Cost:
    """The same with the memory of what stands beside the library: the program, and the mesh as it
    was read."""
    mesh = problem.vertices.nbytes + problem.faces.nbytes
    return replace(cost, memory=cost.memory + _PROGRAM + mesh)


def cost_with_files(cost: core.Cost) -> float:
    """Bytes that a run needs at most, while the curve grows or while it is written."""
    return max(cost.memory, _KEPT * cost.memory + BYTES_PER_POINT * cost.points)


def refuse_large(
    cost: core.Cost, arguments: argparse.Namespace, remedy: str = "a larger spacing"
) -> None:
    """Raises BadInput for a run that is expected to be larger than it may be.

    remedy   what to choose instead
    """
    if cost.nodes > MOST_OF_LIBRARY:
        return
    needed, limit = cost_with_files(cost), arguments.limit_memory
    available = available_memory() if limit is None else None
    most = arguments.limit_nodes
    if most is None and limit is None and available is None:
        most = _MOST_NODES
    if most is not None and cost.nodes > most:
        raise BadInput(
            f"the run would need about {cost_in_words(cost)}, and --limit-nodes is {most:,}; "
            f"choose {remedy}, or raise --limit-nodes"
        )
    if limit is not None and needed > limit * _MEGABYTE:
        raise BadInput(
            f"the run would need about {cost_in_words(cost)}, with its files "
            f"{size_in_words(needed)}, and --limit-memory is {limit:,g} MB; choose "
            f"{remedy}, or raise --limit-memory"
        )
    if available is not None and needed > available:
        raise BadInput(
            f"the run would need about {cost_in_words(cost)}, with its files "
            f"{size_in_words(needed)}, and {size_in_words(available)} are available; choose "
            f"{remedy}, or give --limit-memory MB to begin nevertheless"
        )

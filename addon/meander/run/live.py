# SPDX-License-Identifier: GPL-3.0-or-later
"""Live: other wishes for a curve that grows or has grown, taken from the settings as they change.

What a flow takes without beginning again are the spacing, the density and its own options; see
Flow.set_options. Of a finished run with Live on the flow is kept, as `suspended` keeps those that
were ended, until another run begins, Live is turned off, something is undone, or a file is opened.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, replace

import bpy
import numpy as np

from .. import core
from ..model.options.option import as_typed
from ..model.options.table import OF_THE_FLOW
from ..scene.alignment import alignment_of
from ..scene.columns import column
from ..scene.density import chosen_density, density_of
from ..scene.errors import DataError
from ..scene.identity import Key
from ..scene.linked_settings import settings_of
from ..scene.options import options_of
from ..scene.results import is_present
from ..scene.settings import surface_of
from .lasting import Activity
from .meaning import Meaning
from .plan import Plan
from .suspended import SuspendedRun, same_mesh

_OPTIONS = frozenset(
    name
    for option in OF_THE_FLOW
    for name in (option.setting, option.switch)
    if name and name not in ("threads", "variation")
)
_OTHERS = frozenset({"spacing", "alignment_weight", "factor_0", "factor_1", "use_density_range"})
# Densities that are read at the vertices of the mesh, so that painting changes them.
PAINTED = frozenset({"GROUP", "ATTRIBUTE", "COLOR"})


def is_live(setting: str) -> bool:
    """Whether a flow takes changes of a setting without beginning again."""
    return setting in _OPTIONS or setting in _OTHERS or setting.startswith(("density_", "tone_"))


def differs(before: Meaning, now: Meaning) -> bool:
    """Whether something has changed that a flow may take: a live setting, or what was painted."""
    live = [pair for pair in zip(before.settings, now.settings) if is_live(pair[0][0])]
    if any(mine != theirs for mine, theirs in live):
        return True
    painted = dict(now.settings).get("density_source") in PAINTED
    return painted and before.shape[0] == now.shape[0] and before.shape[1] != now.shape[1]


@dataclass(frozen=True)
class Wish:
    """What a flow is asked for next.

    density   per vertex; None: 1 everywhere
    asker     the object whose settings say so
    group     the vertex group that the density follows; empty: none
    """

    options: core.FlowOptions
    density: np.ndarray | None
    spacing: float
    asker: Key
    group: str = ""

    def applied(self, plan: Plan) -> Plan:
        """The plan of a run that has taken it."""
        problem = plan.problem.revised(self.options, self.density)
        return replace(
            plan,
            problem=problem,
            spacing=self.spacing,
            settings=self.asker,
            density_group=self.group,
        )


def wish_of(
    active: bpy.types.Object,
    plan: Plan,
    density_now: np.ndarray | Callable | None,
    depsgraph: bpy.types.Depsgraph,
) -> Wish | None:
    """What the settings of a surface or a result ask of the run of a plan; None: nothing else.

    density_now   of the flow, per vertex; a function of the surface counts as another density

    Raises DataError or core.MeanderError with a sentence for what cannot be used.
    """
    settings, problem = settings_of(active), plan.problem
    spacing = as_typed(settings.spacing) or plan.spacing
    options = options_of(settings, spacing)
    # A field is read when a run begins; how much it counts may change.
    fielded = problem.directions is not None
    options.alignment_weight = alignment_of(settings).weight if fielded else 0.0
    options.threads = problem.options.threads
    options.start = problem.options.start  # those of a run that has begun
    options.variation = problem.options.variation
    choice = chosen_density(settings, surface_of(active))
    density = density_of(choice, surface_of(active), depsgraph, spacing / 2.0)
    if callable(density):
        with core.Surface(
            problem.vertices, problem.faces, problem.surface_options, options.threads
        ) as surface:
            density = density(surface)
    if density is not None and len(density) != len(problem.vertices):
        raise DataError("The mesh has another number of vertices now; fill it again")
    same = (
        density_now is None
        if density is None
        else isinstance(density_now, np.ndarray) and np.array_equal(density, density_now)
    )
    if same and options == problem.options:
        return None
    group = choice.name if choice.source == "GROUP" else ""
    return Wish(options, density, spacing, Key(active), group)


# ------------------------------------------------------------------------------------------------
# The flow of the last run with Live on


@dataclass(frozen=True)
class Kept:
    """A finished run, and what its result was like when it was written."""

    run: SuspendedRun
    splines: str


finished: Activity[Kept] = Activity(
    undone=True, gone=lambda kept: kept.run.plan.surface.find() is None
)


def keep(run: SuspendedRun) -> None:
    """Keeps the flow of a run that has written its result, instead of the one before it."""
    result = run.plan.result.find()
    finished.end()
    if result is not None:
        finished.begin(Kept(run, _digest(result)))


def taken(active: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> SuspendedRun | None:
    """Hands out the run that is kept, if it is of this surface or result and goes on from what is
    there; it is kept no longer. Raises DataError for a surface that cannot be read.
    """
    kept = finished.taken()
    if kept is None:
        return None
    plan = kept.run.plan
    surface, result = plan.surface.find(), plan.result.find()
    if surface is None or surface_of(active) != surface or not is_present(result):
        return None
    # Whoever has edited the points by hand wants them as they are.
    of_another = active not in (surface, result) or _digest(result) != kept.splines
    return None if of_another or not same_mesh(plan, surface, depsgraph) else kept.run


def _digest(result: bpy.types.Object) -> str:
    """Another text for other points."""
    digest = hashlib.sha1(usedforsecurity=False)
    for spline in result.data.splines:
        points = column(spline.points, "co", 4)
        digest.update(points.tobytes() + bytes([spline.use_cyclic_u]))
    return digest.hexdigest()

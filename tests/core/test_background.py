# SPDX-License-Identifier: GPL-3.0-or-later
"""What lasts before a run, on a thread of the library's: the same as where the caller waits."""

from __future__ import annotations

from dataclasses import replace

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from meander.model.alignment import computed
from meander.model.density import Choice, curvature_density
from meander.model.geometry.reflection import mirror_of
from meander.model.opening import open_flow, opening
from meander.model.problem import Problem
from meander.model.steps import Background


def problem_of(**changes: object) -> Problem:
    vertices, faces = geometry.icosphere(3)
    return replace(Problem(vertices, faces, options_of(radius=0.1)), **changes)


CASES = {
    "plain": {},
    "curvature": {"density": curvature_density(Choice("CURVATURE", name="mean"), 0.1)},
    "directions": {"directions": computed("smooth")},
    "outline and mask": {
        "surface_options": core.SurfaceOptions(face_mask=np.arange(1280) < 900),
        "outline": 0.1,
    },
    "symmetry": {"mirror": mirror_of("x", np.eye(4), False)},
}


@pytest.mark.parametrize("case", CASES)
def test_a_flow_that_is_opened_in_the_background_is_the_same(case: str) -> None:
    problem = problem_of(**CASES[case])
    costs: list[core.Cost] = []
    with core.Context() as context:
        steps = Background(opening(problem, accept=costs.append), context)
        assert not steps.go_on(), "it has begun the first call, and not waited for it"
        assert steps.go_on(wait=True)
    opened, alike = steps.done, open_flow(problem, accept=costs.append)
    assert costs[0] == costs[1] and opened.figures == alike.figures
    with opened.flow as flow, alike.flow as other:
        for each in (flow, other):
            each.step()
            each.step()
        assert np.array_equal(flow.nodes().barycentrics, other.nodes().barycentrics)


def test_a_call_is_begun_and_waited_for() -> None:
    vertices, faces = geometry.icosphere(3)
    with core.Context() as context:
        begun = core.Surface.work(vertices, faces).begin(context)
        while begun.running:
            assert 0.0 <= context.progress <= 1.0
        with begun.result() as surface, core.Surface(vertices, faces) as other:
            assert surface.statistics() == other.statistics()
            assert surface.extent_work().begin(context).result() == other.extent()
        with pytest.raises(core.MeanderError, match="closed"):
            begun.result()


def test_what_is_cancelled_leaves_nothing() -> None:
    closed: list[str] = []
    with core.Context() as context:
        steps = Background(opening(problem_of(), accept=lambda _cost: closed.append("")), context)
        steps.go_on()
        context.cancel()
        with pytest.raises(core.MeanderError) as caught:
            steps.go_on(wait=True)
    assert caught.value.status == core.Status.CANCELLED


def test_a_refusal_closes_what_has_been_made(monkeypatch: pytest.MonkeyPatch) -> None:
    closed: list[core.Surface] = []
    close = core.Surface.close

    def noted(surface: core.Surface) -> None:
        closed.append(surface)
        close(surface)

    def refuse(_cost: core.Cost) -> None:
        raise ValueError("too much")

    monkeypatch.setattr(core.Surface, "close", noted)
    with core.Context() as context:
        steps = Background(opening(problem_of(), accept=refuse), context)
        with pytest.raises(ValueError, match="too much"):
            steps.go_on(wait=True)
    assert len(closed) == 1


def test_a_call_that_nobody_waits_for_ends_with_its_handle() -> None:
    vertices, faces = geometry.icosphere(5)
    context = core.Context()
    begun = core.Surface.work(vertices, faces).begin(context)
    begun.close()
    with pytest.raises(core.MeanderError, match="closed"):
        begun.running  # noqa: B018
    del begun
    core.Surface.work(vertices, faces).begin(context)  # collected at once
    context.close()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments of the wrong kind: one sentence that names the argument, never an error from within."""

from __future__ import annotations

from collections.abc import Callable

import geometry
import numpy as np
import pytest
from meander import core
from sentences import assert_sentence

OPTIONS = core.default_options("even")
OPTIONS.radius = 0.2


@pytest.fixture(scope="module")
def flow() -> core.Flow:
    mesh = geometry.grid(4)
    with core.Surface(mesh.vertices, mesh.faces) as surface:
        return core.Flow(surface, OPTIONS)


def _surface() -> core.Surface:
    mesh = geometry.grid(4)
    return core.Surface(mesh.vertices, mesh.faces)


WRONG: dict[str, Callable[[core.Flow], object]] = {
    "surface": lambda _flow: core.Flow(np.zeros((3, 3)), OPTIONS),
    "Surface": lambda _flow: core.Flow(None, OPTIONS),
    "context": lambda flow: flow.gaps(context=5),
    "Context": lambda _flow: core.Flow(_surface(), OPTIONS, context="now"),
    "radius": lambda flow: flow.set_radius("wide"),
    "tolerance": lambda flow: flow.rounded(None),
    "least size": lambda flow: flow.gaps([1, 2]),
    "detail": lambda flow: core.cut_surface(flow, "fine"),
    "flow": lambda flow: core.cut_surface(flow.polylines()),
    "masked": lambda _flow: core.Surface(np.ma.masked_equal(np.eye(3), 1.0), [[0, 1, 2]]),
    "no faces": lambda _flow: core.Surface(np.eye(3), []),
}


@pytest.mark.parametrize("name", WRONG)
def test_it_is_one_sentence_that_names_it(flow: core.Flow, name: str) -> None:
    with pytest.raises(core.MeanderError) as refusal:
        WRONG[name](flow)
    assert name in str(refusal.value)
    assert_sentence(str(refusal.value))


def test_what_is_masked_nowhere_is_an_array_like_any_other() -> None:
    mesh = geometry.grid(4)
    with core.Surface(np.ma.asarray(mesh.vertices), mesh.faces) as surface:
        assert surface.vertex_count == len(mesh.vertices)


def test_a_sentence_names_methods_of_python(flow: core.Flow) -> None:
    """The library's own names are those of C."""
    with pytest.raises(core.MeanderError, match=r"call start\(\) first"):
        flow.wait()
    flow.start()
    with pytest.raises(core.MeanderError, match=r"call wait\(\) first"):
        flow.start()
    flow.wait()
    with pytest.raises(core.MeanderError, match="or be None"):
        flow.set_density([1.0, 2.0])

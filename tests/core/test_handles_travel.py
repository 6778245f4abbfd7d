# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles that are copied, pickled, or sent to another process: a surface is made again from its
arrays, everything else refuses in a sentence. No process may die of it."""

from __future__ import annotations

import copy
import gc
import pickle
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import geometry
import numpy as np
import pytest
from conftest import PACKAGE
from flows import options_of
from meander import core
from meander.model.files import whole
from meander.model.files.whole import NotWritten
from sentences import assert_sentence

COPIES: dict[str, Callable[[Any], Any]] = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "deepcopy in a dict": lambda thing: copy.deepcopy({"a": [thing]})["a"][0],
    **{
        f"pickle {number}": lambda thing, number=number: pickle.loads(pickle.dumps(thing, number))
        for number in range(pickle.HIGHEST_PROTOCOL + 1)
    },
    "pickle in a list": lambda thing: pickle.loads(pickle.dumps([thing, thing]))[1],
}


def options() -> core.FlowOptions:
    chosen = options_of(radius=0.05)
    return chosen


def curve_on(surface: core.Surface) -> bytes:
    with core.Flow(surface, options()) as flow:
        for _ in range(3):
            flow.step()
        return flow.polylines().positions.tobytes()


@pytest.mark.parametrize("name", COPIES)
def test_the_copy_of_a_surface_is_one_of_its_own(name: str) -> None:
    with core.Surface(*geometry.grid(8)) as surface:
        expected, figures = curve_on(surface), surface.statistics()
        other = COPIES[name](surface)
    gc.collect()
    assert other is not surface
    assert other.statistics() == figures
    assert curve_on(other) == expected
    other.close()
    with pytest.raises(core.MeanderError) as caught:
        COPIES[name](other)
    assert_sentence(str(caught.value))


def test_errors_travel_as_they_are(tmp_path) -> None:
    """A pool of processes hangs or breaks where the error of a worker cannot be made again."""
    mesh = geometry.grid(4)

    def written() -> None:
        with whole.whole_file(tmp_path / "none" / "a.obj") as temporary:
            temporary.write_text("v 0 0 0\n")

    for kind, attempt in (
        (NotWritten, written),
        (whole.FileError, lambda: whole.read_bytes(tmp_path / "none")),
        (core.MeanderError, lambda: core.Surface(mesh.vertices, [[0, 1, 1]])),
        (core.MeanderError, lambda: core.SurfaceOptions(xyzzy=3)),
    ):
        with pytest.raises(kind) as caught:
            attempt()
        for again in (copy.copy(caught.value), pickle.loads(pickle.dumps(caught.value))):
            assert type(again) is kind and str(again) == str(caught.value)
            assert vars(again) == vars(caught.value)


def test_what_a_surface_was_made_of_is_its_own() -> None:
    vertices, faces = geometry.grid(8)
    mask = np.ones(len(faces), dtype=bool)
    mask[:10] = False
    prepared = core.SurfaceOptions(face_mask=mask, split_bow_ties=True)
    with core.Surface(vertices, faces, prepared) as surface:
        figures = surface.statistics()
        vertices[:], faces[:], mask[:] = 7.0, 0, False
        prepared.smallest_part = 1e9
        with copy.copy(surface) as other:
            assert other.statistics() == figures


@pytest.mark.parametrize("name", COPIES)
def test_a_flow_and_a_context_refuse(name: str) -> None:
    with core.Surface(*geometry.grid(8)) as surface, core.Flow(surface, options()) as flow:
        with core.Context() as context:
            begun = core.Surface.work(*geometry.grid(8)).begin(context)
            for handle in (flow, context, begun):
                with pytest.raises(core.MeanderError) as caught:
                    COPIES[name](handle)
                assert_sentence(str(caught.value))
                assert "make a new one" in str(caught.value)
            begun.result().close()
            assert flow.step(context) == "running"
    for closed in (flow, context, begun):
        with pytest.raises(core.MeanderError):
            COPIES[name](closed)


def test_all_handles_are_tried_here() -> None:
    def below(kind: type) -> set[str]:
        return {kind.__name__}.union(*(below(sub) for sub in kind.__subclasses__()))

    found = below(core.Surface.__base__) - {"Handle", "FlowRun", "Named"}
    assert found == {"Surface", "Flow", "Context", "Begun"}


PROGRAM = """
import multiprocessing, sys
sys.path[:0] = {paths!r}
from meander import core
import geometry

def figures(surface):
    with core.Context():
        return surface.statistics()

if __name__ == "__main__":
    with core.Surface(*geometry.grid(8)) as surface:
        flow_options = core.default_options()
        flow_options.radius = 0.05
        with core.Flow(surface, flow_options) as flow, core.Context() as context:
            with multiprocessing.get_context("spawn").Pool(2) as pool:
                found = pool.map(figures, [surface] * 3)
                assert found == [surface.statistics()] * 3
                for handle in (flow, context):
                    try:
                        pool.apply(figures, (handle,))
                    except core.MeanderError as refused:
                        print(refused)
                    else:
                        raise SystemExit("it was sent")
    print("done")
"""


def test_a_spawned_process_is_sent_a_surface_and_nothing_else(tmp_path) -> None:
    program = tmp_path / "program.py"
    paths = [str(PACKAGE.parent), str(PACKAGE.parents[1] / "tests" / "core")]
    program.write_text(PROGRAM.format(paths=paths), encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, str(program)], capture_output=True, text=True, timeout=120
    )
    assert ended.returncode == 0, ended.stderr
    assert ended.stdout.splitlines()[-1] == "done"
    assert ended.stdout.count("make a new one") == 2


class Named(core.Surface):
    """One that is made of something else, and knows more."""

    def __init__(self, cells: int, name: str) -> None:
        super().__init__(*geometry.grid(cells))
        self.name = [name]


@pytest.mark.parametrize("name", COPIES)
def test_a_class_made_from_a_surface_travels_with_what_it_knows(name: str) -> None:
    with Named(8, "leaf") as surface:
        expected = curve_on(surface)
        other = COPIES[name](surface)
    assert type(other) is Named and other.name == ["leaf"]
    assert other._pointer != surface._pointer
    assert curve_on(other) == expected
    other.close()

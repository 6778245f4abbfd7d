# SPDX-License-Identifier: GPL-3.0-or-later
"""A short run of every surface of the sweep, each curve checked after every iteration.

The sweep itself takes hours: see docs/reliability.md.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from meshes_at_the_limit import FAULTY
from rows import FACTORS, MEASURES, PRESETS, SEEDS, Limits, Run, all_runs, failed, short_runs
from sentences import assert_sentence
from shapes import SHAPES
from sweep import Sweep

# None of these takes more than ten seconds; the limits end what hangs.
LIMITS = Limits(seconds=20, clock=250)
RUNS = list(short_runs(SHAPES))


@pytest.fixture(scope="module")
def sweep(tmp_path_factory: pytest.TempPathFactory) -> Sweep:
    return Sweep({**SHAPES, **FAULTY}, tmp_path_factory.mktemp("inputs"), LIMITS)


@pytest.mark.parametrize("run", RUNS, ids=lambda run: run.model)
def test_short_run(sweep: Sweep, run: Run) -> None:
    row = sweep.run(run)
    assert not failed(row), row
    assert row["outcome"] != "refused", row
    assert row["checked"] == row["iterations"] + 1
    assert row["crossings"] == 0


@pytest.mark.parametrize("name", FAULTY)
def test_what_is_no_surface_is_refused(sweep: Sweep, name: str) -> None:
    row = sweep.run(Run(name, 1.0, "even", "geodesic", 1))
    assert row["outcome"] == "refused", row
    assert_sentence(row["reason"])


@pytest.mark.parametrize("name", ["saw", "knot", "through_each_other", "valence_3000"])
def test_curves_are_the_same_for_any_number_of_threads(sweep: Sweep, name: str) -> None:
    run = Run(name, 0.3, "even", "geodesic", 1, 1, 25)
    one, three = sweep.run(run), sweep.run(replace(run, threads=3))
    assert one["nodes"] > 50 and one["digest"] == three["digest"]


def test_the_sweep_is_what_it_is_said_to_be() -> None:
    assert len(SHAPES) >= 40
    assert len(list(all_runs(["a", "b"]))) == 2 * 5 * 3 * 2 * 3
    assert {run.preset for run in RUNS} == set(PRESETS)
    assert {run.measure for run in RUNS} == set(MEASURES)
    assert {run.seed for run in RUNS} == set(SEEDS)
    assert {run.factor for run in RUNS} < set(FACTORS)
    assert all(make.__doc__ for make in (*SHAPES.values(), *FAULTY.values()))


def test_shapes_are_the_same_every_time() -> None:
    for make in SHAPES.values():
        one, other = make(), make()
        assert one.vertices.tobytes() == other.vertices.tobytes()
        assert one.faces.tobytes() == other.faces.tobytes()


def test_a_folder_of_models_joins(tmp_path: Path) -> None:
    from sweep import models_in

    text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
    (tmp_path / "square.obj").write_text(text)
    (tmp_path / "notes.txt").write_text("no mesh")
    models = models_in(tmp_path)
    assert list(models) == ["square.obj"]
    row = Sweep(models, tmp_path, LIMITS).run(Run("square.obj", 1.0, "even", "geodesic", 2, 1, 12))
    assert not failed(row) and row["nodes"] > 20

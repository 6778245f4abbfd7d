# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments of the wrong kind: one sentence that names the argument, never an error from within."""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Callable
from pathlib import Path

import geometry
import numpy as np
import pytest
from conftest import REPOSITORY, of_python_package
from meander import core
from meander.model.files.whole import FileError
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


def _prepared(**wishes: object) -> core.Surface:
    return core.Surface(*geometry.grid(4), core.SurfaceOptions(**wishes))


def _seed(**wishes: object) -> core.Seed:
    ends = np.array([[0.2, 0.2, 0.0], [0.8, 0.8, 0.0]])
    return core.Seed(ends, np.array([0, 2]), np.array([0]), **wishes)


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
    "extent": lambda _flow: core.estimate_cost(_surface(), OPTIONS),
    "number of threads": lambda _flow: core.Surface(*geometry.grid(4), threads=2.5),
    "number of Threads": lambda _flow: _surface().find_closest(np.eye(3), threads="all"),
    "weld distance": lambda _flow: core.find_faults(*geometry.grid(4), None),
    "vertices": lambda _flow: core.automatic_spacing("plate", [[0, 1, 2]]),
    "faces": lambda _flow: core.automatic_spacing(np.eye(3), np.array([0, 1, 2])),
    "length step": lambda flow: flow.keep_growth("short", 5),
    "point limit": lambda flow: flow.keep_growth(0.1, -1),
    "a Context": lambda flow: flow.start("now"),
    "middle lines": lambda flow: core.cut_surface(flow, 0.0, "no"),
    "merge_distance": lambda _flow: _prepared(merge_distance="a tenth"),
    "weld_distance": lambda _flow: _prepared(weld_distance=np.zeros((40, 40))),
    "mask_threshold": lambda _flow: _prepared(mask_threshold=1j),
    "smallest_part": lambda _flow: _prepared(smallest_part=None),
    "drop_degenerate": lambda _flow: _prepared(drop_degenerate="no"),
    "make_manifold": lambda _flow: _prepared(make_manifold=float("nan")),
    "tunings": lambda flow: flow.set_options(dataclasses.replace(OPTIONS, tunings=[1.0])),
    "loops": lambda _flow: core.Flow(_surface(), OPTIONS, _seed(loops="yes")),
    "max_distance": lambda _flow: core.Flow(_surface(), OPTIONS, _seed(max_distance="far")),
}


@pytest.mark.parametrize("name", WRONG)
def test_it_is_one_sentence_that_names_it(flow: core.Flow, name: str) -> None:
    with pytest.raises(core.MeanderError) as refusal:
        WRONG[name](flow)
    assert name.lower() in str(refusal.value).lower()
    assert len(str(refusal.value)) < 250
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


def test_switches_are_those_of_python_and_of_numpy() -> None:
    for value in (False, True, np.True_, 0, 1):
        _prepared(drop_doubled=value).close()


OF_FILES: dict[str, Callable[[Path, core.Flow], object]] = {
    "NoneType is no path": lambda _path, _flow: of_python_package("files").read_mesh(None),
    "int is no path": lambda _path, _flow: of_python_package("files").read_curve(3),
    "list is no path": lambda path, flow: of_python_package("files").write_curve([path], flow),
    "float is no path": lambda _path, flow: _cut(1.5, flow),
    "cut must be a CutSurface": lambda path, _flow: _write_cut(path, None),
    "spacing nan": lambda path, flow: _cut(path, flow, float("nan")),
    "spacing 'x'": lambda path, flow: _cut(path, flow, "x"),
    "spacing -1": lambda path, flow: _cut(path, flow, -1),
    "step inf": lambda path, flow: _write(path, flow, step=float("inf")),
    "tolerance inf": lambda path, flow: _write(path, flow, tolerance=float("inf")),
    "frame_id b'map'": lambda path, flow: _write(path, flow, frame_id=b"map"),
}


def _write(path: Path, flow: core.Flow, **wishes: object) -> None:
    suffix = ".yaml" if "frame_id" in wishes else ".csv"
    of_python_package("files").write_curve(path.with_suffix(suffix), flow, **wishes)


def _write_cut(path: Path | float, cut: object, spacing: object = 0.1) -> None:
    of_python_package("files").write_cut(path, cut, spacing)


def _cut(path: Path | float, flow: core.Flow, spacing: object = 0.1) -> None:
    _write_cut(path, core.cut_surface(flow), spacing)


@pytest.mark.parametrize("said", OF_FILES)
def test_a_file_that_is_none_is_one_sentence(flow: core.Flow, said: str, tmp_path: Path) -> None:
    with pytest.raises(FileError) as refusal:
        OF_FILES[said](tmp_path / "cut.obj", flow)
    assert said in str(refusal.value)
    assert_sentence(str(refusal.value))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("light", ["x", b"1", {}, 1j, None])
def test_a_brightness_that_is_none_is_one_sentence(light: object) -> None:
    with pytest.raises(core.MeanderError) as refusal:
        of_python_package("pictures").tone_density(light, 0.1, 0.05)
    assert_sentence(str(refusal.value))


def test_a_path_may_be_of_bytes(flow: core.Flow, tmp_path: Path) -> None:
    _write_cut(bytes(tmp_path / "cut.obj"), core.cut_surface(flow))
    assert (tmp_path / "cut.obj").is_file()


def test_lists_are_taken_wherever_arrays_are() -> None:
    """Also in the eyes of what checks types."""
    takers = [core.Seed, core.SurfaceOptions, core.Surface, core.Flow]
    module = (REPOSITORY / "python" / "meander" / "__init__.py").read_text(encoding="utf-8")
    public = re.findall(r'^    "(\w+)",$', module, re.MULTILINE)
    takers += [getattr(core, name) for name in public if inspect.isfunction(vars(core).get(name))]
    assert core.find_closest in takers and core.automatic_spacing in takers
    takers += [method for kind in (core.Surface, core.Flow) for method in vars(kind).values()]
    for taker in takers:
        if callable(taker) and getattr(taker, "__name__", "_")[0] != "_":
            for parameter in inspect.signature(taker).parameters.values():
                assert "NDArray" not in str(parameter.annotation), (taker, parameter)
    seed = core.Seed([[0.2, 0.2, 0.0], [0.8, 0.8, 0.0]], [0, 2], [0], fixed=[1, 1], guides=[0])
    assert seed.points.shape == (2, 3) and seed.guides.tolist() == [0]
    faces = geometry.grid(4).faces.tolist()
    mask = core.SurfaceOptions(face_mask=[True] * len(faces), polygons=list(range(len(faces))))
    with core.Surface(geometry.grid(4).vertices.tolist(), faces, mask) as surface:
        core.Flow(surface, OPTIONS, seed, [1.0] * surface.vertex_count).close()

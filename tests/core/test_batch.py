# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command without Blender: OBJ in, OBJ and report out."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import geometry
import numpy as np
import pytest
from conftest import PACKAGE, without_blender
from flows import fill
from meander import core
from meander.binding import abi
from meander.cli import command
from meander.cli.place import Place
from meander.model import report
from meander.model.files import obj
from sentences import assert_sentence


@pytest.fixture
def square(tmp_path: Path) -> Path:
    return geometry.write_obj(tmp_path / "square.obj", geometry.grid(6))


@pytest.fixture
def run(tmp_path: Path, capsys: pytest.CaptureFixture):
    """Runs the command in this process: exit code, stdout, stderr."""

    def call(mesh: Path, *extra: str) -> tuple[int, str, str]:
        code = fill(mesh, tmp_path / "out.obj", "--report", tmp_path / "out.json", *extra)
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return call


@pytest.fixture
def refused(run, tmp_path: Path):
    """Runs the command and checks that it refuses, with outputs of an earlier run untouched."""

    def call(mesh: Path, *extra: str) -> str:
        for name in ("out.obj", "out.json"):
            (tmp_path / name).write_text("earlier")
        names = sorted(item.name for item in tmp_path.iterdir())
        code, out, err = run(mesh, *extra)
        assert code == 2, err
        assert out == ""
        assert err.endswith("\n")
        assert_sentence(err.rstrip("\n"))
        assert (tmp_path / "out.obj").read_text() == "earlier"
        assert (tmp_path / "out.json").read_text() == "earlier"
        assert sorted(item.name for item in tmp_path.iterdir()) == names
        return err

    return call


# ------------------------------------------------------------------------------------------------
# Good input


def test_report_has_every_key(run, square: Path, tmp_path: Path) -> None:
    code, out, err = run(square, "--spacing", "0.15", "--threads", "1", "--iterations", "200")
    assert (code, err) == (0, "")
    assert "wrote" in out
    found = json.loads((tmp_path / "out.json").read_text())
    assert found["version"] == core.VERSION
    assert set(found["surface"]) >= {"vertices", "faces", "components", "boundary_loops", "area"}
    assert set(found) >= {
        "version", "surface", "options", "iterations", "converged", "stop_reason", "nodes",
        "length", "crossings", "spacing", "history", "seconds", "gaps", "gap_count",
    }  # fmt: skip
    assert found["converged"] == (found["stop_reason"] == "converged")
    assert found["stop_reason"] in ("converged", "iteration_limit", "stalled")
    assert found["crossings"] == 0
    assert set(found["spacing"]) == {"target", "median", "p05", "p95"}
    assert found["spacing"]["target"] == pytest.approx(0.15)
    assert len(found["history"]) == found["iterations"]
    assert set(found["history"][0]) == {
        "iteration", "nodes", "length", "mean_step", "energy", "seconds",
    }  # fmt: skip
    assert set(found["seconds"]) == {
        "total", "medial_axis", "solve", "retract", "reconnect", "crossings", "refine",
    }  # fmt: skip
    options = found["options"]
    assert options["spacing"] == 0.15 and options["radius"] == 0.075
    assert options["threads"] == 1 and options["iteration_limit"] == 200
    assert options["preset"] == "even" and options["segment_length"] == pytest.approx(0.015)
    for field in core.FlowOptions.__dataclass_fields__:
        assert field in options


def test_output_is_the_curve(run, square: Path, tmp_path: Path) -> None:
    code, *_ = run(square, "--spacing", "0.15")
    assert code == 0
    curve = obj.read_obj_curve(tmp_path / "out.obj")
    found = json.loads((tmp_path / "out.json").read_text())
    assert curve.closed.tolist() == [1]
    length = geometry.curve_length(curve.points, curve.offsets, curve.closed)
    assert length == pytest.approx(found["length"], rel=1e-9)
    assert geometry.off_surface(geometry.grid(6), curve.points).max() <= 1e-9 * 0.075


def test_iteration_limit_is_a_success(run, square: Path, tmp_path: Path) -> None:
    code, *_ = run(square, "--spacing", "0.1", "--iterations", "3", "--quiet")
    assert code == 0
    found = json.loads((tmp_path / "out.json").read_text())
    assert found["stop_reason"] == "iteration_limit" and found["iterations"] == 3
    assert found["converged"] is False


def test_report_names_the_worst_gaps(run, square: Path, tmp_path: Path) -> None:
    # A run that is cut short has many.
    code, *_ = run(square, "--spacing", "0.04", "--iterations", "40", "--quiet")
    assert code == 0
    found = json.loads((tmp_path / "out.json").read_text())
    assert len(found["gaps"]) == report.MOST_GAPS < found["gap_count"]
    curve = obj.read_obj_curve(tmp_path / "out.obj")
    samples = geometry.samples_of(curve.points, curve.offsets, curve.closed, gap=0.0005)
    positions = np.array([gap["position"] for gap in found["gaps"]])
    radii = [gap["radius"] for gap in found["gaps"]]
    np.testing.assert_allclose(geometry.distance_to_samples(positions, samples), radii, rtol=1e-2)
    assert [gap["size"] for gap in found["gaps"]] == pytest.approx([r / 0.02 for r in radii])


def test_quiet_is_silent(run, square: Path) -> None:
    assert run(square, "--spacing", "0.2", "--iterations", "2", "--quiet") == (0, "", "")


def test_options_reach_the_flow(run, square: Path, tmp_path: Path) -> None:
    code, *_ = run(
        square, "--spacing", "0.2", "--iterations", "2", "--preset", "paper", "--length", "0.5",
        "--bending", "0.25", "--segment-length", "0.05", "--max-radius", "0.4", "--quiet",
        "--medial-axis", "euclidean", "--length-power", "2", "--medial-power", "2",
    )  # fmt: skip
    assert code == 0
    options = json.loads((tmp_path / "out.json").read_text())["options"]
    assert options["preset"] == "paper"
    assert options["length_weight"] == 0.5 and options["bending_weight"] == 0.25
    assert options["segment_length"] == 0.05 and options["max_radius"] == 0.4
    assert options["medial_axis"] == "euclidean"


def test_bending_keeps_the_proportion_of_the_polish(run, square: Path, tmp_path: Path) -> None:
    default = core.default_options("even")
    code, *_ = run(square, "--spacing", "0.2", "--iterations", "1", "--bending", "0.5", "--quiet")
    assert code == 0
    options = json.loads((tmp_path / "out.json").read_text())["options"]
    share = default.polish_bending_weight / default.bending_weight
    assert options["polish_bending_weight"] == pytest.approx(0.5 * share)


def test_terms_reach_the_flow(run, square: Path, tmp_path: Path) -> None:
    code, _, errors = run(
        square, "--spacing", "0.2", "--iterations", "3", "--direction", "x", "--across",
        "--alignment", "1.5", "--length-power", "3", "--medial-power", "4", "--start-spacing", "2",
        "--segment-length", "0.05", "--quiet",
    )  # fmt: skip
    assert code == 0
    report = json.loads((tmp_path / "out.json").read_text())
    options = report["options"]
    assert options["alignment_weight"] == options["alignment"] == 1.5
    assert options["length_power"] == 3 and options["medial_power"] == 4
    assert options["start_spacing_factor"] == 2
    assert options["direction"] == "x" and options["across"] is True
    (warning,) = report["warnings"]
    assert warning in errors


@pytest.mark.parametrize("field", ["curvature", "smooth", "y"])
def test_fields_are_made(run, tmp_path: Path, field: str) -> None:
    ball = geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))
    code, *_ = run(ball, "--spacing", "0.3", "--iterations", "5", "--direction", field, "--quiet")
    assert code == 0
    options = json.loads((tmp_path / "out.json").read_text())["options"]
    assert options["alignment"] == 1 and options["direction"] == field


def test_seed_file_is_used(run, square: Path, tmp_path: Path) -> None:
    seed = geometry.write_lines(tmp_path / "seed.obj", *[[(0.2, 0.3, 0), (0.8, 0.3, 0)]])
    code, *_ = run(square, "--spacing", "0.2", "--iterations", "5", "--seed", str(seed), "--quiet")
    assert code == 0
    assert obj.read_obj_curve(tmp_path / "out.obj").closed.tolist() == [0]


def test_as_a_script(square: Path, tmp_path: Path) -> None:
    command = [sys.executable, PACKAGE / "batch.py", "--", "--input", square]
    command += ["--output", tmp_path / "out.obj", "--iterations", "2", "--spacing"]
    good = subprocess.run([*command, "0.2"], capture_output=True, text=True, check=False)
    assert (good.returncode, good.stderr) == (0, "")
    bad = subprocess.run([*command, "-0.2"], capture_output=True, text=True, check=False)
    assert (bad.returncode, bad.stdout) == (2, "")
    assert_sentence(bad.stderr.strip())


# ------------------------------------------------------------------------------------------------
# Bad input

GOOD = ("--spacing", "0.2")


@pytest.mark.parametrize(
    "extra",
    [
        ("--spacing", "-1"),
        ("--spacing", "0"),
        ("--spacing", "nan"),
        ("--spacing", "inf"),
        ("--spacing", "wide"),
        ("--spacing", "100"),
        (*GOOD, "--iterations", "0"),
        (*GOOD, "--iterations", "many"),
        (*GOOD, "--threads", "-1"),
        (*GOOD, "--threads", "1000"),
        (*GOOD, "--segment-length", "0"),
        (*GOOD, "--segment-length", "0.19"),
        (*GOOD, "--max-radius", "0.01"),
        (*GOOD, "--length", "-1"),
        (*GOOD, "--bending", "nan"),
        (*GOOD, "--no-such-option"),
        (*GOOD, "--preset", "fast"),
        (*GOOD, "--density-group", "weights"),
        (*GOOD, "--density-attribute", "height"),
        (*GOOD, "--density-color", "paint"),
        (*GOOD, "--density-image", "map"),
        (*GOOD, "--density-group", "a", "--density-color", "b"),
        (*GOOD, "--density-range", "0", "1"),
        (*GOOD, "--spacing-factors", "1", "0.5"),
        (*GOOD, "--density-interpolation", "smooth"),
        (*GOOD, "--uv-map", "UVMap"),
        (*GOOD, "--density-curvature", "largest"),
        (*GOOD, "--density-curvature", "mean", "--density-group", "a"),
        (*GOOD, "--density-curvature", "mean", "--density-smoothing", "-1"),
        (*GOOD, "--density-smoothing", "1"),
        (*GOOD, "--density-ramp", "0:1,1:2"),
        *(
            (*GOOD, "--density-curvature", "mean", "--density-ramp", stops)
            for stops in ("", "0:1", "0:1,x:2", "0:1,1:2:3", "0:1,2:1", "0:1,1:9", "0:1,0:2",
                          "0.5:1,0.2:1", "0:nan,1:1", "nan:1,1:1")
        ),
        (*GOOD, "--density-curvature", "mean", "--density-ramp", "0:1,1:2",
         "--spacing-factors", "1", "2"),
        (*GOOD, "--density-curvature", "mean", "--density-ramp", "0:1,1:2",
         "--density-interpolation", "smooth"),
        (*GOOD, "--alignment", "1", "--direction", "u"),
        (*GOOD, "--alignment", "1", "--direction-object", "Curve"),
        (*GOOD, "--alignment", "1", "--direction", "x", "--direction-object", "Curve"),
        (*GOOD, "--alignment", "1", "--direction", "x", "--direction-smoothing", "1"),
        (*GOOD, "--object", "Cube"),
        (*GOOD, "--frame", "3"),
        (*GOOD, "--frame", "9999999"),
        (*GOOD, "--seed-object", "Curve"),
        (*GOOD, "--seed", "nowhere.obj"),
        (*GOOD, "--seed", "a.obj", "--seed-object", "b"),
        (*GOOD, "--alignment", "1"),
        (*GOOD, "--alignment", "-1", "--direction", "x"),
        (*GOOD, "--direction", "flow"),
        (*GOOD, "--across"),
        (*GOOD, "--length-power", "1"),
        (*GOOD, "--medial-power", "9"),
        (*GOOD, "--start-spacing", "0.5"),
        (*GOOD, "--medial-axis", "along"),
    ],
    ids=" ".join,
)
def test_bad_options(refused, square: Path, extra: tuple) -> None:
    refused(square, *extra)


def test_directions_start_full_unless_growth_is_asked_for(
    run, square: Path, tmp_path: Path
) -> None:
    shares = []
    for extra, start in (((), "FULL"), (("--start", "grow"), "GROW")):
        given = ("--spacing", "0.08", "--direction", "y", "--alignment", "2", *extra)
        code, _out, err = run(square, *given, "--quiet")
        assert code == 0, err
        curve = obj.read_obj_curve(tmp_path / "out.obj")
        chord = np.diff(curve.points, axis=0)
        length = np.linalg.norm(chord, axis=1)
        along = length[np.abs(chord[:, 1]) > 0.966 * length].sum() / length.sum()
        shares.append(along)
        options = json.loads((tmp_path / "out.json").read_text())["options"]
        assert options["start"] == start.lower()
    assert min(shares) > 0.75


def test_an_axis_that_stands_straight_up_is_refused_with_the_one_that_lies_best(
    run, square: Path
) -> None:
    code, _out, err = run(square, "--spacing", "0.2", "--direction", "z")
    assert (code, err.count("\n")) == (2, 1)
    assert "The Z axis stands straight up from the whole surface" in err and "choose X" in err
    code, *_ = run(square, "--spacing", "0.2", "--iterations", "3", "--direction", "axis")
    assert code == 0


def test_directions_on_a_mesh_file(run, square: Path, tmp_path: Path) -> None:
    """Along x most of the length lies along x, and across it along y."""
    shares = []
    for extra in ((), ("--across",)):
        given = ("--spacing", "0.18", "--alignment", "2", "--direction", "x", *extra)
        code, _out, err = run(square, *given)
        assert code == 0, err
        curve = obj.read_obj_curve(tmp_path / "out.obj")
        pieces = np.abs(np.diff(curve.points, axis=0))
        shares.append(pieces[:, 0].sum() / pieces.sum())
    assert shares[0] > 0.6 and shares[1] < 0.4
    options = json.loads((tmp_path / "out.json").read_text())["options"]
    assert (options["alignment"], options["direction"]) == (2.0, "x")
    assert options["across"] is True


def test_curvature_makes_a_mesh_file_denser(run, tmp_path: Path) -> None:
    """A sphere bends alike everywhere and keeps its spacing; a long ellipsoid does not."""
    vertices, faces = geometry.icosphere(3)
    ball = geometry.write_obj(tmp_path / "ball.obj", geometry.Mesh(vertices, faces))
    egg = geometry.mesh(vertices * (0.5, 0.5, 2.0), faces)
    egg = geometry.write_obj(tmp_path / "egg.obj", egg)
    lengths = {}
    for name in ("mean", "gaussian", None):
        density = ("--density-curvature", name) if name else ()
        for mesh in (ball, egg):
            code, _out, err = run(mesh, "--spacing", "0.4", "--iterations", "300", *density)
            assert code == 0, err
            length = json.loads((tmp_path / "out.json").read_text())["length"]
            lengths[mesh, name] = length
    for name in ("mean", "gaussian"):
        assert lengths[ball, name] / lengths[ball, None] == pytest.approx(1.0, rel=0.15)
        assert 1.05 < lengths[egg, name] / lengths[egg, None] < 2.1


def test_unknown_vertex_group_is_named(
    square: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    """Where Blender is there, it is the mesh file that has no groups."""
    arguments = ["--input", square, "--output", tmp_path / "out.obj", *GOOD]
    arguments += ["--density-group", "weights"]
    asked: list[str] = []

    class Host:
        def __getattr__(self, name: str) -> None:
            asked.append(name)
            raise AttributeError(name)

    place = Place("test", print, Host())
    assert command.main([str(argument) for argument in arguments], place) == 2
    assert "unknown vertex group 'weights'" in capsys.readouterr().err
    assert asked == []


@without_blender
@pytest.mark.parametrize(
    "extra",
    [
        ("--object", "Cube"),
        ("--seed-object", "Curve"),
        ("--guides-object", "Curve"),
        ("--direction-object", "Curve"),
        ("--density-group", "weights"),
        ("--mask-group", "weights"),
        ("--mask-material", "Gold"),
        ("--mask-attribute", "part"),
        ("--layout-map", "UVMap"),
        ("--bake-frames", "1", "2"),
        ("--points", "mesh"),
        ("--visible-only",),
        ("--output", "curve.blend"),
        ("--cut", "cut.blend"),
    ],
    ids=" ".join,
)
def test_what_needs_blender_says_so(
    refused, square: Path, extra: tuple, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(square.parent)
    sentence = refused(square, *GOOD, *extra)
    assert f"{extra[0] if extra[0] not in ('--output', '--cut') else extra[1]} needs Blender" in (
        sentence
    )
    assert "blender --command meander" in sentence


@without_blender
def test_a_scene_needs_blender(refused, square: Path) -> None:
    scene = square.with_suffix(".blend")
    scene.write_bytes(b"BLENDER")
    assert f"{scene} needs Blender" in refused(scene, *GOOD)


BAD_MESHES = {
    "no faces": ([[0, 0, 0], [1, 0, 0], [1, 1, 0]], []),
    "NaN": ([[0, 0, 0], [1, 0, 0], [1, float("nan"), 0]], [[0, 1, 2]]),
    "index out of range": ([[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 1, 7]]),
    "vertex twice": ([[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 1, 1]]),
    "three faces on an edge": (
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]],
        [[0, 1, 2], [0, 1, 3], [0, 1, 4]],
    ),
    "bow-tie": (
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0]],
        [[0, 1, 2], [0, 3, 4]],
    ),
    "zero area": ([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]),
    "Moebius": geometry.moebius(),
}


@pytest.mark.parametrize("name", BAD_MESHES)
def test_bad_mesh(refused, tmp_path: Path, name: str) -> None:
    bad = geometry.write_obj(tmp_path / "bad.obj", geometry.mesh(*BAD_MESHES[name]))
    refused(bad, *GOOD, "--strict")


@pytest.mark.parametrize(
    ("name", "counted"),
    [
        ("three faces on an edge", {"cut_edges": 1}),
        ("bow-tie", {"split_vertices": 1}),
        ("Moebius", {"opened_edges": 1}),
    ],
)
def test_faults_are_repaired_and_counted(run, tmp_path: Path, name: str, counted: dict) -> None:
    bad = geometry.write_obj(tmp_path / "bad.obj", geometry.mesh(*BAD_MESHES[name]))
    code, out, err = run(bad, "--spacing", "0.2", "--iterations", "20")
    assert code == 0, err
    record = json.loads((tmp_path / "out.json").read_text())
    assert {key: count for key, count in record["preparation"].items() if count} == counted
    assert record["options"]["strict"] is False
    assert any(f"{count} " in out for count in counted.values())



def test_bad_seed(refused, square: Path, tmp_path: Path) -> None:
    off = geometry.write_lines(tmp_path / "off.obj", *[[(0.2, 0.2, 0.9), (0.8, 0.8, 0.9)]])
    refused(square, *GOOD, "--seed", str(off))
    crossing = [(0.2, 0.2, 0), (0.8, 0.8, 0), (0.8, 0.2, 0), (0.2, 0.8, 0)]
    refused(square, *GOOD, "--seed", str(geometry.write_lines(tmp_path / "x.obj", *[crossing])))


def test_missing_input(refused, tmp_path: Path) -> None:
    refused(tmp_path / "nothing.obj", *GOOD)
    refused(tmp_path / "nothing.xyz", *GOOD)


def test_outputs_must_not_hide_inputs(refused, square: Path, tmp_path: Path) -> None:
    refused(square, *GOOD, "--output", str(square))
    refused(square, *GOOD, "--report", str(square))
    refused(square, *GOOD, "--report", str(tmp_path / "out.obj"))
    refused(square, *GOOD, "--output", str(tmp_path / "no" / "out.obj"))
    refused(square, *GOOD, "--output", str(tmp_path / "out.ply"))


def test_defect_is_not_bad_input(run, square: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr(command, "write_outputs", broken)
    code, _, err = run(square, *GOOD)
    assert code == 1 and "Traceback" in err


def test_report_is_strict_json(tmp_path: Path) -> None:
    surface = dict.fromkeys(
        ("vertices", "faces", "components", "boundary_loops", "area", "turned_faces"), 1
    )
    flow = dict.fromkeys([field[0] for field in abi.FlowStatisticsRecord._fields_], np.nan)
    flow["stop_reason"] = "stalled"
    options = {"stop_rule": core.StopRule.PAPER}
    gaps = core.Gaps(np.full((1, 3), np.inf), np.ones(1), np.ones(1), np.zeros(1, np.uint32))
    record = report.build_report("0", surface, flow, [], gaps, options)
    report.write_report(tmp_path / "r.json", record)
    found = json.loads((tmp_path / "r.json").read_text(), parse_constant=pytest.fail)
    assert found["gaps"] == [{"position": [None] * 3, "radius": 1.0, "size": 1.0}]
    assert found["length"] is None and found["options"]["stop_rule"] == "paper"

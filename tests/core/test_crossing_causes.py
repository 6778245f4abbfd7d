# SPDX-License-Identifier: GPL-3.0-or-later
"""A flat drawing that crosses itself is said with the cause: what is asked for decides it."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import pytest
from meander import batch
from sentences import assert_sentence

CROSSED = "v .2 .2 0\nv .8 .2 0\nv .8 .8 0\nv .2 .8 0\nl 1 3\nl 2 4\n"
LAYERS, ON_SURFACE = "one layer of the surface lies before another", "guides and bridges cross"
ARCS, FAR_APART = "arcs lie too far beside the line", "its points are too far apart"
ALL = (LAYERS, ON_SURFACE, ARCS, FAR_APART)


@pytest.mark.parametrize(
    ("mesh", "options", "cause"),
    [
        ("sheet", ("--guides", "guides.obj"), ON_SURFACE),
        ("sheet", ("--arcs", "2000"), ARCS),
        ("sheet", ("--chord-tolerance", "0.3"), FAR_APART),
        ("ball", (), LAYERS),
        ("ball", ("--arcs", "0.01"), LAYERS),
    ],
)
def test_the_cause_is_what_it_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], mesh: str, options: tuple, cause: str
) -> None:
    (tmp_path / "guides.obj").write_text(CROSSED)
    shape = geometry.grid(6) if mesh == "sheet" else geometry.icosphere(3)
    geometry.write_obj(tmp_path / "mesh.obj", shape)
    report = tmp_path / "report.json"
    argv = ["--input", tmp_path / "mesh.obj", "--output", tmp_path / "a.svg", "--quiet"]
    argv += ["--spacing", 0.1 if mesh == "sheet" else 0.4, "--layout", "top", "--report", report]
    argv += [tmp_path / word if word == "guides.obj" else word for word in options]
    assert batch.main([str(word) for word in argv]) == 0
    assert json.loads(report.read_text())["drawing"]["crossings"] > 0
    lines = [line for line in capsys.readouterr().err.splitlines() if "crosses itself" in line]
    (line,) = lines
    assert [word for word in ALL if word in line] == [cause]
    assert_sentence(line.removeprefix("meander: warning: "))

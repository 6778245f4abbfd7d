# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of a run that has ended: numbers that were measured, and one thing of each."""

from __future__ import annotations

from pathlib import Path

import pytest
from flows import fill
from meander import batch
from meander.model import empty, strands
from meander.model.empty import Empty

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


def _said(tmp_path: Path, mesh: str, *options: object) -> None:
    (tmp_path / "mesh.obj").write_text(mesh)
    assert fill(tmp_path / "mesh.obj", tmp_path / "out.obj", *options) == 0


def test_a_place_on_an_axis_is_said_without_what_rounding_leaves() -> None:
    found = Empty(0.2, 0.0, 0.25, (1.0, 9.3e-10, -2e-9))
    said = empty.remark(found, "converged", ("a", "b", "c"))
    assert "(1, 0, 0)" in said
    far = Empty(0.2, 0.0, 0.25, (1e-3, 0.0, 0.0))
    assert "(0.001, 0, 0)" in empty.remark(far, "converged", ("a", "b", "c"))


def test_guides_that_were_moved_are_no_seed() -> None:
    line = strands.stroke([0.0, 0.0, 1.0], [1.0, 0.0, 1.0])
    for parts, what in (
        ([strands.Part("a", line, guide=True)], "moved the guides"),
        ([strands.Part("a", line, guide=True), strands.Part("b", line)], "moved the seed"),
    ):
        assert strands.fit_remark({"seed_distance": 1.0}, parts, 0.1).startswith(what)


def test_what_may_be_done_about_small_parts_is_one_clause_each(tmp_path, capsys) -> None:
    speck = "v 1.001 0 0\nv 1.001 .001 0\nf 2 5 6\n"
    _said(tmp_path, SQUARE + speck, "--spacing", 0.1, "--iterations", 3)
    (line,) = (line for line in capsys.readouterr().out.splitlines() if " lines: " in line)
    assert line.endswith("; --smallest-part leaves out the small ones")
    assert line.count(", which ") <= 1


def test_a_spacing_that_was_not_measured_is_not_said(tmp_path, capsys) -> None:
    """A loop within which nothing has room has no strand beside it."""
    _said(tmp_path, SQUARE, "--spacing", 0.5, "--boundary-distance", 2)
    said = capsys.readouterr().out
    assert "in the median" not in said and "spacing 0.5 wanted" in said
    _said(tmp_path, SQUARE, "--spacing", 0.1)
    assert "in the median (0.1 wanted)" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--segment-length", 5), "--segment-length 5 is out of range; choose from 0.0005 to 0.05"),
        (("--max-radius", 1e-9), "--max-radius 1e-09 is out of range; choose from 0.075 to 50000"),
        (("--length-power", 1), "--length-power 1 is out of range; choose from 1.5 to 8"),
        (("--bending", 1e9), "--bending 1e+09 is out of range; choose from 0 to 1e+06"),
    ],
)
def test_what_the_library_refuses_is_said_of_the_flag(tmp_path, capsys, options, words) -> None:
    """In its unit: the library counts lengths in halves of the spacing."""
    (tmp_path / "mesh.obj").write_text(SQUARE)
    argv = ["--input", tmp_path / "mesh.obj", "--output", tmp_path / "out.obj", *options]
    assert batch.main([str(word) for word in (*argv, "--spacing", 0.1, "--quiet")]) == 2
    assert capsys.readouterr().err.splitlines()[-1] == f"meander: {words}"

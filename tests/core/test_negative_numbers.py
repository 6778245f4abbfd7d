# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers that begin with a dash are numbers, however they are written."""

from __future__ import annotations

from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.cli import arguments
from meander.cli.place import Place
from meander.cli.values import BadInput
from sentences import assert_sentence

NOWHERE = Place("batch.py", lambda _line: None)
NUMBERS = ["-1e-7", "-1E-7", "-1e+0", "-0.00001", "-.5e-1", "-1.e-3", "-0e0", "-12e-1", "-1e-300",
           "-1", "-.5", "-0"]  # fmt: skip


def parsed(*extra: str):
    given = ["--input", "a.obj", "--output", "b.obj", *extra]
    return arguments.parser(NOWHERE).parse_args(given)


@pytest.mark.parametrize("number", NUMBERS)
def test_they_are_values_of_options(number: str) -> None:
    value = float(number)
    places = parsed("--spacing", "1", "--from", number, "0", number, "--to", "0", number, "1")
    assert (places.stroke_from, places.stroke_to) == ([value, 0.0, value], [0.0, value, 1.0])


@pytest.mark.parametrize("number", ["-2e-1", "-1e-9", "-inf", "-nan", "-Infinity", "-1e999", "-5%"])
def test_what_is_refused_is_refused_as_a_number(number: str) -> None:
    with pytest.raises(BadInput) as caught:
        parsed("--spacing", number)
    assert_sentence(str(caught.value))
    assert "--spacing" in str(caught.value) and number.rstrip("%") in str(caught.value)
    assert "expected" not in str(caught.value)


def test_options_are_still_options() -> None:
    for wrong in (["--spacing", "--quiet"], ["--spacing", "-x"], ["--spacing", "1", "--quite"]):
        with pytest.raises(BadInput):
            parsed(*wrong)


def test_a_stroke_from_a_place_written_so(tmp_path: Path, capsys) -> None:
    mesh = geometry.write_obj(tmp_path / "square.obj", geometry.grid(6))
    argv = ["--input", mesh, "--output", tmp_path / "out.obj", "--spacing", "0.4"]
    argv += ["--iterations", "2", "--from", "-1e-7", "0.5", "-1e-9", "--to", "1", "0.5", "-0.0e-5"]
    assert batch.main([str(one) for one in argv]) == 0, capsys.readouterr().err
    line = np.array([
        [float(word) for word in row.split()[1:]]
        for row in (tmp_path / "out.obj").read_text().splitlines() if row.startswith("v ")
    ])
    assert len(line) >= 2

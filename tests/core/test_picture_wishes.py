# SPDX-License-Identifier: GPL-3.0-or-later
"""What draw_picture says of wishes that cannot be, in one sentence each."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from conftest import of_python_package
from meander.core import MeanderError
from meander.model.files.whole import FileError

RAMP = np.tile(np.linspace(0.0, 1.0, 60), (45, 1))
NAN = float("nan")


@pytest.fixture(scope="module")
def pictures():
    return of_python_package("pictures")


@pytest.mark.parametrize(
    ("wish", "said"),
    [
        ({"width": "x"}, "width 'x' is not a number"),
        ({"pen": None}, "pen None is not a number"),
        ({"width": NAN}, "width nan is not greater than 0"),
        ({"spread": -1.5}, "spread -1.5 is out of range; choose 0 or more"),
        ({"spread": NAN}, "spread nan is out of range"),
        ({"leave_white": 2}, "leave_white 2 is out of range; choose from 0 to 1"),
        ({"leave_white": NAN}, "leave_white nan is out of range"),
        ({"local_contrast": -5}, "local_contrast -5 is out of range; choose from 0 to 5"),
        ({"sharpen": "x"}, "sharpen 'x' is not a number"),
        ({"darkest": "x"}, "darkest 'x' is not a number"),
        ({"lightest": 0.95}, "lightest and darkest are not in order"),
        ({"levels": (80, 20)}, r"levels \(80, 20\) are not two numbers from 0 to 100"),
        ({"levels": (50, 50)}, "the darker one first"),
        ({"levels": 5}, "levels 5 are not two numbers"),
        ({"paper": "0.5:0.6"}, "paper '0.5:0.6' is no list of pairs"),
        ({"paper": (0.5,)}, "is no list of pairs"),
        ({"paper": ((0.5, 0.2), (0.4, 0.9))}, "paper: both numbers have to rise"),
        ({"inks": "cyan"}, "inks 'cyan' is no list of names"),
        ({"inks": ("rosa",)}, "there is no ink called rosa"),
        ({"threads": "x"}, "threads 'x' is not a number"),
        ({"threads": None}, "threads None is not a number"),
    ],
)
def test_a_wish_that_cannot_be_is_a_sentence(pictures, wish, said):
    with pytest.raises(MeanderError, match=said):
        pictures.draw_picture(RAMP, **({"width": 40.0, "pen": 1.5} | wish))


@pytest.mark.parametrize(
    ("picture", "said"),
    [
        (Path("no.png"), "no.png does not exist; check the path"),
        (".", "is a folder; name a file in it"),
        ((255 * RAMP).astype(int), "int64 .* give them as uint8 or uint16"),
    ],
)
def test_what_is_no_picture_is_a_sentence(pictures, picture, said):
    pytest.importorskip("PIL")
    with pytest.raises(FileError, match=said):
        pictures.draw_picture(picture, 40.0, 1.5)


@pytest.mark.parametrize("margin", [-5, NAN, "a"])
def test_a_margin_that_cannot_be_is_a_sentence(pictures, tmp_path, margin):
    drawing = pictures.draw_picture(RAMP, 40.0, 3.0)
    with pytest.raises(MeanderError, match="margin"):
        drawing.write(tmp_path / "a.svg", margin=margin)
    assert not list(tmp_path.iterdir())
    with pytest.raises(MeanderError, match="size"):
        drawing.preview(margin)

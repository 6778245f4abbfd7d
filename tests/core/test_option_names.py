# SPDX-License-Identifier: GPL-3.0-or-later
"""A name that is no option is refused with the nearest one: it would do nothing, without a word."""

from __future__ import annotations

import copy
import dataclasses
import pickle

import geometry
import numpy as np
import pytest
from meander import core
from sentences import assert_sentence

SEED = core.Seed(np.zeros((2, 3)), np.array([0, 2]), np.zeros(1, dtype=np.uint8))
# What was meant, and what was written.
MISSPELT = [
    (core.default_options(), "bending_weight", "bending_wieght"),
    (core.default_options(), "radius", "raduis"),
    (core.default_options(), "radius", "Radius"),
    (core.default_options("finest"), "threads", "thread"),
    (core.default_options("paper"), "max_radius", "maxradius"),
    (core.default_options(), "tunings", "tuning"),
    (core.SurfaceOptions(), "merge_distance", "merge_distence"),
    (core.SurfaceOptions(), "make_manifold", "makeManifold"),
    (core.SurfaceOptions(), "face_mask", "facemask"),
    (core.SurfaceOptions(), "weld_distance", "weld-distance"),
    (SEED, "closed", "close"),
    (SEED, "max_distance", "maximum_distance"),
    (SEED, "guides", "guide"),
]


@pytest.mark.parametrize(("options", "meant", "written"), MISSPELT)
def test_the_nearest_name_is_told(options, meant: str, written: str) -> None:
    for attempt in (
        lambda: setattr(options, written, 1.0),
        lambda: dataclasses.replace(options, **{written: 1.0}),
        lambda: type(options)(**{written: 1.0}),
    ):
        with pytest.raises(core.MeanderError) as caught:
            attempt()
        assert_sentence(str(caught.value))
        assert written in str(caught.value)
        assert f"did you mean {meant}?" in str(caught.value)
    assert not hasattr(options, written)


def test_what_is_like_none_is_told_all() -> None:
    with pytest.raises(core.MeanderError) as caught:
        core.SurfaceOptions(xyzzy=3)
    assert_sentence(str(caught.value))
    assert all(name.name in str(caught.value) for name in dataclasses.fields(core.SurfaceOptions))


@pytest.mark.parametrize("options", [core.default_options(), core.SurfaceOptions(), SEED])
def test_all_names_are_taken_and_kept(options) -> None:
    for made in (
        dataclasses.replace(options),
        copy.copy(options),
        copy.deepcopy(options),
        pickle.loads(pickle.dumps(options)),
    ):
        for field in dataclasses.fields(options):
            setattr(made, field.name, getattr(options, field.name))
        assert repr(made) == repr(options)


def test_there_are_no_other_classes_of_options() -> None:
    """What is given to the library as a dataclass that can be changed."""
    changeable = {
        name
        for name in core.__all__
        if dataclasses.is_dataclass(getattr(core, name))
        and not getattr(core, name).__dataclass_params__.frozen
    }
    assert changeable == {"FlowOptions", "Seed", "SurfaceOptions"}


def test_what_is_no_options_is_a_sentence() -> None:
    square = geometry.grid(2)
    surface, options = core.Surface(*square), core.default_options()
    for made, words in (
        (lambda: core.Surface(*square, {"merge_distance": 0.1}), "SurfaceOptions, not a dict"),
        (lambda: core.Flow(surface, {"radius": 0.1}), "FlowOptions, not a dict"),
        (lambda: core.Flow(surface, None), "FlowOptions, not a NoneType"),
        (lambda: core.Flow(surface, options, np.zeros((2, 3))), "Seed, not a ndarray"),
        (lambda: core.option_warnings({"radius": 0.1}), "FlowOptions, not a dict"),
    ):
        with pytest.raises(core.MeanderError) as caught:
            made()
        assert_sentence(str(caught.value))
        assert words in str(caught.value)

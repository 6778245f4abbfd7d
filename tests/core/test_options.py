# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of options: it fits the library, the command line and the documents."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import fields
from enum import IntEnum
from types import SimpleNamespace

import geometry
import numpy as np
import pytest
from conftest import REPOSITORY
from flows import fill, options_of
from meander import core
from meander.cli.arguments import parser
from meander.cli.flags import flow_options
from meander.cli.place import Place
from meander.jobs import options as items
from meander.jobs.job_file import JobError
from meander.model.options.export import ROWS
from meander.model.options.option import OF_PRESET, Option, apply, chosen, store
from meander.model.options.table import BY_SETTING, OF_THE_FLOW, TABLE
from meander.model.problem import Problem, begin_along_directions

PARSER = parser(Place("test", print))

# Fields of the flow's options that no user sets by themselves: the spacing sets the radius, a
# source of directions the weight of the alignment, and the rest is what a preset is.
OF_THE_PRESET = {
    "radius",
    "max_radius_factor",
    "grow_into_empty",
    "widen_loops",
    "hold_ends",
    "alignment_weight",
    "medial_weight",
    "step",
    "polish",
    "stop_rule",
    "polish_bending_weight",
    "boundary_rule",
    "hairpin_removal_iterations",
    "tunings",
}


def names(options: tuple[Option, ...]) -> list[str]:
    return [option.setting for option in options]


def settings_of_defaults() -> SimpleNamespace:
    """The settings of an object that nobody has touched."""
    return SimpleNamespace(
        **{
            option.setting: option.default.upper() if option.kind is str else option.default
            for option in TABLE
        }
    )


def test_every_field_of_the_flow_is_a_row_or_of_the_preset() -> None:
    offered = [option.field for option in OF_THE_FLOW]
    assert len(set(offered)) == len(offered)
    known = {field.name for field in fields(core.FlowOptions)}
    assert set(offered) | OF_THE_PRESET == known
    assert not set(offered) & OF_THE_PRESET
    assert {option.follows for option in TABLE if option.follows} <= known


def test_names_are_there_once() -> None:
    assert len(BY_SETTING) == len(TABLE)
    flags = [option.flag.name for option in (*TABLE, *ROWS) if option.flag]
    assert len(set(flags)) == len(flags)
    assert {option.switch for option in TABLE} - {""} <= set(BY_SETTING)


@pytest.mark.parametrize("option", (*TABLE, *ROWS), ids=names((*TABLE, *ROWS)))
def test_labels_and_tips_follow_the_guidelines(option: Option) -> None:
    assert option.label == option.label.title()
    assert option.tip and not option.tip.endswith(".")
    for _name, label, tip in option.choices:
        assert label == label.title() and not tip.endswith(".")
    assert not option.numbers or len(set(option.numbers)) == len(option.choices)


def test_numbers_say_what_low_and_high_do() -> None:
    for option in TABLE:
        is_number = option.kind in (int, float)
        assert bool(option.low) == bool(option.high) == is_number, option.setting


@pytest.mark.parametrize("option", OF_THE_FLOW, ids=names(OF_THE_FLOW))
def test_defaults_are_the_librarys(option: Option) -> None:
    if option.zero_is_preset:
        assert option.default == 0
        return
    if option.default == OF_PRESET:
        return
    default = getattr(core.default_options("even"), option.field)
    assert option.default == (default.name.lower() if isinstance(default, IntEnum) else default)


@pytest.mark.parametrize("preset", core.PRESETS)
def test_settings_that_nobody_touched_leave_the_preset_alone(preset: str) -> None:
    settings = settings_of_defaults()
    settings.preset = preset.upper()
    options = options_of(preset, radius=0.5)
    apply(OF_THE_FLOW, chosen(OF_THE_FLOW, settings), options)
    before = options_of(preset, radius=0.5)
    assert options == before


def test_what_is_chosen_reaches_the_flow() -> None:
    options = options_of(radius=0.5)
    before = core.default_options("even")
    values = {
        "length_weight": 1.0,
        "bending_weight": 2.0,
        "length_power": 3.0,
        "medial_power": 4.0,
        "segment_share": 0.3,
        "reach": 5.0,
        "start_spacing_factor": 6.0,
        "border_distance": 1.5,
        "medial_axis": "geodesic",
        "iteration_limit": 7,
    }
    apply(OF_THE_FLOW, values, options)
    assert (options.length_weight, options.bending_weight) == (1.0, 2.0)
    assert options.polish_bending_weight == 2.0 * before.polish_bending_weight
    assert (options.length_power, options.medial_power) == (3.0, 4.0)
    assert (options.segment_length, options.max_radius) == (0.15, 2.5)
    assert (options.start_spacing_factor, options.boundary_distance) == (6.0, 1.5)
    assert options.medial_axis == core.MedialAxis.GEODESIC
    assert options.iteration_limit == 7


@pytest.mark.parametrize(
    ("preset", "flag", "word", "chosen"),
    [
        ("even", "--medial-axis", None, core.MedialAxis.GEODESIC),
        ("finest", "--medial-axis", "preset", core.MedialAxis.GEODESIC),
        ("paper", "--medial-axis", None, core.MedialAxis.EUCLIDEAN),
        ("paper", "--medial-axis", "geodesic", core.MedialAxis.GEODESIC),
        ("even", "--medial-axis", "surface", core.MedialAxis.GEODESIC),
        ("finest", "--medial-axis", "euclidean", core.MedialAxis.EUCLIDEAN),
        ("even", "--start", None, core.Start.GROW),
        ("even", "--start", "full", core.Start.FULL),
        ("finest", "--start", None, core.Start.FULL),
        ("finest", "--start", "preset", core.Start.FULL),
        ("finest", "--start", "grow", core.Start.GROW),
        ("paper", "--start", None, core.Start.GROW),
    ],
)
def test_a_choice_is_the_presets_or_as_the_flag_says(
    preset: str, flag: str, word: str | None, chosen: core.MedialAxis | core.Start
) -> None:
    given = ["--input", "a.obj", "--output", "b.obj", "--spacing", "1", "--preset", preset]
    arguments = PARSER.parse_args(given + ([flag, word] if word else []))
    name = flag.removeprefix("--").replace("-", "_")
    assert getattr(flow_options(arguments), name) == chosen


@pytest.mark.parametrize(
    ("preset", "weight", "guides", "wide", "start"),
    [
        ("even", 1.0, None, 1.0, "FULL"),
        ("even", 1.0, [1], 1.0, "FULL"),
        ("even", 1.0, [0], 1.0, "GROW"),
        ("even", 1.0, None, 2.0, "GROW"),
        ("even", 0.0, None, 1.0, "GROW"),
        ("paper", 1.0, None, 1.0, "GROW"),
    ],
)
def test_a_direction_starts_full_where_nothing_drawn_grows(
    preset: str, weight: float, guides: list[int] | None, wide: float, start: str
) -> None:
    options = options_of(preset, alignment_weight=weight, start_spacing_factor=wide)
    line = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    seed = None
    if guides is not None:
        seed = core.Seed(line, np.array([0, 2]), np.array([0]), guides=np.array(guides))
    problem = Problem(line, np.zeros((0, 3)), options, seed, directions=line)
    begin_along_directions(problem)
    assert options.start == core.Start[start]


def test_how_gently_hairpins_are_removed_is_the_presets() -> None:
    presets = {name: core.default_options(name) for name in core.PRESETS}
    gentleness = {
        name: options.tunings["hairpin_removal_gentleness"] for name, options in presets.items()
    }
    assert gentleness == {"even": 0.0, "paper": 0.0, "finest": 1.0}


def test_settings_give_back_what_was_stored() -> None:
    settings = settings_of_defaults()
    untouched = chosen(TABLE, settings)
    values = {"length_weight": 0.3, "reach": 4.5, "preset": "paper", "use_outline": True}
    store(TABLE, values, settings)
    assert settings.use_weights
    found = chosen(TABLE, settings)
    assert {name: found[name] for name in values} == values
    store(TABLE, {name: untouched[name] for name in values}, settings)
    assert not settings.use_weights
    assert chosen(TABLE, settings) == untouched


@pytest.mark.parametrize(
    ("option", "value"),
    [
        pytest.param(option, value, id=f"{option.setting}-{value}")
        for option in OF_THE_FLOW
        if option.kind in (int, float)
        for value in {option.least, option.greatest, option.soft_greatest, option.least_used}
        if value is not None and value >= option.least and (value or not option.zero_is_preset)
    ],
)
def test_the_library_takes_what_the_settings_allow(option: Option, value: float) -> None:
    options = options_of(radius=0.2)
    settings = settings_of_defaults()
    setattr(settings, option.setting, value)
    if option.switch:
        setattr(settings, option.switch, True)
    apply(OF_THE_FLOW, chosen(OF_THE_FLOW, settings), options)
    vertices, faces = geometry.icosphere(2)
    with core.Surface(vertices, faces) as surface, core.Flow(surface, options) as flow:
        assert flow.statistics()["nodes"] > 0


def test_every_flag_is_that_of_the_command(capsys: pytest.CaptureFixture) -> None:
    with pytest.raises(SystemExit):
        PARSER.parse_args(["--help"])
    text = " ".join(capsys.readouterr().out.split())
    for option in TABLE:
        if option.flag is not None:
            assert f"{option.flag.name} " in text
    given = PARSER.parse_args(["--input", "a.obj", "--output", "b.obj", "--spacing", "1"])
    for option in TABLE:
        if option.flag is not None and option.kind is not bool and option.setting != "spacing":
            assert getattr(given, option.flag.destination) == option.flag.default


@pytest.mark.parametrize(
    ("former", "name", "value"),
    [("border-distance", "boundary-distance", "1.25"), ("preset", "quality", "finest")],
)
def test_former_names_of_flags_are_read_and_not_shown(
    former: str, name: str, value: str, capsys: pytest.CaptureFixture
) -> None:
    needed = ["--input", "a.obj", "--output", "b.obj", "--spacing", "1"]
    given = PARSER.parse_args([*needed, f"--{former}", value])
    assert given == PARSER.parse_args([*needed, f"--{name}", value])
    assert given != PARSER.parse_args(needed)
    # In files of jobs too, where both together are one too many.
    assert items.check_keys("here", {former: value}) == {name: value}
    assert items.check_keys("here", {former.replace("-", "_"): value}) == {name: value}
    with pytest.raises(JobError, match="twice"):
        items.check_keys("here", {former: value, name: value})
    with pytest.raises(SystemExit):
        PARSER.parse_args(["--help"])
    assert f"--{former}" not in capsys.readouterr().out


def test_the_panel_and_flags_have_one_word_for_one_thing() -> None:
    """Boundary, as in the field, in Blender and in the library; how far strands see is Sight."""
    for option in (*TABLE, *ROWS):
        told = [option.label, option.row, option.tip, option.low, option.high]
        told += [text for choice in option.choices for text in choice[1:]]
        told += [option.flag.name, option.flag.help] if option.flag else []
        words = " ".join(told).lower()
        assert "border" not in words and "reach" not in words, option.setting


def test_the_table_in_the_documents_is_current() -> None:
    command = [sys.executable, REPOSITORY / "scripts/write_option_table.py", "--check"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("flag", "value", "word"),
    [
        ("--boundary-distance", "2.5", "from 0 to 2"),
        ("--mask-threshold", "-0.1", "from 0 to 1"),
        ("--threads", "257", "from 0 to 256"),
        ("--iterations", "0", "from 1 to 2147483647"),
        ("--iterations", "2.5", "whole number"),
        ("--merge-distance", "-1", "less than 0"),
        ("--segment-length", "0", "greater than 0"),
        ("--length", "inf", "finite"),
    ],
)
def test_a_value_out_of_range_names_the_range(
    flag: str, value: str, word: str, tmp_path, capsys: pytest.CaptureFixture
) -> None:
    path = tmp_path / "any.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert fill(path, tmp_path / "out.obj", "--spacing", "0.2", flag, value) == 2
    error = capsys.readouterr().err
    assert flag in error and word in error

# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command as Blender's own: `blender --command meander`, from 4.2 on.

The bpy module ignores --command, so what Blender would call is called here.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import bpy
import pytest
from meander.headless import command
from scenes import sphere

HAS_COMMANDS = hasattr(bpy.utils, "register_cli_command")


@pytest.fixture
def registered(monkeypatch: pytest.MonkeyPatch) -> Callable[[Sequence[str]], int]:
    """What Blender is given to call, by way of Blender's own registration where it has one."""
    given: list[tuple[str, Callable[[Sequence[str]], int]]] = []
    taken: list[object] = []
    real = getattr(bpy.utils, "register_cli_command", lambda name, execute: name)
    real_back = getattr(bpy.utils, "unregister_cli_command", lambda handle: None)

    def register(name: str, execute: Callable[[Sequence[str]], int]) -> object:
        given.append((name, execute))
        return real(name, execute)

    def unregister(handle: object) -> None:
        taken.append(handle)
        real_back(handle)

    command.unregister()
    with monkeypatch.context() as patch:
        patch.setattr(bpy.utils, "register_cli_command", register, raising=False)
        patch.setattr(bpy.utils, "unregister_cli_command", unregister, raising=False)
        command.register()
        ((name, execute),) = given
        assert name.isidentifier() and name == "meander"  # what Blender asks of a name
        yield execute
        command.unregister()
        assert len(taken) == 1
        command.unregister()
        assert len(taken) == 1, "taken out twice"
    command.register()


def test_it_is_there_from_4_2_on() -> None:
    assert HAS_COMMANDS == (bpy.app.version >= (4, 2, 0))
    assert len(command._registered) == int(HAS_COMMANDS)


def test_it_fills_an_object_of_a_scene(registered, tmp_path: Path, capsys) -> None:
    ball = sphere()
    ball.name = "Ball"
    scene, report = tmp_path / "scene.blend", tmp_path / "report.json"
    bpy.ops.wm.save_as_mainfile(filepath=str(scene))
    given = ["--input", str(scene), "--object", "Ball", "--spacing", "0.4"]
    given += ["--output", str(tmp_path / "out.blend"), "--report", str(report)]
    assert registered(given) == 0
    assert "wrote" in capsys.readouterr().out
    assert json.loads(report.read_text())["crossings"] == 0
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert "Ball Meander" in bpy.data.objects


def test_its_errors_and_exit_codes_are_those_of_the_batch_command(
    registered, tmp_path: Path, capsys
) -> None:
    output = tmp_path / "out.obj"
    given = ["--input", str(tmp_path / "missing.blend"), "--spacing", "1", "--output", str(output)]
    assert registered(given) == 2
    assert "missing.blend does not exist" in capsys.readouterr().err
    assert not output.exists()


def test_its_help_says_how_it_is_called(registered, capsys) -> None:
    assert registered(["--help"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "usage: blender --command meander" in text
    assert "need Blender" not in text

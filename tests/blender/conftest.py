# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests inside Blender share: an empty scene, small surfaces, seeds, and yardsticks."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import bpy
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, os.environ.get("MEANDER_ADDON_PARENT", str(ROOT / "addon")))
sys.path.insert(0, str(Path(__file__).parent))
sys.path += [str(ROOT / "tests"), str(ROOT / "tests" / "core")]

import calls  # noqa: E402
import meander  # noqa: E402
from processor_time import pytest_runtest_protocol  # noqa: E402, F401

# MEANDER_NOTE_CALLS names a file for the functions that each test calls; where MEANDER_ENOUGH_OF
# names such a file, no more of the tests in it run than call every function.
NOTES = os.environ.get("MEANDER_NOTE_CALLS")
NOTED = os.environ.get("MEANDER_ENOUGH_OF")
noted: dict[str, list[str]] = {}


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    if not NOTES:
        yield
        return
    with calls.called() as seen:
        outcome = yield
    if outcome.excinfo is None:
        noted[item.nodeid] = calls.of_blender(seen, Path(meander.__file__).parent, item.nodeid)


def pytest_sessionfinish() -> None:
    if NOTES:
        calls.write(Path(NOTES), noted)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if not NOTED:
        return
    known = calls.read(Path(NOTED))
    here = {item.nodeid for item in items}
    spared = known.keys() - calls.enough({test: known[test] for test in known if test in here})
    config.hook.pytest_deselected(items=[item for item in items if item.nodeid in spared])
    items[:] = [item for item in items if item.nodeid not in spared]


def pytest_sessionstart(session: pytest.Session) -> None:
    meander.register()


def pytest_unconfigure(config: pytest.Config) -> None:
    # What is still registered when the interpreter ends crashes bpy 4.5.
    if hasattr(bpy.types.Object, "meander"):
        meander.unregister()


@pytest.fixture(autouse=True)
def empty_scene() -> Iterator[None]:
    """An empty file before every test; nothing of ours still going after it."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    yield
    from meander.run import session

    assert session.current() is None


@pytest.fixture
def windowed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lets a run be watched in background: by watched_runs.begin() and tick_until()."""
    from meander.run import session
    from watched_runs import FakeWindow

    monkeypatch.setattr(session, "Window", FakeWindow)


@pytest.fixture
def nothing_kept() -> Iterator[None]:
    """Ends the run of a test, and drops what runs leave to go on from."""
    from meander.run import lasting

    yield
    lasting.end_all()


@pytest.fixture
def run_command(tmp_path: Path, capsys: pytest.CaptureFixture) -> Callable:
    """Saves the scene and runs the batch command on its object: exit code, standard error, and
    where it does not refuse, curve and report.
    """
    from meander import batch
    from meander.model.files import obj

    def call(*extra: str) -> tuple:
        scene, output, record = (tmp_path / name for name in ("scene.blend", "out.obj", "out.json"))
        bpy.ops.wm.save_as_mainfile(filepath=str(scene))
        given = ["--input", scene, "--output", output, "--report", record, "--spacing", "0.15"]
        code = batch.main([str(a) for a in (*given, "--iterations", "150", "--quiet", *extra)])
        errors = capsys.readouterr().err
        if code:
            assert not output.exists()
            return code, errors, None, None
        return code, errors, obj.read_obj_curve(output), json.loads(record.read_text())

    return call


@pytest.fixture
def run_batch(capsys: pytest.CaptureFixture) -> Callable[..., subprocess.CompletedProcess]:
    """Runs the batch command here, which takes a tenth of the time of a Blender of its own."""
    from meander.headless import command

    def run(*arguments: object) -> subprocess.CompletedProcess:
        capsys.readouterr()
        code = command.main([str(argument) for argument in arguments])
        return subprocess.CompletedProcess(arguments, code, *capsys.readouterr())

    return run

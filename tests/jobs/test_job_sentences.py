# SPDX-License-Identifier: GPL-3.0-or-later
"""Every sentence of the table that jobs have comes up: what it is said of is tried here."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Job
from meander.jobs import child, command, engine, folder, job_file, objects
from meander.jobs.items import items_of
from meander.jobs.job_file import JobError
from said_sentences import OF_JOBS, missing, sentences
from sentences import assert_sentence
from test_job_files import ITEM, MISTAKES, SPACING, Listed

SCENE = SPACING + '[[items]]\ninput = "shot.blend"\n'


@pytest.fixture
def said(job: Job, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    job.meshes(a="ok", b="ok")
    (job.folder / "shot.blend").write_text("")
    found = []

    def run(text: str, *arguments: str) -> None:
        job.write(text, fake=False)
        assert command.main([str(job.file), *arguments]) in (1, 2)
        found.append(capsys.readouterr().err.strip())

    def refused(call: Callable[[], object]) -> None:
        with pytest.raises(JobError) as refusal:
            call()
        found.append(str(refusal.value))

    def item_of(text: str) -> tuple:
        job.write(text, fake=False)
        read = job_file.read(job.file)
        return read, items_of(read, Listed())[0]

    for text, _word in MISTAKES.values():
        run(text)
    run(SPACING + ITEM + "name = 'a\\b'\n")
    run(SPACING + ITEM, "--shard", "5/4")
    run(SPACING + ITEM, "--status", "--summary", str(job.file))
    run(SPACING + ITEM, "--summary", "nowhere/a.json")
    run(SPACING + ITEM, "--summary", "/")
    run(SPACING + ITEM + 'output = "summary.json"\nresample-step = 0.1\n')
    run(SPACING + ITEM, "--shard", "1/4", "--slurm", "4")
    run(SPACING + '[[items]]\ninput = "gone.blend"\nobject = "*"\n')
    run("[job]\nblender = \"no-such-blender\"\n" + SCENE + 'object = "*"\n')
    run('[job]\nblender = "false"\n' + SCENE + 'object = "*"\n')
    refused(lambda: items_of(item_of(SCENE + 'object = "Stone*"\n')[0], Listed()))
    refused(lambda: job_file.read(job.folder / "none.toml"))
    with monkeypatch.context() as patch:
        gone = job.folder / "gone"
        gone.mkdir()
        patch.chdir(gone)
        gone.rmdir()
        refused(lambda: job_file.read(Path("job.toml")))
    job.file.write_bytes(b"# \xff\xfd\xf6\n")
    refused(lambda: job_file.read(job.file))
    with monkeypatch.context() as patch:
        patch.setitem(sys.modules, "tomllib", None)
        refused(lambda: job_file.read(job.file))
    with monkeypatch.context() as patch:  # the Python package, which has no scripts of Blender's
        patch.setattr(objects, "_SCRIPT", job.folder / "none.py")
        refused(lambda: objects.Meshes(["blender"], None).of(job.folder / "shot.blend"))
        patch.setattr(engine, "_BATCH", job.folder / "none.py")
        refused(lambda: engine.command_of(*item_of(SCENE), 1))
        patch.setattr(engine, "_python_of", lambda _job: "")
        refused(lambda: engine.command_of(*item_of('[job]\nengine = "python"\n' + SPACING + ITEM),
                                          1))  # fmt: skip
    (job.folder / "job").write_text("in the way")
    read, item = item_of(SPACING + ITEM)
    refused(lambda: folder.Folder(read.folder).make([item]))
    (job.folder / "job").unlink()

    def unlocked(_handle: int) -> None:
        raise OSError(38, "Function not implemented")

    with monkeypatch.context() as patch:
        patch.setattr(folder, "_lock", unlocked)
        refused(lambda: folder._claim(job.folder / "lock", needed=True))
    found += verdicts(job.folder)
    return found


def verdicts(place: Path) -> list[str]:
    """What is said of processes that cannot start, take too long, need too much, and crash."""
    found = []
    with pytest.raises(JobError) as refusal:
        started(place, ["/no/such/program"])
    found.append(str(refusal.value))
    for code, limits in (
        ("import time; time.sleep(60)", {"timeout": 0.05}),
        ("import os; os.kill(os.getpid(), 9)", {}),
        ("print('MemoryError'); raise SystemExit(1)", {"memory": 4000.0}),
        ("raise SystemExit(3)", {}),
    ):
        running = started(place, [sys.executable, "-c", code], **limits)
        end = time.monotonic() + 30.0
        while (ended := running.ended()) is None:
            assert time.monotonic() < end
            time.sleep(0.02)
        found.append(running.verdict(ended, place / "log"))
    return found


def started(place: Path, line: list[str], **limits: float) -> child.Child:
    given = {"timeout": None, "memory": None, "kept_open": None} | limits
    return child.Child(line, place, place / "log", {}, **given)


def test_every_sentence_comes_up(said: list[str]) -> None:
    assert missing(OF_JOBS, said, {}) == []
    assert len(sentences(OF_JOBS)) > 40
    for sentence in said:
        assert "Traceback" not in sentence
        assert_sentence(sentence.removeprefix("meander: "))

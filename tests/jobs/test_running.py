# SPDX-License-Identifier: GPL-3.0-or-later
"""A job is run: what fails stops nothing, what is done stays done, two at once do no harm."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from meander.jobs import command
from sentences import assert_sentence


def sentence_of(job, name: str) -> str:
    """Why an item failed, as it is said at the end."""
    (found,) = (item for item in job.summary()["results"] if item["name"] == name)
    assert found["state"] == "failed"
    assert_sentence(found["sentence"])
    return found["sentence"]


def hidden(job) -> list[Path]:
    """Temporary files that somebody has left."""
    return [path for path in job.folder.rglob("*") if path.name.startswith(".")]


def until(true: Callable[[], bool], seconds: float = 20) -> None:
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end, "it never came to that"
        time.sleep(0.02)


def is_alive(number: int) -> bool:
    try:
        # A zombie has ended as well.
        return Path(f"/proc/{number}/stat").read_text().split(") ")[1][0] != "Z"
    except FileNotFoundError:
        return False


def test_what_fails_stops_nothing_and_is_named(job):
    job.meshes(
        a="ok curve", b="refuse the mesh has no faces; choose another", c="crash", d="hang",
        e="eat", f="forget", g="ok curve",
    )  # fmt: skip
    job.fill_all(timeout=3, memory=500)
    done = job.run("--jobs", "3")
    assert done.returncode == 1, done.stderr
    assert done.stdout == ""
    for name in "ag":
        assert (job.results / f"{name}.obj").read_text() == "curve"
        assert f"ok {name}" in (job.results / f"{name}.log").read_text()
    assert sentence_of(job, "b") == "the mesh has no faces; choose another"
    assert "SIGKILL" in sentence_of(job, "c")
    assert "time limit of 3 s" in sentence_of(job, "d")
    assert "more than 500 MB" in sentence_of(job, "e")
    assert "MemoryError" in (job.results / "e.log").read_text()
    assert "has not written" in sentence_of(job, "f")
    last = done.stderr.splitlines()[-6:]
    assert {line.split(":")[2].strip() for line in last[:5]} == set("bcdef")
    assert last[5].startswith("meander: 2 of 7 items done, 5 failed, 0 left")
    summary = job.summary()
    assert (summary["items"], summary["done"], summary["failed"]) == (7, 2, 5)
    assert not hidden(job)
    # What hung has taken its own child along.
    child = int((job.results / "d.obj.child").read_text())
    until(lambda: not is_alive(child))


def test_what_is_done_is_not_done_again(job):
    job.meshes(a="ok curve", b="refuse to begin; try again", c="ok curve")
    job.fill_all()
    assert job.run().returncode == 1
    assert job.runs == ["a", "b", "c"]
    assert job.run().returncode == 1
    assert job.runs == ["a", "b", "b", "c"]
    # Other bytes, the same time: the bytes count.
    path = job.folder / "meshes" / "a.obj"
    times = path.stat()
    path.write_text("ok other")
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    job.meshes(b="ok now")
    assert job.run().returncode == 0
    assert job.runs == ["a", "a", "b", "b", "b", "c"]
    assert (job.results / "a.obj").read_text() == "other"
    # An output that is gone or cut short is made again.
    (job.results / "a.obj").unlink()
    (job.results / "c.obj").write_text("cu")
    assert job.run().returncode == 0
    assert job.runs == ["a", "a", "a", "b", "b", "b", "c", "c"]
    assert (job.results / "c.obj").read_text() == "curve"
    # Other limits change no curve, other options do.
    job.fill_all(timeout=50, threads=2)
    assert job.run().returncode == 0
    assert len(job.runs) == 8
    job.fill_all(bending=2)
    assert job.run("--quiet").stderr == ""
    assert len(job.runs) == 11
    assert job.run("--again").returncode == 0
    assert len(job.runs) == 14


def test_the_state_of_a_job(job):
    job.meshes(a="ok", b="refuse it; see", c="ok")
    job.fill_all()
    assert job.run("--shard", "1/2").returncode == 0
    assert job.run("--shard", "2/2").returncode == 1
    (job.results / "c.obj").unlink()
    done = job.run("--list")
    assert (done.returncode, done.stderr) == (0, "")
    assert [line.split()[0] for line in done.stdout.splitlines()] == ["done", "failed", "left"]
    done = job.run("--status", "--summary", str(job.folder / "all.json"))
    assert done.returncode == 1
    assert done.stderr.splitlines()[0] == "meander: failed: b: it; see"
    assert "1 of 3 items done, 1 failed, 1 left" in done.stderr
    assert json.loads((job.folder / "all.json").read_text())["left"] == 1
    assert job.runs == ["a", "b", "c"]
    assert job.summary("summary-1-of-2.json")["shard"] == "1/2"


def test_two_processes_share_a_job(job):
    names = [f"m{number:02}" for number in range(12)]
    job.meshes(**dict.fromkeys(names, "slow 0.15 curve"))
    job.fill_all()
    both = [job.start("--jobs", "2"), job.start("--jobs", "2")]
    for process in both:
        _out, err = process.communicate(timeout=60)
        assert process.returncode == 0, err
        assert "12 of 12 items done" in err
    assert job.runs == names  # each once
    assert all((job.results / f"{name}.obj").read_text() == "curve" for name in names)


def test_two_shards_at_once_do_all_of_it(job):
    names = [f"m{number}" for number in range(7)]
    job.meshes(**dict.fromkeys(names, "slow 0.05 curve"))
    job.fill_all()
    both = [job.start("--shard", f"{number}/2") for number in (1, 2)]
    for process in both:
        _out, err = process.communicate(timeout=60)
        assert process.returncode == 0, err
    assert job.runs == names
    assert job.run("--status").returncode == 0


def test_an_interruption_ends_the_children_and_is_gone_on_from(job):
    job.meshes(a="ok curve", b="hang", c="ok curve")
    job.fill_all()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        process = job.start()
        marker = job.results / "b.obj.child"
        until(lambda marker=marker: marker.exists() and marker.read_text() != "")
        process.send_signal(number)
        _out, err = process.communicate(timeout=20)
        assert process.returncode == 130
        assert err.splitlines()[-1].startswith("meander: interrupted: 1 of 3 items done, 0 failed")
        child = int(marker.read_text())
        until(lambda child=child: not is_alive(child))
        assert not hidden(job)
        assert job.summary()["interrupted"] is True
        marker.unlink()
    job.meshes(b="ok curve")
    assert job.run().returncode == 0
    assert job.runs == ["a", "b", "b", "b", "b", "c"]


def test_what_is_ignored_stays_ignored(job):
    """As nohup asks for, so that closing the terminal ends nothing."""
    job.meshes(a="slow 1 curve")
    job.fill_all()
    process = subprocess.Popen(["nohup", *job.command()], env=job.environment,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until(lambda: job.runs == ["a"])
    process.send_signal(signal.SIGHUP)
    assert process.wait(timeout=20) == 0
    assert job.run("--status").returncode == 0


def test_a_killed_process_is_gone_on_from(job):
    """Nobody is left to end the item that hangs, but the next process."""
    job.meshes(a="ok curve", b="hang", c="ok curve")
    job.fill_all()
    process = job.start()
    marker = job.results / "b.obj.child"
    until(lambda: marker.exists() and marker.read_text() != "")
    process.kill()
    process.communicate()
    child = int(marker.read_text())
    assert is_alive(child)
    job.meshes(b="ok curve")
    second = job.start()
    _out, err = second.communicate(timeout=30)
    assert second.returncode == 0, err
    assert "waiting for 1 item" in err
    assert job.runs == ["a", "b", "b", "c"]
    until(lambda: not is_alive(child))


def test_a_process_waits_for_what_another_is_at(job):
    job.meshes(a="slow 1.5 curve")
    job.fill_all()
    first = job.start()
    until(lambda: job.runs == ["a"])
    second = job.run()
    assert second.returncode == 0
    assert "1 of 1 item done" in second.stderr
    first.communicate(timeout=20)
    assert first.returncode == 0
    assert job.runs == ["a"]


def test_what_fails_elsewhere_meanwhile_is_not_tried_twice(job):
    job.meshes(a="slow 0.8 curve", b="refuse it; see", c="slow 0.8 curve")
    job.fill_all()
    both = [job.start(), job.start()]
    for process in both:
        _out, err = process.communicate(timeout=30)
        assert process.returncode == 1
        assert "failed: b: it; see" in err
    assert job.runs == ["a", "b", "c"]


def test_an_input_that_goes_away_is_an_item_that_fails(job):
    job.meshes(a="slow 0.8 curve", b="ok curve", c="ok curve")
    job.fill_all()
    process = job.start()
    until(lambda: job.runs == ["a"])
    (job.folder / "meshes" / "b.obj").unlink()
    _out, err = process.communicate(timeout=20)
    assert process.returncode == 1
    assert "b.obj cannot be read" in sentence_of(job, "b")
    assert "2 of 3 items done, 1 failed" in err


def test_processors_are_shared_out(job):
    job.meshes(a="ok")
    job.fill_all()
    environment = {**job.environment, "SLURM_CPUS_PER_TASK": "8"}
    subprocess.run(job.command("--jobs", "2"), env=environment, check=True, capture_output=True)
    assert "with 4 threads" in (job.results / "a.log").read_text()


def test_a_job_from_another_folder(job):
    """Paths in the file are relative to it, wherever the command is run."""
    job.meshes(a="ok curve")
    job.fill_all()
    moved = job.folder / "elsewhere"
    moved.mkdir()
    command = job.command()
    command[2] = os.path.join("..", job.file.name)
    done = subprocess.run(command, cwd=moved, env=job.environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (job.results / "a.obj").exists()
    assert not any(moved.iterdir())


def test_a_folder_that_was_copied_is_still_done(job, tmp_path):
    job.meshes(a="ok curve")
    job.fill_all()
    assert job.run().returncode == 0
    copy = tmp_path / "copy"
    copy.mkdir()
    for name in ("meshes", "job"):
        shutil.copytree(job.folder / name, copy / name)
    shutil.copy(job.file, copy)
    job.file, job.folder = copy / job.file.name, copy
    assert job.run().returncode == 0
    assert job.runs == []


def test_letters_that_a_console_does_not_know(job):
    """A failure with an umlaut and worse, in a system whose output is ASCII."""
    said = "the mesh 'Würfel \u2192 \u7403' has no faces; choose another"
    job.meshes(**{"a": f"refuse {said}", "Grüße": "ok"})
    job.fill_all()
    ascii_only = {
        **job.environment, "PYTHONIOENCODING": "ascii", "LC_ALL": "C.UTF-8", "PYTHONUTF8": "0",
    }  # fmt: skip
    listed = subprocess.run(job.command("--list"), capture_output=True, env=ascii_only)
    assert listed.returncode == 0, listed.stderr
    assert b"Gr\\xfc\\xdfe" in listed.stdout
    done = subprocess.run(job.command(), capture_output=True, env=ascii_only)
    assert done.returncode == 1 and b"Traceback" not in done.stderr
    assert b"W\\xfcrfel \\u2192 \\u7403" in done.stdout + done.stderr
    assert "Würfel \u2192 \u7403" in (job.results / "a.log").read_text(encoding="utf-8")


@pytest.mark.parametrize("closed", [("stdout",), ("stderr",), ("stdout", "stderr")])
def test_whoever_stops_reading_ends_no_job(job, closed):
    job.meshes(a="ok", b="ok", c="refuse it is full", d="ok")
    job.fill_all()
    for arguments in ((), ("--list",), ("--dry-run",), ("--status",)):
        read, write = os.pipe()
        os.close(read)
        streams = dict.fromkeys(("stdout", "stderr"), subprocess.PIPE)
        streams |= dict.fromkeys(closed, write)
        ended = subprocess.run(
            job.command(*arguments), env=job.environment, text=True, timeout=60, **streams
        )
        os.close(write)
        assert ended.returncode == (0 if "--list" in arguments or "--dry-run" in arguments else 1)
        assert "Traceback" not in (ended.stdout or "") + (ended.stderr or "")
    assert job.summary()["done"] == 3


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no full device")
def test_a_full_disk_behind_what_is_said_ends_no_job(job):
    job.meshes(a="ok", b="ok")
    job.fill_all()
    with open("/dev/full", "wb") as full:
        ended = subprocess.run(
            job.command(), env=job.environment, timeout=60, stdout=full, stderr=full
        )
        assert (ended.returncode, job.summary()["done"]) == (0, 2)
        listed = subprocess.run(
            job.command("--list"), timeout=60, stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert listed.returncode == 2
    assert "the standard output cannot be written (No space left on device)" in listed.stderr
    assert "Traceback" not in listed.stderr


def test_an_interruption_before_anything_runs_is_one_sentence(job, monkeypatch):
    def interrupted(*_arguments):
        raise KeyboardInterrupt

    job.meshes(a="ok")
    job.fill_all()
    monkeypatch.setattr(command, "items_of", interrupted)
    ended = job.run()
    assert (ended.returncode, ended.stderr) == (130, "meander: interrupted\n")

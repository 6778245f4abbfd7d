# SPDX-License-Identifier: GPL-3.0-or-later
"""A job as an array of Slurm's: 40 items over 4 tasks, one killed, one malformed, one hanging."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import geometry
from conftest import ROOT

FARM = ROOT / "addon" / "meander" / "farm.py"
ITEMS, TASKS = 40, 4


def write_meshes(folder: Path) -> None:
    """All alike but one that no one can read, and one that would take hours."""
    folder.mkdir()
    for number in range(ITEMS):
        geometry.write_obj(folder / f"m{number:02}.obj", geometry.grid(6))
    (folder / "m07.obj").write_text("v 0 0\n")


def job_of(folder: Path) -> Path:
    write_meshes(folder / "meshes")
    path = folder / "fill.toml"
    # Of two items for the same file the second would have the same name.
    rest = ", ".join(f'"meshes/m{number:02}.obj"' for number in range(ITEMS) if number != 22)
    path.write_text(
        f"[defaults]\nspacing = 0.15\ntimeout = 120\nmemory = 1000\n[[items]]\ninput = [{rest}]\n"
        '[[items]]\ninput = "meshes/m22.obj"\nspacing = 0.0005\n'
    )
    return path


def farm(job: Path, *arguments: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, str(FARM), str(job), *arguments], capture_output=True, text=True
    )


def submit(job: Path, script: Path, slurm: dict[str, str]) -> subprocess.Popen:
    return subprocess.Popen(["sbatch", "--wait", str(script)], env=slurm, cwd=job.parent)


def process_of(word: str) -> int | None:
    """The engine that fills the item of this name."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                command = (entry / "cmdline").read_bytes().decode()
            except OSError:
                continue
            if "batch.py" in command and word in command:
                return int(entry.name)
    return None


def test_an_array_of_four_tasks(slurm, tmp_path, capsys):
    job = job_of(tmp_path)
    script = tmp_path / "fill.sh"
    script.write_text(farm(job, "--slurm", str(TASKS)).stdout)
    began = time.monotonic()
    waiting = submit(job, script, slurm)
    end = time.monotonic() + 120
    while (victim := process_of(str(job.parent / "meshes" / "m22.obj"))) is None:
        assert time.monotonic() < end
        time.sleep(0.05)
    os.kill(victim, signal.SIGKILL)
    code = waiting.wait(timeout=300)
    took = time.monotonic() - began
    # The tasks with the killed and the malformed item end with 1, and so does the array.
    assert code == 1
    folder = tmp_path / "fill"
    shards = [
        json.loads((folder / f"summary-{number}-of-{TASKS}.json").read_text())
        for number in range(1, TASKS + 1)
    ]
    assert [shard["items"] for shard in shards] == [ITEMS // TASKS] * TASKS
    assert sum(shard["done"] for shard in shards) == ITEMS - 2
    failures = {
        result["name"]: result["sentence"]
        for shard in shards for result in shard["results"] if result["state"] == "failed"
    }  # fmt: skip
    assert set(failures) == {"m07", "m22"}
    assert "three coordinates" in failures["m07"] and "SIGKILL" in failures["m22"]
    assert len({path.read_bytes() for path in folder.glob("m*.obj")}) == 1
    assert not [path for path in folder.iterdir() if path.name.startswith(".")]
    done = farm(job, "--status")
    assert done.returncode == 1
    assert f"{ITEMS - 2} of {ITEMS} items done, 2 failed, 0 left" in done.stderr

    # Mended, and submitted again: only the two are run.
    times = {path.name: path.stat().st_mtime_ns for path in folder.glob("m*.obj")}
    good = (tmp_path / "meshes" / "m00.obj").read_text()
    (tmp_path / "meshes" / "m07.obj").write_text(good)
    job.write_text(job.read_text().replace("0.0005", "0.2"))
    again = time.monotonic()
    assert submit(job, script, slurm).wait(timeout=300) == 0
    assert farm(job, "--status").returncode == 0
    assert all((folder / name).stat().st_mtime_ns == time_of for name, time_of in times.items())
    assert len(list(folder.glob("m*.obj"))) == ITEMS
    with capsys.disabled():
        print(f"\n{ITEMS} items over {TASKS} tasks in {took:.0f} s; again in "
              f"{time.monotonic() - again:.0f} s")


def test_a_cancelled_array_leaves_no_process(slurm, tmp_path):
    write_meshes(tmp_path / "meshes")
    job = tmp_path / "fill.toml"
    text = '[defaults]\nspacing = {}\n[[items]]\ninput = ["meshes/m00.obj", "meshes/m01.obj"]\n'
    job.write_text(text.format(0.0005))
    script = tmp_path / "fill.sh"
    script.write_text(farm(job, "--slurm", "2").stdout)
    sent = subprocess.run(
        ["sbatch", "--parsable", str(script)], env=slurm, capture_output=True, text=True, check=True
    )
    names = [str(tmp_path / "meshes" / f"m0{number}.obj") for number in range(2)]
    end = time.monotonic() + 60
    while not all(map(process_of, names)):
        assert time.monotonic() < end
        time.sleep(0.1)
    subprocess.run(["scancel", sent.stdout.strip()], env=slurm, check=True)
    while any(map(process_of, names)):
        assert time.monotonic() < end
        time.sleep(0.1)
    job.write_text(text.format(0.2))
    assert submit(job, script, slurm).wait(timeout=120) == 0
    assert farm(job, "--status").returncode == 0
    folder = tmp_path / "fill"
    assert not [path for path in folder.iterdir() if path.name.startswith(".")]

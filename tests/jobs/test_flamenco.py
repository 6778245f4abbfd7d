# SPDX-License-Identifier: GPL-3.0-or-later
"""The job type for Flamenco, compiled by a JavaScript engine against a stand-in for its Manager.

The stand-in is made from Flamenco's documentation; no Flamenco has run. What its workers would
start is started here.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import FARM, ROOT

SCRIPT = ROOT / "addon" / "meander" / "jobs" / "meander_fill.js"
STAND_IN = Path(__file__).with_name("flamenco.js")
GIVEN = {"job_file": "/farm/job.toml", "farm_script": "/farm/farm.py"}


def compiled(folder: Path, settings: dict) -> subprocess.CompletedProcess:
    engine = shutil.which("duk")
    assert engine, "this test needs duktape; scripts/install_dependencies.sh installs it"
    whole = folder / "whole.js"
    parts = [SCRIPT.read_text(), f"const SETTINGS = {json.dumps(settings)};", STAND_IN.read_text()]
    whole.write_text("\n".join(parts))
    return subprocess.run([engine, str(whole)], capture_output=True, text=True, timeout=20)


def tasks_of(folder: Path, **settings: object) -> list[dict]:
    done = compiled(folder, GIVEN | settings)
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout)


def test_every_shard_is_a_task_and_a_last_one_checks_them(tmp_path):
    *shards, check = tasks_of(tmp_path, tasks=3, at_once=2)
    assert [task["name"] for task in shards] == [f"fill-{number}-of-3" for number in (1, 2, 3)]
    assert check["dependencies"] == [task["name"] for task in shards]
    for number, task in enumerate(shards, 1):
        assert task["type"] == "blender" and task["dependencies"] == []
        (one,) = task["commands"]
        assert one["name"] == "exec" and one["parameters"]["exe"] == "{blender}"
        arguments = one["parameters"]["args"]
        assert arguments[arguments.index("--python") + 1] == "/farm/farm.py"
        own = arguments[arguments.index("--") + 1 :]
        assert own == ["/farm/job.toml", "--jobs", "2", "--shard", f"{number}/3"]


def test_the_defaults_make_a_job(tmp_path):
    assert len(tasks_of(tmp_path)) == 5


@pytest.mark.parametrize("settings", [{"tasks": 0}, {"tasks": "many"}, {"taks": 3}])
def test_wrong_settings_are_refused(tmp_path, settings):
    assert compiled(tmp_path, GIVEN | settings).returncode != 0


def test_required_settings_are_asked_for(tmp_path):
    assert compiled(tmp_path, {"job_file": "/farm/job.toml"}).returncode != 0


def test_the_commands_of_the_tasks_do_the_job(tmp_path, job):
    """In this process, with the arguments that a worker's Blender would be given."""
    job.meshes(a="ok curve", b="refuse it; see", c="ok curve")
    job.fill_all()
    found = tasks_of(tmp_path, job_file=str(job.file), farm_script=str(FARM), tasks=2)
    codes = []
    for task in found:
        arguments = task["commands"][0]["parameters"]["args"]
        file, *own = arguments[arguments.index("--") + 1 :]
        assert file == str(job.file)
        codes.append(job.run(*own).returncode)
    assert codes == [0, 1, 1]
    assert job.runs == ["a", "b", "c"]
    assert job.run("--list").stdout.count("done") == 2

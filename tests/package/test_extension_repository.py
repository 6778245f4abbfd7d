# SPDX-License-Identifier: GPL-3.0-or-later
"""A repository of one's own, from which Blender installs the add-on by its URL."""

from __future__ import annotations

import functools
import hashlib
import http.server
import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
SCRIPT = ROOT / "scripts/extension_repository.py"


@pytest.fixture(scope="module")
def repository(addon_zip: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("served") / "repository"
    subprocess.run([sys.executable, SCRIPT, folder, addon_zip], check=True, timeout=60)
    return folder


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_arguments: object) -> None:
        pass


@pytest.fixture(params=["file", "http"])
def url(request: pytest.FixtureRequest, repository: Path) -> Iterator[str]:
    if request.param == "file":
        yield (repository / "index.json").as_uri()
        return
    handler = functools.partial(Quiet, directory=repository)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/index.json"
        server.shutdown()


def test_the_index_names_what_is_there(repository: Path, addon_zip: Path) -> None:
    (entry,) = json.loads((repository / "index.json").read_text())["data"]
    archive = repository / entry["archive_url"]
    assert archive.read_bytes() == addon_zip.read_bytes()
    assert entry["archive_size"] == archive.stat().st_size
    assert entry["archive_hash"] == f"sha256:{hashlib.sha256(archive.read_bytes()).hexdigest()}"
    assert archive.name in (repository / "index.html").read_text()


def test_blender_installs_from_it(url: str, bpy_python: Path, tmp_path: Path) -> None:
    (tmp_path / "home").mkdir()
    environment = {
        "PATH": os.environ["PATH"], "LANG": "C.UTF-8",
        "HOME": str(tmp_path / "home"), "BLENDER_USER_RESOURCES": str(tmp_path / "profile"),
    }  # fmt: skip
    (tmp_path / "profile").mkdir()
    report = tmp_path / "report.json"
    done = subprocess.run(
        [bpy_python, HERE / "install_from_repository.py", "--", url, report],
        cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=240,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads(report.read_text())
    assert Path(found["module"]).is_relative_to(tmp_path / "profile/extensions/studio/meander")
    assert len(found["points"]) == 1 and found["points"][0] > 100


def test_a_zip_that_is_not_there_makes_nothing(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, SCRIPT, tmp_path / "new", tmp_path / "gone.zip"],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert done.returncode == 2
    assert "gone.zip is not a file" in done.stderr
    assert not (tmp_path / "new").exists()

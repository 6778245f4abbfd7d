# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages show the rows of docs/results/, and every row says where it is from."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "scripts"))

import result_tables  # noqa: E402

FILES = sorted((ROOT / "docs" / "results").glob("*.json"))
RESULTS = {
    "measured_by": "`bench`",
    "revision": "abc",
    "machine": "two processors",
    "only": {"row": "single"},
    "columns": [
        {"head": "model", "key": "case"},
        {"head": "ms", "key": "new.seconds", "times": 1000, "format": ".1f"},
    ],
    "rows": [{"case": "cube", "new.seconds": 0.25}],
}
PAGE = "# Page\n\n<!-- results: speed -->\nold\n<!-- end of results -->\n\nText.\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "speed.json").write_text(result_tables.as_text(RESULTS), encoding="utf-8")
    return tmp_path


def test_the_tables_in_the_documents_are_current() -> None:
    command = [sys.executable, ROOT / "scripts" / "result_tables.py", "--check"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_page_that_differs_from_its_rows_is_found(tmp_path, monkeypatch, capsys) -> None:
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / "speed.json").write_text(result_tables.as_text(RESULTS))
    (tmp_path / "page.md").write_text(PAGE)
    monkeypatch.setattr(result_tables, "DOCS", tmp_path)
    monkeypatch.setattr(sys, "argv", ["result_tables.py", "--check"])
    assert result_tables.main() == 1
    assert "page.md is out of date" in capsys.readouterr().out
    monkeypatch.setattr(sys, "argv", ["result_tables.py"])
    assert result_tables.main() == 0
    monkeypatch.setattr(sys, "argv", ["result_tables.py", "--check"])
    assert result_tables.main() == 0
    text = (tmp_path / "page.md").read_text()
    (tmp_path / "page.md").write_text(text.replace("250.0", "249.9"))
    assert result_tables.main() == 1


def test_a_table_has_its_rows_and_their_origin(folder) -> None:
    text = result_tables.page_with_tables(PAGE, folder)
    assert "| model | ms |\n| --- | --- |\n| cube | 250.0 |" in text
    assert "*Measured by `bench`; revision abc; two processors.*" in text
    assert text.startswith("# Page\n") and text.endswith("\n\nText.\n")
    assert result_tables.page_with_tables(text, folder) == text


def test_rows_of_a_command_are_stored(folder) -> None:
    lines = [
        "Blender 3.4.1 says something",
        json.dumps({"row": "single", "case": "ball", "new": {"seconds": 0.5}, "more": 1}),
        json.dumps({"row": "mean", "case": "all"}),
    ]
    result_tables.store(folder / "speed.json", lines)
    stored = json.loads((folder / "speed.json").read_text())
    assert stored["rows"] == [{"case": "ball", "new.seconds": 0.5}]
    assert stored["columns"] == RESULTS["columns"]
    assert stored["machine"] and stored["date"]


def test_nothing_is_stored_where_no_row_fits(folder) -> None:
    before = (folder / "speed.json").read_bytes()
    with pytest.raises(SystemExit, match="no row"):
        result_tables.store(folder / "speed.json", ['{"row": "mean"}'])
    assert (folder / "speed.json").read_bytes() == before


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_rows_have_an_origin_and_a_page(path) -> None:
    results = json.loads(path.read_text(encoding="utf-8"))
    assert results["revision"] and results["machine"] and results["measured_by"] and results["rows"]
    assert len(results["columns"]) <= 7, "wider than a page of the site"
    keys = {column["key"] for column in results["columns"]}
    for row in results["rows"]:
        assert set(row) == keys
    shown = [
        page for page in (ROOT / "docs").rglob("*.md")
        if f"<!-- results: {path.stem} -->" in page.read_text(encoding="utf-8")
    ]
    assert len(shown) == 1


def test_every_table_of_results_is_closed() -> None:
    for page in (ROOT / "docs").rglob("*.md"):
        text = page.read_text(encoding="utf-8")
        assert len(re.findall("<!-- results: ", text)) == text.count(result_tables.END), page.name

# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines of progress of the batch command are those that docs/python.md says they are."""

from __future__ import annotations

import re
import time
from pathlib import Path
from types import SimpleNamespace

import geometry
import pytest
from flows import flow_on
from meander.cli import watching
from meander.model.estimate import PHASE_TEXTS

PAGE = (Path(__file__).parents[2] / "docs" / "python.md").read_text("utf-8")
SECTION = PAGE.split("### Lines of progress\n")[1].split("\n#")[0]
LINE = re.compile(next(line for line in SECTION.splitlines() if line.startswith("^meander")))
# What a picture says without a share.
NO_PROGRESS = {"correction"}


@pytest.fixture(autouse=True)
def every_moment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_PROGRESS_SHARE", "_PROGRESS_SECONDS", "_FIRST_SECONDS"):
        monkeypatch.setattr(watching, name, 0.0)
    monkeypatch.setattr(watching, "_LONGEST_PAUSE", 0.001)


def test_the_page_names_all_that_is_done() -> None:
    rows = re.findall(r"^\| (.+?) \|", SECTION, re.MULTILINE)
    named = {what for row in rows for what in row.split(", ")} - {"what", "reading FILE"}
    assert named == {text.lower() for key, text in PHASE_TEXTS.items() if key not in NO_PROGRESS}


def test_a_run_says_such_lines() -> None:
    said: list[str] = []
    with flow_on(geometry.icosphere(3), radius=0.08) as flow:
        watching.run(flow, said.append)
    found = [LINE.match(line) for line in said]
    assert found and all(found)
    assert {line["what"] for line in found} <= {text.lower() for text in PHASE_TEXTS.values()}
    shares = [int(line["share"]) for line in found]
    assert shares == sorted(shares) and shares[-1] <= 100


@pytest.mark.parametrize(("share", "expected"), [(None, None), (0.0, "0"), (0.43, "43")])
def test_what_lasts_beside_a_run_says_such_lines(share: float | None, expected: str) -> None:
    said: list[str] = []
    context = None if share is None else SimpleNamespace(progress=share)
    with watching.told(context, "reading a, b.obj", said.append, large=False):
        while not said:
            time.sleep(0.001)
    line = LINE.match(said[0])
    assert line["what"] == "reading a, b.obj" and line["share"] == expected


@pytest.mark.parametrize("line", ["meander: wrote a.obj", "meander: about 1.2 M nodes, 2.5 GB"])
def test_no_other_line_is_taken_for_one(line: str) -> None:
    assert LINE.match(line) is None

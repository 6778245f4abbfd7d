#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a test of an input that fuzz_api fails on.

    /usr/bin/python3 tests/fuzz/shrink.py build/sanitized/fuzz_api CRASH --test test_found.cpp

leaves out whatever the failure does not need, first whole records (tests/fuzz/record.h), then bytes
of those that are left, and writes what then still happens as a GoogleTest program: the calls in
their order, with their arguments and statuses, up to the one that fails. Put it into tests/native,
say what should come instead, and give it a name. With --minimize SECONDS libFuzzer's own
-minimize_crash goes first. The shrunk input is written beside CRASH, or to --output.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

RECORD = 8
SECONDS = 60  # what runs longer hangs

HEAD = """\
// SPDX-License-Identifier: GPL-3.0-or-later
//
// {failure}
#include <gtest/gtest.h>
#include <meander/meander.h>

#include <cmath>
#include <vector>

#include "../fuzz/sized.h"

using meander::fuzz::Sized;

TEST(Found, ByFuzzing) {{
  std::vector<double> vertices, vertex_mask, points, density;
  std::vector<uint32_t> faces;
  std::vector<uint64_t> offsets{{0}};
  std::vector<uint8_t> face_mask, closed, fixed, guides;
  meander_surface_options surface_options;
  meander_surface_options_init(&surface_options, sizeof surface_options);
  surface_options.threads = 1;
  meander_flow_options options;
  meander_flow_options_init(&options, sizeof options, MEANDER_PRESET_EVEN);
  options.threads = 1;
  options.iteration_limit = 6;
  meander_seed seed;
  meander_seed_init(&seed, sizeof seed);
  meander_surface* surfaces[2] = {{}};
  meander_flow* flows[2] = {{}};
  meander_context* context = nullptr;
  Sized<meander_error> error;
  size_t count = 0;
  meander_status status = MEANDER_STATUS_OK;
"""
FOOT = """\
  for (meander_flow* flow : flows) meander_flow_destroy(flow);
  for (meander_surface* surface : surfaces) meander_surface_destroy(surface);
  meander_context_destroy(context);
  static_cast<void>(count + static_cast<size_t>(status));
}
"""


class Target:
    """A fuzz_api, and how one input fails in it."""

    def __init__(self, program: Path, folder: Path) -> None:
        self._program = program.resolve()
        self._input = folder / "input"
        self._transcript = folder / "transcript"
        self.runs = 0

    def failure(self, data: bytes) -> str:
        """What goes wrong, in words that are the same for the same fault; empty: nothing."""
        self.runs += 1
        self._input.write_bytes(data)
        environment = os.environ | {"MEANDER_FUZZ_TRANSCRIPT": str(self._transcript)}
        try:
            done = subprocess.run(
                [str(self._program), str(self._input)], capture_output=True, errors="replace",
                cwd=self._input.parent, env=environment, timeout=SECONDS,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return "it hangs"
        if done.returncode == 0:
            return ""
        for pattern in (r"FOUND: (.*)", r"runtime error: (.*)", r"ERROR: (\w+: [\w-]+)"):
            found = re.search(pattern, done.stderr)
            if found:
                return re.sub(r"[-+.\w]*\d[-+.\w]*", "#", found[1])  # numbers differ
        return f"exit code {done.returncode}"

    def transcript(self, data: bytes) -> str:
        self.failure(data)
        return self._transcript.read_text(encoding="utf-8")


def shrink(target: Target, data: bytes) -> bytes:
    """The same failure from as few records, and as many zeros, as can be had one by one."""
    wanted = target.failure(data)
    if not wanted:
        raise SystemExit("shrink.py: nothing fails with this input; give one that does")
    records = [data[at : at + RECORD] for at in range(0, len(data) // RECORD * RECORD, RECORD)]

    def fails(tried: list[bytes]) -> bool:
        return target.failure(b"".join(tried)) == wanted

    many = max(len(records) // 2, 1)
    while many:
        at = 0
        while at < len(records):
            fewer = records[:at] + records[at + many :]
            if fails(fewer):
                records = fewer
            else:
                at += many
        many //= 2
    for at in range(len(records)):
        for byte in reversed(range(1, RECORD)):
            for value in (0, 1, records[at][byte] & -records[at][byte]):
                if value >= records[at][byte]:
                    continue
                plainer = records[at][:byte] + bytes([value]) + records[at][byte + 1 :]
                if fails([*records[:at], plainer, *records[at + 1 :]]):
                    records[at] = plainer
                    break
    return b"".join(records)


def minimized(program: Path, path: Path, seconds: int, folder: Path) -> bytes:
    """What libFuzzer makes of it by itself."""
    result = folder / "minimized"
    result.write_bytes(path.read_bytes())
    subprocess.run(
        [str(program.resolve()), "-minimize_crash=1", f"-max_total_time={seconds}",
         f"-exact_artifact_path={result}", str(path.resolve())],
        capture_output=True, cwd=folder, check=False,
    )  # fmt: skip
    return result.read_bytes()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, help="fuzz_api")
    parser.add_argument("input", type=Path, help="what it fails on")
    parser.add_argument("--output", type=Path, help="the shrunk input")
    parser.add_argument("--test", type=Path, help="the C++ program; otherwise it is printed")
    parser.add_argument("--minimize", type=int, default=0, metavar="SECONDS")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        target = Target(given.program, folder)
        data = given.input.read_bytes()
        if given.minimize:
            smaller = minimized(given.program, given.input, given.minimize, folder)
            if target.failure(smaller) == target.failure(data):
                data = smaller
        shrunk = shrink(target, data)
        failure = target.failure(shrunk)
        body = target.transcript(shrunk)
    output = given.output or given.input.with_name(given.input.name + ".shrunk")
    output.write_bytes(shrunk)
    text = HEAD.format(failure=failure[:100]) + body + FOOT
    if given.test:
        given.test.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)
    before, after = len(data) // RECORD, len(shrunk) // RECORD
    print(f"shrink.py: {before} records to {after} in {target.runs} runs", file=sys.stderr)


if __name__ == "__main__":
    main()

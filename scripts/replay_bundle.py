#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs what a bundle holds once more: a file that Meander writes where its library has a defect.

    python3 scripts/replay_bundle.py BUNDLE.npz [--curve CURVE.obj]

It begins from the same input and options, and goes on to the iteration that failed. Exit code 1: it
fails again, with the same sentence or another; 0: it does not; 2: the file cannot be read.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

from meander import core
from meander.model.bundle import read_bundle
from meander.model.files import obj
from meander.model.files.whole import FileError
from meander.model.opening import open_flow


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bundle", type=Path)
    parser.add_argument("--curve", type=Path, help="write the last good curve that the bundle has")
    arguments = parser.parse_args()
    try:
        bundle = read_bundle(arguments.bundle)
        if arguments.curve is not None and bundle.curve is not None:
            obj.write_obj_curve(arguments.curve, bundle.curve)
    except (FileError, core.MeanderError) as refusal:
        print(refusal, file=sys.stderr)
        return 2
    print(f"Meander {bundle.version}: {bundle.sentence}")
    done = 0
    try:
        with open_flow(bundle.problem).flow as flow:
            for _iteration in range(bundle.iteration + 1):
                flow.step()
                done += 1
    except core.MeanderError as failure:
        after = f"it fails again, after {done} iterations"
        print(f"Meander {core.library_version()}: {after}: {failure}")
        return 1
    print(f"Meander {core.library_version()}: {done} iterations, and nothing fails")
    return 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands for the batch command: does what the first word of its input says.

ok           writes its outputs, with the rest of the input in them
slow N ...   the same after N seconds
refuse ...   ends with the rest as its sentence
crash        leaves a half-written file, then is killed
hang         leaves a half-written file and a child, then never ends
eat          asks for 900 MB
forget       ends well without any output
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

flags = dict(part.removeprefix("--").partition("=")[::2] for part in sys.argv[1:])
source, output, report = (Path(flags[name]) for name in ("input", "output", "report"))
with open(os.environ["FAKE_RUNS"], "a") as runs:
    runs.write(f"{source.stem}\n")
word, _, rest = source.read_text().strip().partition(" ")
print(f"meander: {word} {source.stem} with {flags['threads']} threads", flush=True)


def leave_half() -> None:
    begin = os.environ["MEANDER_TEMPORARY_NAMES"]
    output.with_name(f".{begin}0123.tmp.obj").write_text("half")


if word == "slow":
    seconds, _, rest = rest.partition(" ")
    time.sleep(float(seconds))
elif word == "refuse":
    print(f"meander: {rest}", file=sys.stderr)
    sys.exit(2)
elif word == "crash":
    leave_half()
    os.kill(os.getpid(), signal.SIGKILL)
elif word == "hang":
    leave_half()
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    Path(f"{output}.child").write_text(str(child.pid))
    time.sleep(600)
elif word == "eat":
    bytearray(900_000_000)
elif word == "forget":
    sys.exit(0)
output.write_text(rest)
report.write_text("{}")

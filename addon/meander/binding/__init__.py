# SPDX-License-Identifier: GPL-3.0-or-later
"""All of ctypes: the library file, its structs and functions, and the objects made of them.

`core` is the door; nothing else imports from here. `abi` is made by the build from the C header,
and comes with the library.
"""

from importlib.util import find_spec

if find_spec(f"{__name__}.abi") is None:
    raise ImportError(
        "Meander has not been built here: run scripts/build.sh stage, or install the add-on from "
        "its zip, or the wheel"
    )

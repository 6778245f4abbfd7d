# SPDX-License-Identifier: GPL-3.0-or-later
#
# WebAssembly for browsers and Node, which have no threads for it: a C library of WASI's calls, of which
# web/src/module.mjs has the few that are made.
set(CMAKE_SYSTEM_NAME Generic) # none that CMake knows
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(zig_target wasm32-wasi)
include("${CMAKE_CURRENT_LIST_DIR}/zig.cmake")

# SPDX-License-Identifier: GPL-3.0-or-later
#
# Compiles for another system by Zig's C++ compiler, which brings the headers and libraries of all of
# them. Included by the files beside it, which set:
#
#   zig_target           as Zig calls it, with the oldest version of the system that is supported
#   CMAKE_SYSTEM_NAME, CMAKE_SYSTEM_PROCESSOR
#
# MEANDER_ZIG names Zig's program; scripts/install_dependencies.sh --package puts it where the
# presets expect it.

set(MEANDER_ZIG "$ENV{MEANDER_ZIG}" CACHE FILEPATH "Zig's program")
if(NOT EXISTS "${MEANDER_ZIG}")
  message(FATAL_ERROR "There is no Zig at '${MEANDER_ZIG}': set MEANDER_ZIG in the environment, "
    "or run scripts/package.sh, which installs it")
endif()
# Projects that CMake makes to try the compiler read this file again.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MEANDER_ZIG)
# What they try can be seen without linking, for which the runtime would have to be built first.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

# CMake hands the target to the compiler. Knowing it, it identifies the compiler without linking a program,
# for which Zig would build a runtime that nothing else needs: a minute for each system.
set(CMAKE_C_COMPILER "${MEANDER_ZIG}" cc)
set(CMAKE_CXX_COMPILER "${MEANDER_ZIG}" c++)
set(CMAKE_C_COMPILER_TARGET ${zig_target})
set(CMAKE_CXX_COMPILER_TARGET ${zig_target})
# Zig adds debug information unless told not to: a third of the compiler's time, and its runtime's is
# fifty times larger than the library. A program that keeps it needs a runtime of its own, built anew.
set(CMAKE_C_FLAGS_INIT -g0)
set(CMAKE_CXX_FLAGS_INIT -g0)
set(CMAKE_EXE_LINKER_FLAGS_INIT -s)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -s)

# CMake calls these as programs without arguments of their own.
foreach(tool ar ranlib rc)
  set(file "${CMAKE_BINARY_DIR}/zig-${tool}")
  if(NOT EXISTS "${file}")
    file(WRITE "${file}" "#!/bin/sh\nexec '${MEANDER_ZIG}' ${tool} \"$@\"\n")
    file(CHMOD "${file}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  endif()
endforeach()
set(CMAKE_AR "${CMAKE_BINARY_DIR}/zig-ar")
set(CMAKE_RANLIB "${CMAKE_BINARY_DIR}/zig-ranlib")
set(CMAKE_RC_COMPILER "${CMAKE_BINARY_DIR}/zig-rc")

# Nothing of this machine's is for the other one.
set(CMAKE_FIND_ROOT_PATH "${CMAKE_BINARY_DIR}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Every system that we build for has threads without a library or with one that Zig links by itself.
set(CMAKE_HAVE_LIBC_PTHREAD TRUE)
set(THREADS_PREFER_PTHREAD_FLAG FALSE)

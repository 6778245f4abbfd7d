# SPDX-License-Identifier: GPL-3.0-or-later
#
# Where ccache is installed, what has been compiled before is taken from its cache, also in another folder: a fresh
# clone, a build with sanitizers made anew. Objects are the same bytes. A launcher that the caller has set stays;
# CCACHE_DISABLE=1 in the environment compiles everything. Zig has a cache of its own.
find_program(MEANDER_CCACHE ccache DOC "ccache's program")
mark_as_advanced(MEANDER_CCACHE)
if(MEANDER_CCACHE AND NOT CMAKE_CROSSCOMPILING)
  foreach(language C CXX)
    if(NOT CMAKE_${language}_COMPILER_LAUNCHER)
      # The last three are what precompiled headers need: GCC tells a header that it has seen by all of its bytes, so one
      # that differs in a comment alone is another.
      set(CMAKE_${language}_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}"
        CCACHE_NOHASHDIR=1 CCACHE_COMMENTS=1 CCACHE_SLOPPINESS=pch_defines,time_macros "${MEANDER_CCACHE}")
    endif()
  endforeach()
endif()

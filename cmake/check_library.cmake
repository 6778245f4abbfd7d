# SPDX-License-Identifier: GPL-3.0-or-later
#
# cmake -DLIBRARY=... -DHEADER=... -DNM=nm -DREADELF=readelf -P check_library.cmake
#
# Fails unless the shared library exports exactly the functions that the header declares and has
# $ORIGIN as its only search path.

file(READ "${HEADER}" header)
string(REGEX MATCHALL "MEANDER_API [^;(]*(meander_[a-z_]+)\\(" declarations "${header}")
set(declared "")
foreach(declaration IN LISTS declarations)
  string(REGEX MATCH "(meander_[a-z_]+)\\($" unused "${declaration}")
  list(APPEND declared "${CMAKE_MATCH_1}")
endforeach()
list(LENGTH declared count)
if(count EQUAL 0)
  message(FATAL_ERROR "no declarations found in ${HEADER}: has MEANDER_API been renamed?")
endif()

execute_process(COMMAND "${NM}" -D --defined-only --format=posix "${LIBRARY}"
  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "\n$" "" symbols "${symbols}")
string(REPLACE "\n" ";" symbols "${symbols}")
set(exported "")
foreach(symbol IN LISTS symbols)
  string(REGEX REPLACE " .*" "" symbol "${symbol}")
  list(APPEND exported "${symbol}")
endforeach()

set(missing ${declared})
if(exported)
  list(REMOVE_ITEM missing ${exported})
endif()
set(surplus ${exported})
list(REMOVE_ITEM surplus ${declared})
if(missing OR surplus)
  message(FATAL_ERROR "declared but not exported: ${missing}\nexported but not declared: ${surplus}")
endif()

execute_process(COMMAND "${READELF}" -d "${LIBRARY}"
  OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "R(UN)?PATH[^\n]*\\[[^\n]*\\]" paths "${dynamic}")
if(NOT paths MATCHES "\\[\\$ORIGIN\\]$")
  message(FATAL_ERROR "the search path should be $ORIGIN alone, but is: ${paths}")
endif()
message(STATUS "${count} functions exported, search path $ORIGIN")

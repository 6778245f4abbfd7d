# SPDX-License-Identifier: GPL-3.0-or-later
#
# cmake -DLIBRARY=... -DHEADERS=FOLDER -DNM=nm -DREADELF=readelf [-DSANITIZED=ON] -P check_library.cmake
#
# Fails unless the shared library exports exactly the functions that the headers declare, needs no
# libraries but those of the compiler and the system (a sanitized one also that of the sanitizers),
# and has no search path for them, and computes no curve with functions that differ between systems.

file(GLOB files "${HEADERS}/*.h")
set(header "")
foreach(file IN LISTS files)
  file(READ "${file}" text)
  string(APPEND header "${text}")
endforeach()
string(REGEX MATCHALL "MEANDER_API [^;(]*(meander_[a-z_]+)\\(" declarations "${header}")
set(declared "")
foreach(declaration IN LISTS declarations)
  string(REGEX MATCH "(meander_[a-z_]+)\\($" unused "${declaration}")
  list(APPEND declared "${CMAKE_MATCH_1}")
endforeach()
list(LENGTH declared count)
if(count EQUAL 0)
  message(FATAL_ERROR "no declarations found in ${HEADERS}: has MEANDER_API been renamed?")
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

# Functions that round differently from system to system; base/elementary.h has ours. (cabs is left:
# Eigen chooses pivots by it, of numbers without an imaginary part.)
execute_process(COMMAND "${NM}" -D --undefined-only --format=posix "${LIBRARY}"
  OUTPUT_VARIABLE undefined COMMAND_ERROR_IS_FATAL ANY)
if(undefined MATCHES "(^|\n)((sin|cos|sincos|tan|asin|acos|atan|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow|hypot|cbrt)f?)[ @]")
  message(FATAL_ERROR "use elementary::${CMAKE_MATCH_2}, which rounds alike everywhere: base/elementary.h")
endif()

# A quotient of complex numbers, which run-time libraries scale in their own ways; base/eigen.h has one that is the same everywhere.
if(undefined MATCHES "(^|\n)__divdc3[ @]")
  message(FATAL_ERROR "std::complex / std::complex rounds differently from system to system: divide in Eigen, or by a real number")
endif()

execute_process(COMMAND "${READELF}" -d "${LIBRARY}"
  OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
if(dynamic MATCHES "R(UN)?PATH[^\n]*")
  message(FATAL_ERROR "there should be no search path, but there is: ${CMAKE_MATCH_0}")
endif()
string(REGEX MATCHALL "NEEDED[^\n]*\\[[^\n]*\\]" needed "${dynamic}")
if(NOT needed)
  message(FATAL_ERROR "readelf names no library that is needed: has its output changed?")
endif()
if(SANITIZED)
  list(FILTER needed EXCLUDE REGEX "\\[lib(a|ub)san\\.")
endif()
foreach(library IN LISTS needed)
  if(NOT library MATCHES "\\[(libstdc\\+\\+|libgcc_s|libm|libc|ld-linux[^.]*)\\.so\\.[0-9]+\\]$")
    message(FATAL_ERROR "a library that not every system has: ${library}")
  endif()
endforeach()
message(STATUS "${count} functions exported, nothing but the system needed")

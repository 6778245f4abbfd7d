# SPDX-License-Identifier: GPL-3.0-or-later
#
# meander_compile_options: how all of our code is compiled. Headers of other projects come through
# imported targets, which CMake passes as system headers, so they cause no warnings.

add_library(meander_compile_options INTERFACE)

target_compile_options(meander_compile_options INTERFACE
  -Wall -Wextra -Wshadow
  $<$<COMPILE_LANGUAGE:CXX>:-Wconversion>
  # Clang's -Wconversion includes this, GCC's does not.
  $<$<COMPILE_LANG_AND_ID:CXX,Clang,AppleClang>:-Wno-sign-conversion>
  # No code reads errno or traps floating-point exceptions, and support for them keeps sqrt and
  # comparisons from being plain instructions. -ffast-math is out of the question: crossing tests
  # rely on exact signs.
  -fno-math-errno -fno-trapping-math
  # A fused multiply-add rounds once instead of twice: the same source would give different curves
  # on a processor that has it. For the same reason there is no -march=native.
  -ffp-contract=off)

# Exceptions are not part of WebAssembly from the beginning; vectors of two doubles are in every browser that has them.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "wasm32")
  target_compile_options(meander_compile_options INTERFACE -fwasm-exceptions -mexception-handling -msimd128)
endif()

# What is built for release has the same bytes in whatever folder its sources lie.
if(CMAKE_CROSSCOMPILING)
  target_compile_options(meander_compile_options INTERFACE
    "-ffile-prefix-map=${PROJECT_BINARY_DIR}=build"
    "-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.")
endif()

if(MEANDER_WERROR)
  target_compile_options(meander_compile_options INTERFACE -Werror)
endif()

if(MEANDER_SANITIZE)
  target_compile_options(meander_compile_options INTERFACE
    -fsanitize=${MEANDER_SANITIZE} -fno-omit-frame-pointer)
  # Without recovery the first undefined behaviour fails the test instead of only printing a line.
  if(MEANDER_SANITIZE MATCHES "undefined")
    target_compile_options(meander_compile_options INTERFACE -fno-sanitize-recover=undefined)
  endif()
  if(MEANDER_SANITIZE_EXCEPT)
    target_compile_options(meander_compile_options INTERFACE -fno-sanitize=${MEANDER_SANITIZE_EXCEPT})
  endif()
  target_link_options(meander_compile_options INTERFACE -fsanitize=${MEANDER_SANITIZE})
endif()

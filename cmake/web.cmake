# SPDX-License-Identifier: GPL-3.0-or-later
#
# The library as a WebAssembly module: build/package/web/meander.wasm, with only those functions that the
# JavaScript in web/src calls. scripts/build_web.sh makes the package and the page from it.

# Zig's C++ runtime for WASI is compiled without exceptions, but brings the sources of one that has them.
get_filename_component(zig_folder "${MEANDER_ZIG}" REALPATH)
get_filename_component(zig_folder "${zig_folder}" DIRECTORY)
set(cxxabi "${zig_folder}/lib/libcxxabi")
foreach(name abort_message cxa_aux_runtime cxa_exception cxa_exception_storage cxa_guard cxa_handlers cxa_personality
        cxa_vector cxa_virtual fallback_malloc private_typeinfo stdlib_exception stdlib_stdexcept stdlib_typeinfo
        cxa_default_handlers)
  list(APPEND runtime_sources "${cxxabi}/src/${name}.cpp")
endforeach()
list(APPEND runtime_sources "${zig_folder}/lib/libunwind/src/Unwind-wasm.c")

add_library(meander_runtime OBJECT ${runtime_sources} "${PROJECT_SOURCE_DIR}/native/web/exception_tag.c")
target_include_directories(meander_runtime PRIVATE
  "$<$<COMPILE_LANGUAGE:CXX>:${cxxabi}/include>" "$<$<COMPILE_LANGUAGE:CXX>:${zig_folder}/lib/libcxx/src>"
  "${zig_folder}/lib/libunwind/include" "${zig_folder}/lib/libunwind/src")
target_compile_definitions(meander_runtime PRIVATE
  _LIBCPP_BUILDING_LIBRARY _LIBCXXABI_BUILDING_LIBRARY LIBCXX_BUILDING_LIBCXXABI _LIBCXXABI_HAS_NO_THREADS
  _LIBUNWIND_HAS_NO_THREADS _LIBUNWIND_HIDE_SYMBOLS LIBCXXABI_SILENT_TERMINATE LIBCXXABI_NON_DEMANGLING_TERMINATE)
target_compile_options(meander_runtime PRIVATE -w)
# One object: the linker sees Zig's runtime first, and takes from there what is still undefined after an object.
set_target_properties(meander_runtime PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
target_link_libraries(meander_runtime PRIVATE meander_compile_options)

# Zig compiles all of its C and C++ library for a module: a minute and a half of a processor. With a C library that
# is compiled already, such as Debian's wasi-libc, only what the module needs of libc++ is compiled, and the linker is
# called without Zig, which would add its own.
set(MEANDER_WASI_LIBC "" CACHE PATH "A folder with crt1-reactor.o and libc.a for wasm32-wasi; empty: Zig's own")
set(MEANDER_WASI_BUILTINS "" CACHE FILEPATH "What the compiler calls, as an archive, where MEANDER_WASI_LIBC is set")
if(MEANDER_WASI_LIBC)
  set(libcxx "${zig_folder}/lib/libcxx")
  foreach(name string algorithm memory new new_handler new_helpers stdexcept exception hash functional chrono call_once
          error_category verbose_abort typeinfo charconv ios locale system_error ios.instantiations ostream ryu/d2fixed
          ryu/d2s ryu/f2s)
    list(APPEND libcxx_sources "${libcxx}/src/${name}.cpp")
  endforeach()
  add_library(meander_libcxx OBJECT ${libcxx_sources})
  target_include_directories(meander_libcxx PRIVATE
    "${libcxx}/src" "${libcxx}/src/include" "${libcxx}/libc" "${cxxabi}/include")
  target_compile_definitions(meander_libcxx PRIVATE
    _LIBCPP_BUILDING_LIBRARY LIBCXX_BUILDING_LIBCXXABI _LIBCXXABI_HAS_NO_THREADS)
  target_compile_options(meander_libcxx PRIVATE -w -O1 -ffunction-sections -fdata-sections)
  set_target_properties(meander_libcxx PROPERTIES CXX_STANDARD 23 UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0
    CXX_VISIBILITY_PRESET hidden)
  # They have members that are inline elsewhere.
  set_source_files_properties("${libcxx}/src/memory.cpp" "${libcxx}/src/error_category.cpp"
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_link_libraries(meander_libcxx PRIVATE meander_compile_options)
endif()

# Rooms in which a run spends little of its time are compiled for size: a module smaller by 40 KB, of the 450 that a
# server may send, and runs take 1.4 to 1.5 times as long as natively.
foreach(room api base flow mesh model outputs seed)
  set_source_files_properties("${PROJECT_BINARY_DIR}/CMakeFiles/meander_core.dir/Unity/unity_${room}_cxx.cxx"
    PROPERTIES COMPILE_OPTIONS -Os)
endforeach()

# Functions that the binding calls: what is not reached from them is left out.
file(GLOB binding_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/web/src/*.mjs")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${binding_sources})
set(exports malloc free)
foreach(source IN LISTS binding_sources)
  file(READ "${source}" text)
  string(REGEX MATCHALL "native\\.(meander_[a-z_]+)" calls "${text}")
  list(TRANSFORM calls REPLACE "^native\\." "")
  list(APPEND exports ${calls})
endforeach()
list(REMOVE_DUPLICATES exports)
list(SORT exports)

add_executable(meander $<TARGET_OBJECTS:meander_runtime> $<TARGET_OBJECTS:meander_core>)
target_link_libraries(meander PRIVATE meander_compile_options)
list(TRANSFORM exports PREPEND --export=)
if(MEANDER_WASI_LIBC)
  target_sources(meander PRIVATE $<TARGET_OBJECTS:meander_libcxx>)
  set(CMAKE_CXX_LINK_EXECUTABLE
    "\"${MEANDER_ZIG}\" wasm-ld --stack-first --entry _initialize <LINK_FLAGS> -o <TARGET> \
      \"${MEANDER_WASI_LIBC}/crt1-reactor.o\" <OBJECTS> \"${MEANDER_WASI_LIBC}/libc.a\" \"${MEANDER_WASI_BUILTINS}\"")
  list(JOIN exports " " exports)
  set_target_properties(meander PROPERTIES
    LINK_FLAGS "--gc-sections -z stack-size=4194304 --max-memory=4294901760 ${exports}")
else()
  list(TRANSFORM exports PREPEND "LINKER:")
  target_link_options(meander PRIVATE -mexec-model=reactor ${exports}
    "LINKER:--gc-sections" "LINKER:-z,stack-size=4194304" "LINKER:--max-memory=4294901760")
endif()
set_target_properties(meander PROPERTIES SUFFIX .wasm)

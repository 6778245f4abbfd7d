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

# Rooms whose work is done once in a run are compiled for size: a module smaller by 30 KB, and runs take as long.
foreach(room api mesh outputs seed)
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
list(TRANSFORM exports PREPEND "LINKER:--export=")

add_executable(meander $<TARGET_OBJECTS:meander_runtime> $<TARGET_OBJECTS:meander_core>)
target_link_libraries(meander PRIVATE meander_compile_options)
target_link_options(meander PRIVATE -mexec-model=reactor ${exports}
  "LINKER:--gc-sections" "LINKER:-z,stack-size=4194304" "LINKER:--max-memory=4294901760")
set_target_properties(meander PROPERTIES SUFFIX .wasm)

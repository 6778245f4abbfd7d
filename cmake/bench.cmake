# SPDX-License-Identifier: GPL-3.0-or-later

file(GLOB bench_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/native/bench/*.cpp")
if(bench_sources)
  add_executable(meander_bench ${bench_sources})
  target_link_libraries(meander_bench PRIVATE meander_core)
  set_target_properties(meander_bench PROPERTIES UNITY_BUILD ${MEANDER_UNITY} UNITY_BUILD_BATCH_SIZE 0)
  # It loads the library at run time, so the linker does not know that it needs the library.
  add_dependencies(meander_bench meander)
endif()

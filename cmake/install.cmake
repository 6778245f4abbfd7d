# SPDX-License-Identifier: GPL-3.0-or-later
#
# What `cmake --install` leaves for C and C++ programs: the headers, the library, a CMake package
# (find_package(Meander) gives Meander::meander) and meander.pc for pkg-config. The tree works
# wherever it is moved to.
#
# Installed, the library has the usual names: libmeander.so, and the ABI number in the one that
# programs keep. With the version in it, as the add-on needs it, a program would have to be linked
# again with every release.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

file(STRINGS "${PROJECT_SOURCE_DIR}/native/include/meander/meander.h" abi_line
  REGEX "^#define MEANDER_ABI_VERSION")
string(REGEX MATCH "[0-9]+" abi_version "${abi_line}")
if(NOT abi_version)
  message(FATAL_ERROR "no MEANDER_ABI_VERSION in meander.h: has it been renamed?")
endif()

add_library(meander_installed SHARED $<TARGET_OBJECTS:meander_core>)
set_target_properties(meander_installed PROPERTIES
  OUTPUT_NAME meander
  EXPORT_NAME meander
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${abi_version}"
  LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/installed"
  RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/installed"
  ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/installed"
  LINKER_LANGUAGE CXX
  LINK_DEPENDS "${PROJECT_SOURCE_DIR}/cmake/exports.map")
if(WIN32)
  set_target_properties(meander_installed PROPERTIES PREFIX "")
endif()
target_include_directories(meander_installed INTERFACE "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
target_link_libraries(meander_installed PRIVATE Threads::Threads meander_compile_options)
target_link_options(meander_installed PRIVATE "$<TARGET_PROPERTY:meander,LINK_OPTIONS>")

install(TARGETS meander_installed EXPORT MeanderTargets
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(FILES ${headers}
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/meander")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/THIRD_PARTY_NOTICES.md"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}")

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/Meander")
# It needs no other package, so what CMake writes about the target is all of its configuration.
install(EXPORT MeanderTargets FILE MeanderConfig.cmake NAMESPACE Meander:: DESTINATION "${package_dir}")
write_basic_package_version_file("${generated_dir}/MeanderConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion)
install(FILES "${generated_dir}/MeanderConfigVersion.cmake" DESTINATION "${package_dir}")

# Paths are relative to the file itself, unless somebody has asked for absolute ones.
file(RELATIVE_PATH prefix_from_pc "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
foreach(kind INCLUDEDIR LIBDIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${kind}}")
    set(pc_${kind} "${CMAKE_INSTALL_${kind}}")
  else()
    set(pc_${kind} "\${prefix}/${CMAKE_INSTALL_${kind}}")
  endif()
endforeach()
configure_file(cmake/meander.pc.in "${generated_dir}/meander.pc" @ONLY)
install(FILES "${generated_dir}/meander.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

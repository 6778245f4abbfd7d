# SPDX-License-Identifier: GPL-3.0-or-later
#
# The Python package as pip builds it from the sources (pyproject.toml): scikit-build-core packs the modules, and takes
# from here what is made by the build.

set(python_native_dir "meander/native/${meander_platform}")
install(TARGETS meander
  LIBRARY DESTINATION "${python_native_dir}" COMPONENT python
  RUNTIME DESTINATION "${python_native_dir}" COMPONENT python)
install(FILES "${PROJECT_SOURCE_DIR}/addon/meander/core.py" DESTINATION meander COMPONENT python)
install(FILES "${PROJECT_SOURCE_DIR}/addon/meander/binding/abi.py" DESTINATION meander/binding COMPONENT python)

# The record by which `binding` knows that the library is whole: its size and its digest, taken where it was put, since
# installing may change it.
install(CODE "
  set(library \"\${CMAKE_INSTALL_PREFIX}/${python_native_dir}/$<TARGET_FILE_NAME:meander>\")
  file(SIZE \"\${library}\" size)
  file(SHA256 \"\${library}\" digest)
  file(WRITE \"\${library}.record\" \"\${size} \${digest}\\n\")
  " COMPONENT python)

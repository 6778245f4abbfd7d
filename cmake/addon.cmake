# SPDX-License-Identifier: GPL-3.0-or-later
#
# The add-on's zip: sources, library and licences in one folder; the same contents give the same
# bytes.

set(addon_zip "${PROJECT_BINARY_DIR}/meander-${PROJECT_VERSION}.zip")

# Always run: it is quick, and a glob of the add-on's files as dependencies would go stale.
add_custom_target(addon
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/scripts/make_addon_zip.py"
          --addon "${PROJECT_SOURCE_DIR}/addon/meander"
          --version "${PROJECT_VERSION}"
          --native "${meander_platform}=$<TARGET_FILE:meander>"
          --licence "${PROJECT_SOURCE_DIR}/LICENSE"
          --licence "${PROJECT_SOURCE_DIR}/THIRD_PARTY_NOTICES.md"
          --pages "${PROJECT_SOURCE_DIR}/docs"
          --wheels "${PROJECT_SOURCE_DIR}/build/wheels"
          --output "${addon_zip}"
  DEPENDS meander abi
  COMMENT "Packing ${addon_zip}" VERBATIM)

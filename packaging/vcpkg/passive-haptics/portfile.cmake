# SPDX-License-Identifier: BSD-3-Clause
# An overlay port, which installs the checkout that it lies in:
#   vcpkg install passive-haptics --overlay-ports=packaging/vcpkg
# vcpkg keeps what it has built for as long as this folder stays the same: after a change of the headers
# add --no-binarycaching. In a registry of ports the sources would be a release's archive, by its checksum.
#
# The program vcpkg itself has not run it: docs/packages.md says what has. packaging/try_vcpkg.cmake runs
# it with stand-ins for vcpkg's functions.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)
set(VCPKG_BUILD_TYPE release)  # headers are the same for debug

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DPASSIVE_HAPTICS_BUILD_TESTS=OFF -DPASSIVE_HAPTICS_BUILD_BENCH=OFF
    -DPASSIVE_HAPTICS_BUILD_EXAMPLES=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME passive_haptics CONFIG_PATH share/cmake/passive_haptics)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/licenses")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")

# SPDX-License-Identifier: BSD-3-Clause
# Runs the port where vcpkg is not: each function of vcpkg's that it calls has a stand-in here, which does
# what vcpkg documents of it. Leaves the package in `scratch`/packages.
# root, scratch, Eigen3_DIR, CMAKE_CXX_COMPILER
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${scratch})
set(PORT passive-haptics)
set(CURRENT_PORT_DIR ${root}/packaging/vcpkg/${PORT})
set(CURRENT_PACKAGES_DIR ${scratch}/packages)

function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 given "" SOURCE_PATH OPTIONS)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${given_SOURCE_PATH} -B ${scratch}/build -G Ninja
    ${given_OPTIONS} -DCMAKE_INSTALL_PREFIX=${CURRENT_PACKAGES_DIR} -DEigen3_DIR=${Eigen3_DIR}
    -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(vcpkg_cmake_install)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${scratch}/build --target install OUTPUT_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Moves the package's files to share/NAME, one folder higher, and mends their way to the prefix.
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(PARSE_ARGV 0 given "" "PACKAGE_NAME;CONFIG_PATH" "")
  set(folder ${CURRENT_PACKAGES_DIR}/share/${given_PACKAGE_NAME})
  file(RENAME ${CURRENT_PACKAGES_DIR}/${given_CONFIG_PATH} ${folder})
  file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/share/cmake)
  file(GLOB files ${folder}/*.cmake)
  set(up "get_filename_component(_IMPORT_PREFIX \"\${_IMPORT_PREFIX}\" PATH)\n")
  foreach(file IN LISTS files)
    file(READ ${file} text)
    string(REPLACE "${up}${up}${up}" "${up}${up}" text "${text}")
    file(WRITE ${file} "${text}")
  endforeach()
endfunction()

function(vcpkg_fixup_pkgconfig)
  file(GLOB_RECURSE files ${CURRENT_PACKAGES_DIR}/*.pc)
  foreach(file IN LISTS files)
    file(READ ${file} text)
    file(WRITE ${file} "prefix=\${pcfiledir}/../..\n${text}")
  endforeach()
endfunction()

function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 given "" "" FILE_LIST)
  file(INSTALL ${given_FILE_LIST} DESTINATION ${CURRENT_PACKAGES_DIR}/share/${PORT} RENAME copyright)
endfunction()

include(${CURRENT_PORT_DIR}/portfile.cmake)

# What vcpkg asks of a package after it has been built.
file(GLOB_RECURSE files RELATIVE ${CURRENT_PACKAGES_DIR} ${CURRENT_PACKAGES_DIR}/*)
list(FILTER files EXCLUDE REGEX "^include/passive_haptics/.*[.]h(pp)?$")
list(SORT files)
set(expected share/passive-haptics/copyright share/passive-haptics/usage
  share/passive_haptics/passive_hapticsConfig.cmake
  share/passive_haptics/passive_hapticsConfigVersion.cmake
  share/passive_haptics/passive_hapticsTargets.cmake share/pkgconfig/passive_haptics.pc)
list(SORT expected)
if(NOT files STREQUAL expected)
  message(FATAL_ERROR "beside the headers the package has\n${files}\nand should have\n${expected}")
endif()
file(GLOB_RECURSE folders LIST_DIRECTORIES true ${CURRENT_PACKAGES_DIR}/*)
foreach(folder IN LISTS folders)
  file(GLOB inside ${folder}/*)
  if(IS_DIRECTORY ${folder} AND NOT inside)
    message(FATAL_ERROR "an empty folder, which vcpkg refuses: ${folder}")
  endif()
endforeach()
file(GLOB_RECURSE texts ${CURRENT_PACKAGES_DIR}/share/*)
foreach(file IN LISTS texts)
  file(READ ${file} text)
  string(FIND "${text}" "${scratch}" at)
  if(NOT at EQUAL -1)
    message(FATAL_ERROR "a path of the machine that built it, which vcpkg refuses: ${file}")
  endif()
endforeach()

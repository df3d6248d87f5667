# SPDX-License-Identifier: BSD-3-Clause
# Tests that build a project of this folder and run it, each in a folder of its own name in consumers/,
# which a fixture is to remove before.

# passive_haptics_consumer(test project fixtures options...)
function(passive_haptics_consumer test project fixtures)
  add_test(NAME ${test}
    COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test
      ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${project} ${CMAKE_CURRENT_BINARY_DIR}/consumers/${test}
      --build-generator ${CMAKE_GENERATOR} --build-makeprogram ${CMAKE_MAKE_PROGRAM}
      --build-options ${ARGN}
        -DCMAKE_BUILD_TYPE=$<CONFIG>
        -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
        "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
        -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
        -DEigen3_DIR=${Eigen3_DIR}
      --test-command consumer)
  set_tests_properties(${test} PROPERTIES FIXTURES_REQUIRED "${fixtures}" LABELS consumer TIMEOUT 300)
endfunction()

# passive_haptics_installed_consumers(tests fixtures prefix ways...): what is installed there, found in
# these ways, find_package and pkg_config; the second where pkg-config is and knows Eigen.
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(EIGEN_PC QUIET eigen3)
endif()
function(passive_haptics_installed_consumers tests fixtures prefix)
  list(JOIN companion_rooms "," names)
  foreach(way IN LISTS ARGN)
    if(way STREQUAL "find_package" OR EIGEN_PC_FOUND)
      passive_haptics_consumer(${tests}.${way} ${way} "${fixtures}"
        -Dcompanions=${names} -Dpassive_haptics_ROOT=${prefix} -Dversion=${PROJECT_VERSION} -Dprefix=${prefix})
    endif()
  endforeach()
endfunction()

# SPDX-License-Identifier: BSD-3-Clause
# Configures the project where something optional is not installed: it must work, and say one sentence
# that names what is missing. root, scratch, options (of every configuration)
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${scratch})

# run(what command...): must end well; leaves what was printed in `said`.
function(run what)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
  if(NOT code STREQUAL "0")
    message(FATAL_ERROR "${what}: ended with ${code}\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

# configure(name sentence missing...): without the packages `missing`; `sentence` is all it may say.
function(configure name sentence)
  list(TRANSFORM ARGN PREPEND -DCMAKE_DISABLE_FIND_PACKAGE_ OUTPUT_VARIABLE disabled)
  list(TRANSFORM disabled APPEND =ON)
  run(${name} ${CMAKE_COMMAND} -S ${root} -B ${scratch}/${name} -G Ninja ${options} ${disabled})
  string(REGEX REPLACE "[ \n]+" " " said "${said}")  # CMake breaks lines
  string(REGEX MATCHALL "passive_haptics: " sentences "${said}")
  list(LENGTH sentences count)
  if(sentence)
    string(FIND "${said}" "${sentence}" at)
    if(at EQUAL -1 OR NOT count EQUAL 1)
      message(FATAL_ERROR "${name} says ${count} sentences, and not once \"${sentence}\":\n${said}")
    endif()
  elseif(count GREATER 0)
    message(FATAL_ERROR "${name} has something to say:\n${said}")
  endif()
  run(${name} ${CMAKE_COMMAND} --build ${scratch}/${name} --target help)
  set(targets "${said}" PARENT_SCOPE)
endfunction()

# has(yes|no target...): are these among `targets`?
function(has expected)
  foreach(target IN LISTS ARGN)
    set(found no)
    if(targets MATCHES "(^|\n)${target}:")
      set(found yes)
    endif()
    if(NOT found STREQUAL expected)
      message(FATAL_ERROR "is ${target} among the targets? ${found}, and it should be: ${expected}")
    endif()
  endforeach()
endfunction()

configure(everything "")  # the control
has(yes core_tests example_01_virtual_wall example_08_no_eigen controllers)

# Without Ninja: the generator that CMake takes by itself builds and installs, too.
find_program(make NAMES make gmake)
if(make)
  run(without_ninja ${CMAKE_COMMAND} -S ${root} -B ${scratch}/without_ninja -G "Unix Makefiles" ${options}
    -DPASSIVE_HAPTICS_BUILD_TESTS=OFF -DPASSIVE_HAPTICS_BUILD_BENCH=OFF)
  run(without_ninja ${CMAKE_COMMAND} --build ${scratch}/without_ninja --target example_08_no_eigen)
  run(without_ninja ${CMAKE_COMMAND} --build ${scratch}/without_ninja --target help)
  if(NOT said MATCHES "example_01_virtual_wall")
    message(FATAL_ERROR "without Ninja there is no example:\n${said}")
  endif()
endif()

configure(no_catch2 "passive_haptics: Catch2 was not found (Debian: catch2), so the tests are off" Catch2)
has(yes example_01_virtual_wall example_08_no_eigen controllers)
has(no core_tests)

configure(no_boost "" Boost)
has(no report)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${scratch}/no_boost --target run_report
  OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
if(code STREQUAL "0" OR NOT said MATCHES "install libboost-dev")
  message(FATAL_ERROR "without Boost run_report ends with ${code} and says\n${said}")
endif()

# Tools that are there by name and do not work are as good as none.
set(names g++ clang++ clang++-20 clang++-21 clang++-22 gappa umockdev-wrapper arm-none-eabi-g++ coqc)
foreach(name IN LISTS names)
  file(WRITE ${scratch}/bin/${name} "#!/bin/sh\nexit 1\n")
  file(CHMOD ${scratch}/bin/${name} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endforeach()
set(ENV{PATH} "${scratch}/bin:$ENV{PATH}")
set(options ${options} -DPASSIVE_HAPTICS_TESTS=full)
configure(broken_tools "")
set(skipped nonblocking falcon_firmware usb.skipped "gappa proves the strict bound in binary32"
  "coq proves the ledgers")
foreach(name IN LISTS skipped)
  run(${name} ${CMAKE_CTEST_COMMAND} --test-dir ${scratch}/broken_tools -R "^${name}$")
  if(NOT said MATCHES "Skipped")
    message(FATAL_ERROR "${name} is not skipped where its tool does not work:\n${said}")
  endif()
endforeach()

configure(no_eigen "passive_haptics: Eigen was not found (Debian: libeigen3-dev), so there is one degree of \
freedom" Eigen3)
has(yes example_08_no_eigen)
has(no core_tests example_01_virtual_wall controllers)
run(no_eigen ${CMAKE_COMMAND} --build ${scratch}/no_eigen)
run(no_eigen ${CMAKE_COMMAND} --install ${scratch}/no_eigen --prefix ${scratch}/prefix)
file(WRITE ${scratch}/consumer/CMakeLists.txt "cmake_minimum_required(VERSION 3.24)
project(consumer LANGUAGES CXX)
find_package(passive_haptics REQUIRED)
add_executable(knob ${root}/examples/08_no_eigen.cpp)
target_link_libraries(knob PRIVATE passive_haptics::passive_haptics)\n")
run(consumer ${CMAKE_COMMAND} -S ${scratch}/consumer -B ${scratch}/consumer/build -G Ninja ${options}
  -DCMAKE_PREFIX_PATH=${scratch}/prefix -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON)
run(consumer ${CMAKE_COMMAND} --build ${scratch}/consumer/build)
run(consumer ${scratch}/consumer/build/knob)

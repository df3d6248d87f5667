# SPDX-License-Identifier: BSD-3-Clause
# Unpacks into `unpacked` what lies in `folder`: the installed tree under its own name, the Debian package
# in debian/, and in from_source/ what the source archive installs by itself.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${unpacked})
file(GLOB archives ${folder}/*.tar.gz)
foreach(archive IN LISTS archives)
  file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${unpacked})
endforeach()
file(GLOB package ${folder}/*.deb)
file(GLOB sources ${unpacked}/*/CMakeLists.txt)
cmake_path(GET sources PARENT_PATH sources)
foreach(command IN ITEMS
    "dpkg-deb;--extract;${package};${unpacked}/debian"
    "${CMAKE_COMMAND};-S;${sources};--preset;install"
    "${CMAKE_COMMAND};--install;${sources}/build/install;--prefix;${unpacked}/from_source")
  execute_process(COMMAND ${command} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()

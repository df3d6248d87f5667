# SPDX-License-Identifier: BSD-3-Clause
"""The Conan 2 package: `conan create conan -s compiler.cppstd=20`.

It needs C++20 and says so; a profile that states less (gnu17 is a usual default) is refused with that
sentence, so state it in yours or on the line.
"""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir


class PassiveHaptics(ConanFile):
    name = "passive_haptics"
    description = "Passivity controllers for haptic interaction"
    license = "BSD-3-Clause"
    topics = ("haptics", "passivity", "control", "robotics", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    def set_version(self):
        header = os.path.join("..", "include", "passive_haptics", "version.hpp")
        text = load(self, os.path.join(self.recipe_folder, header))
        numbers = re.findall(r"version_(?:major|minor|patch) = (\d+)", text)
        self.version = ".".join(numbers)

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "include/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        self.folders.root = ".."
        cmake_layout(self)

    def requirements(self):
        # The oldest Eigen that is tested, and the newest series known to serve.
        self.requires("eigen/[>=3.4 <6]", transitive_headers=True)

    def validate(self):
        check_min_cppstd(self, 20)

    def package_id(self):
        self.info.clear()

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False  # nothing is written beside the sources
        for room in ("TESTS", "BENCH", "EXAMPLES"):
            toolchain.cache_variables[f"PASSIVE_HAPTICS_BUILD_{room}"] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        rmdir(self, os.path.join(self.package_folder, "share"))  # CMakeDeps writes its own

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "passive_haptics")
        self.cpp_info.set_property("cmake_target_name", "passive_haptics::passive_haptics")

# SPDX-License-Identifier: BSD-3-Clause
"""The Conan 2 package: `conan create conan`.

Headers alone, so it is made under any profile; a usual one states gnu17. Who includes them compiles as
C++20, as test_package does; the first header says so if not.
"""

import os
import re

from conan import ConanFile
from conan.tools.build import valid_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir


# The companions above the core, and what of each other they bring along: CMakeLists.txt has the same.
COMPANIONS = {"knob": [], "compliant": [], "published": [], "mesh": ["compliant"], "environment": ["mesh"], "simulation": [],
              "two_port": [], "remote": [], "runner": [], "identification": [], "falcon": ["runner"],
              "adapters": ["identification"],
              "identification": ["knob"]}


class PassiveHaptics(ConanFile):
    name = "passive_haptics"
    description = "Passivity controllers for haptic interaction"
    license = "BSD-3-Clause"
    topics = ("haptics", "passivity", "control", "robotics", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    def set_version(self):
        header = os.path.join("..", "include", "passive_haptics", "base", "version.hpp")
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
        if self.settings.get_safe("compiler.cppstd") and not valid_min_cppstd(self, 20):
            self.output.warning("passive_haptics needs C++20 and the profile states less: say "
                                "target_compile_features(... cxx_std_20), or -s compiler.cppstd=20")

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
        self.cpp_info.set_property("cmake_file_name", "passive_haptics")
        self.cpp_info.set_property("cmake_target_name", "passive_haptics::all")
        self._component("core", "passive_haptics::passive_haptics", ["eigen::eigen"])
        for room, others in COMPANIONS.items():
            self._component(room, f"passive_haptics::{room}", ["core", *others])
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.components["runner"].system_libs = ["pthread"]

    def _component(self, name, target, requires):
        component = self.cpp_info.components[name]
        component.set_property("cmake_target_name", target)
        component.requires = requires
        component.bindirs = component.libdirs = []

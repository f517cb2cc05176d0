"""libaureole for Conan 2: `conan create packaging/conan`, from this tree. The renderer's dependencies are the system's own."""

import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load


class AureoleConan(ConanFile):
    name = "aureole"
    license = "Apache-2.0"
    description = "Quasi-Monte Carlo points, quality measures and quadrature weights on the square and the sphere"
    topics = ("quasi-monte-carlo", "quadrature", "sphere", "rendering")
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": True, "fPIC": True}

    def set_version(self):
        text = load(self, os.path.join(self.recipe_folder, "..", "..", "include", "aureole", "version.h"))
        self.version = ".".join(re.findall(r"#define AUREOLE_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text))

    def export_sources(self):
        tree = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "data/*", "include/*", "src/*"):
            copy(self, pattern, tree, self.export_sources_folder)

    def configure(self):
        self.settings.rm_safe("compiler.libcxx")
        self.settings.rm_safe("compiler.cppstd")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for name in ("AUREOLE_RENDER", "AUREOLE_PROGRAM", "AUREOLE_TESTS", "AUREOLE_PYTHON"):
            toolchain.cache_variables[name] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.libs = ["aureole"]
        self.cpp_info.set_property("cmake_file_name", "aureole")
        self.cpp_info.set_property("cmake_target_name", "Aureole::aureole")
        if not self.options.shared:
            self.cpp_info.system_libs = ["m", "dl", "pthread"]

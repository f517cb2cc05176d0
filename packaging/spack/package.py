from spack.package import *


class Aureole(CMakePackage):
    """Quasi-Monte Carlo points, quality measures and quadrature weights on the square and the sphere, and a renderer."""

    license("Apache-2.0")

    # Of a release, url and version(..., sha256=...) go here; until then `spack develop` takes a copy of the tree.
    version("0.2.0")

    variant("render", default=False, description="the renderer and the program")
    variant("lighting", default=True, when="+render", description="irradiance, daylight and view factors")
    variant("mpi", default=False, when="+render", description="work shared between processes")
    variant("shared", default=True, description="shared libraries")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    with when("+render"):
        depends_on("pkgconfig", type="build")
        depends_on("embree@3.13:4")
        depends_on("openexr@3:")
        depends_on("libpng@1.6:")
        depends_on("stb")
        depends_on("expat")
        depends_on("libmicrohttpd@0.9.73:")
        depends_on("zlib-api")
        depends_on("lapack")
    depends_on("mpi", when="+mpi")

    def cmake_args(self):
        return [
            self.define("AUREOLE_TESTS", False),
            self.define("AUREOLE_PYTHON", False),
            self.define("AUREOLE_ASSIMP", False),
            self.define_from_variant("AUREOLE_RENDER", "render"),
            self.define_from_variant("AUREOLE_LIGHTING", "lighting"),
            self.define_from_variant("AUREOLE_MPI", "mpi"),
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
        ]

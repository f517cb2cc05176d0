"""Makes the bridge between Python and the C libraries from their public headers, by cffi.

declare.py native INCLUDE OUT.c   the extension's source: libaureole's functions, types and constants, which the compiler checks
declare.py library INCLUDE OUT.py the same of libaureole-render, -lighting and -lab, for the library to be opened at run time

Nothing is declared by hand: a function that a header gains is there after the next build.
"""

import pathlib
import re
import sys

import cffi

NATIVE = [f"aureole/{name}.h" for name in
          "core text tables pointset sphere rotations symmetry nearest statistics quadrature quality exact estimate integrate".split()]
LIBRARY = ["aureole/core.h", "aureole/tables.h", "aureole-render/image.h", "aureole-render/scene.h", "aureole-render/film.h",
           "aureole-render/render.h", "aureole-render/adaptive.h", "aureole-lighting/view_factors.h", "aureole-lighting/irradiance.h",
           "aureole-lighting/daylight.h", "aureole/pointset.h", "aureole-lab/plot.h", "aureole-lab/lab.h"]

# What the libraries call, which cffi writes as C functions that call Python.
CALLBACKS = """
int aureole_progress(void *user, const char *what, uint64_t done, uint64_t total);
void aureole_warning(void *user, const char *message);
aur_result aureole_integrand(void *user, size_t count, const double *points, const double *along, double *values,
                             aur_error *error);
aur_result aureole_functional(void *user, const aur_estimate_points *points, double *values, aur_error *error);
aur_result aureole_set(void *user, uint64_t count, size_t dimension, double *points, double *weights, aur_error *error);
aur_result aureole_density(void *user, size_t count, const double *directions, double *values, aur_error *error);
"""


def declarations(header, compiled):
    """What cffi is to know of one header: its text without comments and the preprocessor's lines.

    `compiled`: static inline functions and numbers of #define are declared too, for the compiler to fill in.
    """
    text = re.sub(r"/\*.*?\*/", " ", header, flags=re.S).replace("\\\n", " ")
    numbers = re.findall(r"^#define (AUR_\w+) +([0-9][0-9.eE+-]*|SIZE_MAX)$", text, flags=re.M)
    text = re.sub(r"^#ifdef __cplusplus.*?^#endif", "", text, flags=re.S | re.M)
    text = re.sub(r"^#.*$", "", text, flags=re.M)
    text = re.sub(r"\bAUR_(NONNULL|PRINTF)\([^)]*\)", "", text)
    text = re.sub(r"\b(AUR_API|AUR_EXPERIMENTAL)\b", "", text)
    text = re.sub(r"static inline ([^{;]*)\{.*?^\}", r"\1;" if compiled else "", text, flags=re.S | re.M)
    text = re.sub(r"[^;]*\bva_list\b[^;]*;", "", text)
    if compiled:
        for name, value in numbers:
            text += f"\nstatic const {'double' if re.search('[.e]', value) else 'size_t'} {name};\n"
    return re.sub(r"\n\s*\n+", "\n", text)


def main():
    kind, include, out = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    native = kind == "native"
    names = NATIVE if native else LIBRARY
    ffi = cffi.FFI()
    if not native:
        ffi.cdef("typedef struct aur_gather_integrator aur_gather_integrator;")  # integrators of the caller's are for C
    for name in names:
        ffi.cdef(declarations((include / name).read_text(), native))
    if native:
        native = pathlib.Path(__file__).with_name("native.c").read_text()
        ffi.cdef('extern "Python" {' + CALLBACKS + "}")
        ffi.cdef(declarations(native, True))
        ffi.set_source("aureole._native", "".join(f"#include <{name}>\n" for name in names) + native)
        ffi.emit_c_code(out)
    else:
        ffi.set_source("aureole._library", None)
        ffi.emit_python_code(out)


if __name__ == "__main__":
    main()

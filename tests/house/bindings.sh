#!/usr/bin/env bash
# Bindings lose nothing: cffi reads every public header without a compiler and finds all functions in the libraries; its structs have
# the compiler's sizes, as by bindgen where it is; and inline functions and macros, which a binding cannot call, are those that are known here.
set -u
build=$(dirname "$1")
source_tree=$2
[ -e "$build/libaureole-lighting.so" ] || { echo "skipped: the libraries are static, or not all are built"; exit 77; }
grep -q '^AUREOLE_SANITIZE:[^=]*=.' "$build/CMakeCache.txt" && { echo "skipped: the release build is asked"; exit 77; }
python3 -c 'import cffi' 2>/dev/null || { echo "skipped: there is no cffi (Debian: python3-cffi)"; exit 77; }
bash "$source_tree/cmake/symbols.sh" "$source_tree"/include/aureole*/*.h >functions.txt
cat >read.py <<'END'
import pathlib, re, subprocess, sys

source, build = map(pathlib.Path, sys.argv[1:])
sys.path.insert(0, str(source / "python"))
sys.dont_write_bytecode = True
import cffi, declare

ordered, texts = [], {}
def visit(name):  # a header after those that it includes
    if name in texts:
        return
    texts[name] = (source / "include" / name).read_text()
    for other in re.findall(r"^#include <(aureole[^>]*\.h)>", texts[name], flags=re.M):
        visit(other)
    ordered.append(name)
for path in sorted((source / "include").glob("aureole*/*.h")):
    visit(str(path.relative_to(source / "include")))

lost, ffi = [], cffi.FFI()
for name in ordered:
    ffi.cdef(declare.declarations(texts[name], False))
library = ffi.dlopen(str(build / "libaureole-lab.so"))
public = pathlib.Path("functions.txt").read_text().split()
for function in public:
    if not hasattr(library, function):
        lost.append(f"cffi does not find {function}")

whole = "\n".join(re.sub(r"/\*.*?\*/", " ", texts[name], flags=re.S).replace("\\\n", " ") for name in ordered)
structs = re.findall(r"^typedef struct (aur_\w+) \{", whole, flags=re.M)
program = "".join(f"#include <{name}>\n" for name in ordered) + "#include <stdio.h>\nint main(void) {\n"
program += "".join(f'    printf("{name} %zu\\n", sizeof({name}));\n' for name in structs) + "    return 0;\n}\n"
pathlib.Path("sizes.c").write_text(program)
subprocess.run(["cc", "-std=c17", "-I", source / "include", "sizes.c", "-o", "sizes"], check=True)
for line in subprocess.run(["./sizes"], check=True, capture_output=True, text=True).stdout.splitlines():
    name, size = line.split()
    if ffi.sizeof(name) != int(size):
        lost.append(f"{name} has {size} bytes, and {ffi.sizeof(name)} by cffi")

# A struct that may grow begins with its size; these never do, as core.h says: callbacks, rows of tables and what they are made of,
# small values, reports and results that come in arrays, and where callers write.
fixed = """error progress warnings output strategy z_grid lobe rotation fibonacci_set moments estimate_points estimated exact_report
    weights_report integrate_peak set_description measure_description rank_description key row table json weather_hour weather_note
    daylight irradiance error_figures gather_settings gather_directions gather_common gather_shading_point gather_method radiosity_triangle_result definition
    scene_luminaire scene_placement scene_sky scene_stage point_group"""
sizeless = {name for name, first in re.findall(r"^typedef struct (aur_\w+) \{\s*([^;]*);", whole, flags=re.M) if first != "size_t size"}
if sizeless != {"aur_" + name for name in fixed.split()}:
    lost.append(f"structs without a size in front: {sizeless ^ {'aur_' + name for name in fixed.split()}}")

inline = re.findall(r"^static inline [^;{]*?\b(aur_\w+)\(", whole, flags=re.M)
macros = re.findall(r"^#define (AUR_\w+)(?! +[0-9][0-9.eE+-]*$)(?! +SIZE_MAX$)\b(?=.)", whole, flags=re.M)
if set(inline) != {"aur_points_view_of"}:
    lost.append(f"inline functions, which bindings cannot call: {inline}")
if set(macros) - {"AUR_API", "AUR_EXPERIMENTAL", "AUR_NONNULL", "AUR_PRINTF"}:
    lost.append(f"macros that are no numbers: {set(macros)}")
for function, rest in re.findall(r"\b(aur_\w+)\([^;]*?size_t capacity, ([^,;]*)", whole):
    if "*" not in rest and function != "aur_format":  # as snprintf
        lost.append(f"{function}: a capacity that does not stand before its array")
if len(public) < 200 or len(structs) < 50:
    lost.append(f"only {len(public)} functions and {len(structs)} structs were read")
print(len(ordered), "headers,", len(public), "functions,", len(structs), "structs")
print("\n".join(lost))
sys.exit(bool(lost))
END
python3 read.py "$source_tree" "$build" || exit 1

# bindgen finds the same functions, and its structs have the places that the compiler gives them.
if bindgen --version >/dev/null 2>&1 && rustc --version >/dev/null 2>&1; then
  (cd "$source_tree/include" && printf '#include <%s>\n' aureole*/*.h) >all.h
  bindgen all.h --allowlist-function '(aur|lab)_.*' --allowlist-type '(aur|lab|report)_.*' -o bindings.rs -- -I "$source_tree/include" || exit 1
  sed -n 's/.*pub fn \(\(aur\|lab\)_[a-z0-9_]*\).*/\1/p' bindings.rs | sort -u | diff - <(sort -u functions.txt) || { echo "bindgen does not find these"; exit 1; }
  rustc --test -A warnings bindings.rs -L "$build" -l aureole-lighting -o bindings || exit 1
  LD_LIBRARY_PATH=$build ./bindings --quiet >tests.txt || { cat tests.txt; exit 1; }
  sed -n 's/^test result: ok. \([0-9]* passed\).*/bindgen: tests of layouts: \1/p' tests.txt
fi

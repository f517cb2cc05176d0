#!/usr/bin/env bash
# Images, view factors and irradiance from Python: the bits that the program writes.
set -u
. "$2/tests/python/python.sh.inc"
library=$build/libaureole-lighting.so
[ -e "$library" ] || { echo "skipped: the libraries are static"; exit 77; }
AUREOLE_RENDER_LIBRARY=$library "${python[@]}" -W error "$source_tree/tests/python/render.py" "$1" "$source_tree" || exit 1

# Without the library the rest works, and the error says what was tried.
AUREOLE_RENDER_LIBRARY=./none.so "${python[@]}" - <<'PYTHON'
import aureole
assert len(aureole.points("sobol", 4)) == 4
try:
    aureole.render("scene.xml")
except ImportError as error:
    assert "AUREOLE_RENDER_LIBRARY" in str(error) and "./none.so" in str(error), error
    assert "./python/render" in str(error) and "install aureole" not in str(error), error  # a name that a registry does not have
else:
    raise SystemExit("no error")
PYTHON

# By the renderer alone there are images, and the error names the library that light needs.
AUREOLE_RENDER_LIBRARY=$build/libaureole-render.so "${python[@]}" - "$source_tree" <<'PYTHON' || exit 1
import sys
import aureole
assert aureole.render(sys.argv[1] + "/scenes/cornell-box/cornell-box.xml", width=4, spp=1).shape == (4, 4, 3)
try:
    aureole.viewfactors("room.obj")
except ImportError as error:
    assert "libaureole-lighting" in str(error), error
else:
    raise SystemExit("no error")
PYTHON

# What the wheel aureole-render holds is found beside the package, without a variable.
cmake --install "$build" --prefix "$PWD/wheel" --component python-render >install.log || { cat install.log; exit 1; }
PYTHONPATH=$PYTHONPATH:$PWD/wheel "${python[@]}" - "$PWD/wheel/aureole_render/" "$source_tree" <<'PYTHON'
import sys
import aureole
library = aureole.render_library()
assert library.startswith(sys.argv[1]), library
assert aureole.render(sys.argv[2] + "/scenes/cornell-box/cornell-box.xml", width=4, spp=1).shape == (4, 4, 3)
PYTHON

#!/usr/bin/env bash
# The programs of examples/python are short, and say what they should; the one for Mitsuba where there is a Mitsuba.
set -u
. "$2/tests/python/python.sh.inc"
fail() { echo "$*"; exit 1; }
for file in "$source_tree"/examples/python/*.py; do
  [ "$(wc -l <"$file")" -lt 100 ] || fail "$(basename "$file"): 100 lines or more"
done

# Files in the forms of pbrt's tables and of OpenQMC's tool, with points that are known: a diagonal, whose least distance is
# sqrt(2)/64, and Aureole's own Sobol points.
"${python[@]}" - <<'PYTHON'
import aureole
with open("tables.cpp", "w") as file:
    print("const uint32_t pmj02bnSamples[nPMJ02bnSets][nPMJ02bnSamples][2] = {", file=file)
    for offset in (0, 2**25):
        rows = ", ".join("{ 0x%08x, %d }" % (i * 2**26 + offset, i * 2**26 + offset) for i in range(64))
        print("{", rows, "},", file=file)
    print("};", file=file)
with open("openqmc.csv", "w") as file:
    for row in list(aureole.points("sobol", 256, dimension=8, domain="cube")) * 2:
        print(",".join(f"{number:f}" for number in row), file=file)
aureole.write("own.csv", aureole.points("bnot", 64))
PYTHON
"${python[@]}" "$source_tree/examples/python/other_points.py" tables.cpp openqmc.csv own.csv >other.txt || fail "other_points.py failed"
"${python[@]}" - <<'PYTHON' || fail "$(cat other.txt)"
import aureole
lines = [line.replace(", set ", ",set").split() for line in open("other.txt")][1:]
found = {(name, int(count)): (float(star), float(distance)) for name, count, star, distance in lines}
for index in (0, 1):
    assert abs(found[f"tables.cpp,set{index}", 64][1] - 2**0.5 / 64) < 1e-6
    star = aureole.measure(aureole.points("sobol", 256), "l2-star")
    assert abs(found[f"openqmc.csv,set{index}", 256][0] - star) < 1e-5  # six digits
assert found["own.csv,set0", 64] == found["bnot", 64]
PYTHON

if "${python[@]}" -c "import mitsuba" 2>/dev/null; then
  "${python[@]}" "$source_tree/examples/python/mitsuba_sky.py" 16 >sky.txt || fail "mitsuba_sky.py failed"
  awk '/^  random/ { random = $2 } /^  even  / { if ($2 > random / 2) bad = 1 } END { exit bad || NR != 8 }' sky.txt || fail "$(cat sky.txt)"
fi
exit 0

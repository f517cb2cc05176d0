#!/usr/bin/env bash
# aureole-scenes: the same bytes each time, whole files or none, and what the bundled scenes say when a mesh is missing.
set -u
aureole=$1
source=$2
scenes=$(dirname "$1")/aureole-scenes
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

rm -rf one two cut copy
# The same bytes twice, whatever the number of threads, and a file that is there is left alone.
OMP_NUM_THREADS=1 "$scenes" --folder one cups.ply plate.ply >/dev/null || fail "making two meshes"
OMP_NUM_THREADS=3 "$scenes" --folder two cups.ply plate.ply >/dev/null || fail "making them again"
cmp one/cups.ply two/cups.ply && cmp one/plate.ply two/plate.ply || fail "two runs differ"
"$scenes" --folder one cups.ply | grep -q 'cups.ply: is there' || fail "a mesh is made twice"

# What the program makes is a mesh without a hole: every edge has a face on either side (the plate is closed).
cat >view.xml <<'XML'
<scene version="3.0.0"><sensor type="perspective"/><shape type="ply"><string name="filename" value="one/plate.ply"/></shape></scene>
XML
"$aureole" info view.xml --format csv >info.csv || fail "the plate does not load"
faces=$(sed -n '/^end_header/q; s/^element face //p' one/plate.ply)
vertices=$(sed -n '/^end_header/q; s/^element vertex //p' one/plate.ply)
tail -c $((13 * faces)) one/plate.ply | od -An -v -w13 -tu1 | awk -v vertices="$vertices" -v faces="$faces" '
  { for (k = 0; k < 3; ++k) c[k] = $(4 * k + 2) + 256 * ($(4 * k + 3) + 256 * ($(4 * k + 4) + 256 * $(4 * k + 5)))
    for (k = 0; k < 3; ++k) { edge = c[k] " " c[(k + 1) % 3]; if (edge in seen || $1 != 3) bad = 1; seen[edge] = 1; ++edges } }
  END { for (edge in seen) { split(edge, end, " "); if (!(end[2] " " end[1] in seen)) bad = 1 }
        exit bad || NR != faces || vertices - edges / 2 + faces != 2 }' ||
  fail "the plate is not the closed surface of one body"

# Killed while it works it leaves no mesh, and the next run makes it.
"$scenes" --folder cut statue.ply >/dev/null &
sleep 0.3
kill -9 $! && wait $! 2>/dev/null
[ ! -e cut/statue.ply ] || fail "a mesh of a killed run"
# A disk that is full: nothing under the mesh's name, and the message names it.
(ulimit -f 64; trap '' XFSZ; "$scenes" --folder cut plate.ply >/dev/null 2>message) && fail "a full disk goes unnoticed"
grep -q 'cut/plate.ply' message || fail "$(cat message)"
[ -z "$(ls -A cut)" ] || fail "left behind: $(ls -A cut)"
"$scenes" --folder cut plate.ply >/dev/null && cmp cut/plate.ply one/plate.ply || fail "the run after that"

# A scene without its mesh names the command, and that exists.
mkdir -p copy/generated
cp -r "$source/scenes/plates" copy/
cp "$source/scenes/generated/HOW-TO-MAKE" copy/generated/
"$aureole" info copy/plates/plates.xml >/dev/null 2>message && fail "a scene loads without its mesh"
command=$(cat "$source/scenes/generated/HOW-TO-MAKE")
grep -q "plates.xml:[0-9]*:[0-9]*: cannot find '../generated/plate.ply'; it is made by the command: $command" message ||
  fail "$(cat message)"
[ -x "$source/$command" ] || fail "$command is no program"
cp one/plate.ply copy/generated/
"$aureole" info copy/plates/plates.xml >/dev/null || fail "the scene does not load with its mesh"

# A user's own environment, by a name from where the user is.
cp -r "$source/scenes/sphere" copy/
"$scenes" --folder copy/generated seeds.ply >/dev/null || fail "making the seeds"
"$aureole" render view.xml -q --width 8 --height 4 --spp 1 -o mine.hdr || fail "making an image"
"$aureole" info copy/sphere/sphere.xml -D environment=mine.hdr >/dev/null || fail "an environment of the user's"
"$aureole" info copy/sphere/sphere.xml -D environment=none.hdr >/dev/null 2>message && fail "an environment that is not there"
grep -q "cannot find 'none.hdr'" message || fail "$(cat message)"

"$scenes" --folder one no-such.ply 2>message && fail "an unknown file"
grep -q "no-such.ply" message && grep -q "hare.ply" message || fail "$(cat message)"
exit $((failures > 0))

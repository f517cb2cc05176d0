#!/usr/bin/env bash
# Line coverage of the parsers, as a table: by the seeds of the harnesses and fuzz/corpus alone, and with the mutations of
# them that the tests replay, always the same: scripts/coverage.sh [BUILD]. The parsers are compiled again with gcc's
# --coverage and linked before the rest of a finished BUILD (build/release), which takes seconds. MISSED=1 lists the lines
# that nothing reaches. FRESH=1 makes no table but copies to fuzz/corpus what scripts/fuzz.sh has found wherever it
# reaches code of a parser that the corpus does not reach: small inputs first. Exit status 1 where a parser has less than
# 90 % by the corpus alone. Lines that tell of a lack of memory, which no input makes, are counted, and said beside
# the others, not left out.
set -euo pipefail
cd "$(dirname "$0")/.."
top=$PWD
build=$(realpath "${1:-build/release}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# A parser, its harnesses, and its files.
parsers=(
  'scenes (XML)|scene|src/render/scene/importers/xml/*.c src/render/scene/load/*.c'
  'OBJ, PLY, STL, OFF|mesh_file mesh|src/render/scene/importers/meshes/*.c'
  'mesh files of shapes, serialized|mesh|src/render/scene/shapes/mesh_file.c src/render/scene/shapes/mesh_formats.c src/render/scene/shapes/serialized.c'
  'curves|scene mesh|src/render/scene/shapes/curves.c'
  'models by assimp|model|src/render/scene/importers/model/import.c src/render/scene/importers/model/child.c'
  'Radiance scenes|rad scene|src/render/scene/importers/rad/*.c'
  'pictures|image|src/render/image/exr_read.c src/render/image/hdr.c src/render/image/ldr.c src/render/image/pfm.c src/render/image/png.c'
  'volumes (vol)|volume scene|src/render/scene/volumes/gridvolume.c'
  'points|points|src/points/pointset/files/points_csv.c src/points/pointset/files/points_file.c src/points/pointset/files/points_npy.c'
  'generator matrices|matrices|src/points/pointset/generators/matrices.c'
  'films, checkpoints, parts|film checkpoint|src/render/film/film_file.c src/render/film/checkpoint.c src/render/driver/checkpoint.c src/render/driver/parts.c'
  'radiosity solutions|radiosity|src/render/radiosity/file.c'
  'photon maps of the cache|photons|src/render/photons/irradiance_file.c'
  'weight tables|weight_table|src/points/quadrature/tables/weight_table_file.c'
  'sensors|sensors|src/lighting/irradiance/sensors_read.c src/lighting/irradiance/sensors_mesh.c src/lighting/viewfactors/mesh_sources.c'
  'weather (EPW)|weather|src/lighting/daylight/weather.c'
  'names of sets and keys|set scene options|src/points/base/parameters.c src/points/base/names.c'
  'options of the program|options|src/program/cli/options.c src/program/cli/quantity.c'
)

# compile FILE OBJECT: by the command of the build, with coverage.
compile() {
  python3 - "$build" "$top/$1" "$2" "$flags" <<'P'
import json, shlex, subprocess, sys
build, source, target, flags = sys.argv[1:]
entry = next(e for e in json.load(open(build + "/compile_commands.json")) if e["file"] == source)
words = shlex.split(entry["command"])
words[words.index("-o") + 1] = target
drop = {"-MD", "-O2", "-O3", "-g", "-DNDEBUG"}
words = [w for w in words if w not in drop] + ["-O0", "-DNDEBUG"] + flags.split()
for flag in ("-MT", "-MF"):
    if flag in words:
        at = words.index(flag)
        del words[at:at + 2]
subprocess.run(words, cwd=entry["directory"], check=True)
P
}

# link HARNESS OBJECT...: the harness of the build with these objects first: the archive's are not asked for then.
link() {
  local name=$1 words object
  shift
  words=$(ninja -C "$build" -t commands "fuzz/fuzz_$name" | tail -1)
  words=${words#: && }
  words=${words% && :}
  for object in "$@"; do # those of an object library, or of the harness itself, stand in the command one by one
    words=${words/CMakeFiles\/aureole_cli.dir\/${object#"$folder"\/}/}
    words=${words/fuzz\/CMakeFiles\/fuzz_$name.dir\/__\/${object#"$folder"\/}/}
  done
  (cd "$build" && eval "${words/ -o fuzz\/fuzz_$name/ $* ${flags%% *} -o $folder\/fuzz_$name}")
}

sum() { # sum FILE...: lines, and those reached, of files of the tree
  local file
  for file in "$@"; do
    gcov -n -o "$folder/$(dirname "$file")" "$folder/$file.gcno" 2>/dev/null | grep -A1 "^File '$top/$file'" | tail -1
  done | sed 's/.*:\([0-9.]*\)% of \([0-9]*\)/\1 \2/' | awk '{ all += $2; hit += $1 * $2 / 100 } END { printf "%d %.0f\n", all, hit }'
}

# fresh HARNESS TITLE OBJECT...: what of build/fuzz/found reaches more than the corpus does, into it.
fresh() {
  local name=$1 program="$folder/fuzz_$1.$2" file said="$folder/said"
  local -a had=() found=()
  for file in fuzz/corpus/"$name"/*; do [ -e "$file" ] && had+=("$top/$file"); done
  [ -d "build/fuzz/found/$name" ] || return 0
  while read -r file; do found+=("$top/$file"); done < <(find "build/fuzz/found/$name" -type f -size -33k -printf '%s %p\n' |
    sort -n | cut -d' ' -f2-)
  (cd "$folder" && "$program" --runs 0 --fresh 1 "${had[@]}" "${found[@]}" >"$said" 2>"$said.2") || { tail -3 "$said.2" >&2; exit 2; }
  mkdir -p "fuzz/corpus/$name"
  grep "^$top/build/fuzz/found" "$said" | while read -r file; do
    cp "$file" "fuzz/corpus/$name/$(basename "$file" | cut -c1-12)"
  done || true
  echo "$name: ${#had[@]} files, $(grep -c "^$top/build/fuzz/found" "$said") more"
}

status=0
flags='--coverage -fprofile-update=atomic'
[ "${FRESH:-0}" = 0 ] || flags=-fsanitize-coverage=trace-pc
export AUREOLE_CACHE=
[ "${FRESH:-0}" = 1 ] || echo '| parser | lines | of these that tell of a lack of memory | seeds and corpus | and 1000 mutations |
|---|---|---|---|---|'
for row in "${parsers[@]}"; do
  IFS='|' read -r title harnesses patterns <<<"$row"
  files=() objects=()
  for file in $patterns; do
    files+=("$file")
    objects+=("$folder/$file.o")
    mkdir -p "$folder/$(dirname "$file")"
    [ -e "$folder/$file.o" ] || compile "$file" "$folder/$file.o"
  done
  for name in $harnesses; do
    link "$name" "${objects[@]}"
    mv "$folder/fuzz_$name" "$folder/fuzz_$name.$title"
    [ "${FRESH:-0}" = 0 ] || fresh "$name" "$title"
  done
  [ "${FRESH:-0}" = 0 ] || continue
  figures=()
  for runs in 0 1000; do
    for name in $harnesses; do
      corpus=()
      for input in fuzz/corpus/"$name"/*; do [ -e "$input" ] && corpus+=("$top/$input"); done
      (cd "$folder" && "./fuzz_$name.$title" --runs $runs --dictionary "$top/fuzz/keys.dict" "${corpus[@]}" >said 2>&1) ||
        { tail -3 "$folder/said" >&2; exit 2; }
    done
    read -r lines reached < <(sum "${files[@]}")
    figures+=("$(awk "BEGIN { printf \"%.1f\", 100 * $reached / $lines }")")
  done
  echo "| $title | $lines | $(cat "${files[@]}" | grep -c aur_fail_memory) | ${figures[0]} % | ${figures[1]} % |"
  awk "BEGIN { exit !(${figures[0]} >= 90) }" || status=1
  if [ "${MISSED:-0}" = 1 ]; then
    for file in "${files[@]}"; do
      (cd "$folder" && gcov -t -o "$folder/$(dirname "$file")" "$folder/$file.gcno" 2>/dev/null |
        awk -v file="$top/$file" '/:Source:/ { on = $0 ~ file } on && /#####/ { print }' | sed "s|^|$file|")
    done >&2
  fi
done
exit $status

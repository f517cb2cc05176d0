#!/usr/bin/env bash
# A room includes only its own headers and those of rooms below it; the program and the lab include public headers only, makers of
# scenes those and points/base. Tests, fuzz harnesses and the bench, which takes single loops of the libraries apart, may look inside.
set -u
source_tree=$2
# From the top floor to the ground; rooms on one line stand side by side and do not include each other. A room inside a
# room stands above the room's own folder, which holds what all of them share. Estimators stand on one line.
floors='
program/cli/absent
program/cli/lab program/cli/lighting
program/cli/render
program/cli/points
program/cli
program/lab
program/serve
program/watch
program/report/page
program/report
program/import
program/mpi
lighting/daylight
lighting/irradiance
lighting/viewfactors
render/adaptive
render/race
render/replicas
render/driver
render/estimators
render/path render/volume render/gather render/radiosity render/occlusion
render/photons
render/vertex
render/trace
render/film
render/sampling
render/scene/load
render/scene/shapes render/scene/lights render/scene/sensors render/scene/media render/scene/phases render/scene/volumes
render/scene
render/scene/importers/xml
render/scene/importers/rad render/scene/importers/model
render/scene/importers/meshes render/scene/importers/nodes
render/scene/materials
render/scene/plugin
render/image
points/ranks
points/quality/table
points/quality/sphere points/quality/square points/quality/spectrum
points/quality/split points/quality/rotations
points/quality/pairs
points/quality
points/quadrature/tables
points/quadrature/integrate
points/quadrature/estimate
points/quadrature/exact points/quadrature/weights
points/quadrature/potential
points/quadrature
points/sphere/directions
points/sphere/sets points/sphere/nearest
points/sphere/repulsion points/sphere/rotations
points/sphere
points/pointset/table
points/pointset/relax
points/pointset/generators points/pointset/files
points/pointset/digits
points/pointset
points/linear
points/base
'
(cd "$source_tree" && grep -rnE '^#include "' src include bench lab scenes tests fuzz --include='*.[ch]' --include='*.cpp') |
  awk -v floors="$floors" '
    # The room of a path below src: the longest one of the table that it lies in.
    function room_of(path, room) {
      room = path
      while (sub(/\/[^\/]*$/, "", room))
        if (room in floor) return room
      return ""
    }
    BEGIN {
      count = split(floors, lines, "\n")
      for (i = 1; i <= count; ++i) {
        rooms = split(lines[i], names, " ")
        for (k = 1; k <= rooms; ++k) floor[names[k]] = i
      }
    }
    function bad(what) { print where ": " what; status = 1 }
    {
      split($0, part, ":")
      file = part[1]
      where = file ":" part[2]
      target = $0
      sub(/.*#include "/, "", target)
      sub(/".*/, "", target)
      if (file ~ /^include\//) { bad("public headers include <aureole/...> only"); next }
      if (file ~ /^(tests|fuzz|bench)\//) {
        # The harness of command lines reads them by the tables of the program.
        if (file == "fuzz/fuzz_options.c" && target ~ /^program\/cli\//) next
        if (file == "tests/program/cli/test_progress.c" && target == "program/cli/progress.h") next # arithmetic that needs no program
        if (target ~ /^(program\/lab\/gather.h|lab\/gathering\/)/) next # the integrator of the lab
        if (target ~ /^(program|lab|scenes)\//) bad("tests and the bench run programs, and do not look into them")
        next
      }
      if (file ~ /^(lab|scenes)\//) {
        inside = room_of(target)
        if (inside != "" && inside != (file ~ /^lab\// ? "program/lab" : "points/base")) bad("this is inside of the libraries")
        next
      }
      if (target ~ /^data\//) next # a table of numbers, made from the text file of its name
      sub(/^src\//, "", file)
      here = room_of(file)
      there = room_of(target)
      if (here == "") { bad("stands in no room"); next }
      if (there == "") { bad("unknown room of \"" target "\""); next }
      if (floor[there] < floor[here]) bad(here " must not call " there ", which is above it")
      if (floor[there] == floor[here] && there != here) bad(here " must not call " there ", which stands beside it")
      if (there == "points/ranks" && here !~ /^(points\/ranks|render\/driver|program\/mpi)$/) bad("only the driver knows ranks")
      if (here ~ /^program\/cli/ && there !~ /^program\/(cli|lab|watch|report)/) bad("the program uses <aureole/...> only")
      if (here == "program/lab" && there !~ /^program\/(lab|report)/) bad("the lab uses <aureole/...> only")
      if (here ~ /^program\/(watch|serve)$/ && there !~ /^program\/(watch|report)/) bad("watching uses <aureole/...> only")
      if (here ~ /^program\/report/ && there !~ /^program\/report/) bad("tables of results use <aureole/...> only")
    }
    END { exit status }
  ' || exit 1
# Public headers and tests follow the same order: points knows nothing of render and lighting, render nothing of lighting.
(cd "$source_tree" && ! grep -rnE '^#include [<"](aureole-)?(render|lighting)/' src/points tests/points include/aureole &&
  ! grep -rnE '^#include [<"](aureole-)?lighting/' src/render tests/render include/aureole-render) || exit 1
# One header of the libraries and the program includes Embree.
others=$(cd "$source_tree" && grep -rlE '^ *# *include <embree' src | grep -vx src/render/trace/embree.h)
[ -z "$others" ] || { echo "$others: only render/trace/embree.h includes Embree"; exit 1; }
# No C file may stand outside a room.
for folder in "$source_tree"/src/*/*/; do
  room=${folder#"$source_tree"/src/}
  grep -qE "(^| )${room%/}( |$|/)" <<<"$floors" || { echo "$folder is not a room"; exit 1; }
done

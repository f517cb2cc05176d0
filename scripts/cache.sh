#!/usr/bin/env bash
# What the cache of photon maps and tables of weights saves: CPU seconds of a render of 256 pixels, without it, leaving
# an entry, and taking it: scripts/cache.sh [PROGRAM [RUNS]]. Medians of RUNS runs; exit status 1 where an image differs.
set -uo pipefail
aureole=$(realpath "${1:-build/release/aureole}")
runs=${2:-5}
source=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
export AUREOLE_CACHE=$folder/cache
status=0
render() { # render SCENE INTEGRATOR OUT OPTION...: CPU seconds on standard output
  "$aureole" render "$source/scenes/$1" --width 16 --height 16 --spp 1 --integrator "$2" -q -t 1 --stats -o "$3" "${@:4}" 2>&1 |
    sed -n 's/.* \([0-9.]*\) CPU s.*/\1/p'
}
median() { sort -g | sed -n "$(((runs + 1) / 2))p"; }
echo '| scene, integrator | without | first run | later runs | entries |'
echo '|---|---|---|---|---|'
for scene in cornell-box/glossy.xml room/room.xml parade/parade.xml; do
  for integrator in finalgather:photons={2000,20000,100000,500000} finalgather-lab:photons=2000,weights=oswa; do
    for ((i = 0; i < runs; ++i)); do
      rm -rf cache
      render $scene $integrator a.exr --no-cache >>without
      render $scene $integrator b.exr >>first
      render $scene $integrator c.exr >>later
      cmp -s a.exr b.exr && cmp -s a.exr c.exr || { echo "$scene $integrator: another picture"; status=1; }
    done
    size=$(du -ch cache/*.aureole 2>/dev/null | tail -1 | cut -f1)
    printf '| `%s` `%s` | %s s | %s s | %s s | %s |\n' "${scene%%/*}" "$integrator" "$(median <without)" "$(median <first)" \
      "$(median <later)" "${size:-none}"
    rm -f without first later
  done
done
exit $status

#!/usr/bin/env bash
# What several processes cost beside one: scripts/ranks.sh PROGRAM [ROUNDS]. Prints two tables. In each round one thread, one process of
# two threads, and then 2, 4 and 8 ranks of one thread do the same, one after the other, and figures are ratios within a round:
# their median, and the least and the most, between which the true median lies but for a chance of 2^(1 - ROUNDS).
# A last line says how much others used the processors meanwhile: times on the wall mean something on quiet processors only.
# The first work is next to nothing, so it shows what starting costs.
set -uo pipefail
aureole=$(realpath "${1:-build/release/aureole}")
rounds=${2:-5}
source=$(cd "$(dirname "$0")/.." && pwd)
command -v mpirun >/dev/null || { echo "ranks.sh: there is no mpirun" >&2; exit 2; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 AUREOLE_CACHE=
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
box=$source/scenes/cornell-box/cornell-box.xml
works=("render $box --width 16 --height 16 --spp 1 --stats -o a.exr"
       "render $box --width 512 --height 512 --spp 64 --stats -o a.exr"
       "render $box --width 512 --height 512 --spp 8 --integrator finalgather --stats -o a.exr"
       "render $source/scenes/keller/cube.xml --width 128 --height 128 --integrator radiosity:paths=4194304 --stats -o a.exr"
       "weights spherical-fibonacci -n 512 --lobe cosine --lobe2 phong:50 --n2 512 --angles 16 --table a.table"
       "measure spherical-fibonacci -n 800 -m cap")
TIMEFORMAT='%U %S %R'
# Processor seconds and those on the wall of a command and its children; what it says goes to `said`.
seconds() { { time "$@" >/dev/null 2>said; } 2>&1 | awk '{ print $1 + $2, $3 }'; }
# Seconds in which the processors were not idle, and were taken by other virtual machines.
busy() { awk -v tick="$(getconf CLK_TCK)" '/^cpu / { print ($2 + $3 + $4 + $7 + $8 + $9) / tick, $9 / tick }' /proc/stat; }
# The median of numbers, their least and most.
spread() { sort -g "$1" | awk '{ a[NR] = $1 } END { printf "%.2f (%.2f to %.2f)", (a[int((NR + 1) / 2)] + a[int(NR / 2) + 1]) / 2, a[1], a[NR] }'; }
# The largest of the ranks: CPU seconds of talk, megabytes sent and received.
talk() {
  awk '/^aureole: rank/ { for (i = 1; i < NF; ++i) { if ($(i + 1) == "of") t = $i
                                                     if ($(i + 1) == "bytes") s = $i
                                                     if ($(i + 1) == "received") r = $i }
                          if (t > a) a = t
                          if (s > b) b = s
                          if (r > c) c = r }
       END { if (c > 0) printf "%.2f | %.2f | %.2f", a, b / 1e6, c / 1e6; else printf " | | " }' said
}
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { print a / b }' >>"$3"; }
read -r busy_before stolen_before < <(busy)
started=$(date +%s.%N)
own=0
for w in "${!works[@]}"; do
  for ((i = 0; i < rounds; ++i)); do
    # shellcheck disable=SC2086
    read -r one one_wall < <(seconds "$aureole" ${works[w]} -t 1)
    # shellcheck disable=SC2086
    read -r threads threads_wall < <(seconds "$aureole" ${works[w]} -t 2)
    ratio "$threads" "$one" $w.threads
    ratio "$threads_wall" "$one_wall" $w.threads-wall
    own=$(awk "BEGIN { print $own + $one + $threads }")
    for ranks in 2 4 8; do
      # shellcheck disable=SC2086
      read -r many many_wall < <(seconds mpirun --bind-to none -n "$ranks" "$aureole" ${works[w]} -t 1)
      own=$(awk "BEGIN { print $own + $many }")
      ratio "$many" "$one" $w.$ranks
      ratio "$many_wall" "$one_wall" $w.$ranks-wall
      ratio "$many" "$threads" $w.$ranks-threads
      printf '%.2f | %s\n' "$many" "$(talk)" >$w.row.$ranks
    done
    echo "$one" >$w.one
  done
done
name() { sed "s|$source/||; s| --stats||; s| -o a.exr||; s| --table a.table||" <<<"${works[$1]}"; }
echo '| work | CPU, 2 ranks / 1 thread | 2 ranks / 2 threads | 2 threads / 1 thread | wall, 2 ranks / 1 thread | 2 threads / 1 thread |'
echo '|---|---|---|---|---|---|'
for w in "${!works[@]}"; do
  printf '| `%s` | %s | %s | %s | %s | %s |\n' "$(name "$w")" "$(spread $w.2)" "$(spread $w.2-threads)" "$(spread $w.threads)" \
    "$(spread $w.2-wall)" "$(spread $w.threads-wall)"
done
echo
echo '| work | ranks | CPU s | of one thread | talk, CPU s | sent, MB | received, MB |'
echo '|---|---|---|---|---|---|---|'
for w in "${!works[@]}"; do
  printf '| `%s` | 1 | %.2f | 1 | | | |\n' "$(name "$w")" "$(cat $w.one)"
  for ranks in 2 4 8; do
    IFS='|' read -r many rest <$w.row.$ranks
    printf '| | %d | %s| %s |%s |\n' $ranks "$many" "$(spread $w.$ranks)" "$rest"
  done
done
echo
read -r busy_after stolen < <(busy)
awk -v busy="$busy_after" -v before="$busy_before" -v stolen="$stolen" -v stolen_before="$stolen_before" -v own="$own" \
  -v wall="$(awk "BEGIN { print $(date +%s.%N) - $started }")" -v processors="$(nproc)" -v rounds="$rounds" 'BEGIN {
    all = wall * processors; others = (busy - before - own) / all; if (others < 0) others = 0
    printf "%d rounds on %d processors, of which others took %.0f %% and other virtual machines %.0f %%: %s.\n", rounds, processors,
      100 * others, 100 * (stolen - stolen_before) / all, others < 0.05 ? "quiet" : "not quiet, so that times on the wall say nothing" }'

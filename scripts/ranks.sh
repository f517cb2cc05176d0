#!/usr/bin/env bash
# What several processes cost beside one, in processor time and bytes: scripts/ranks.sh PROGRAM [ROUNDS]. Prints a table. In each
# round one process and then 2, 4 and 8 ranks of one thread do the same; ratios are medians over rounds, the rest is of the
# last one. The first work is next to nothing, so it shows what starting costs.
set -uo pipefail
aureole=$(realpath "${1:-build/release/aureole}")
rounds=${2:-3}
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
TIMEFORMAT='%U %S'
seconds() { # processor seconds of a command and its children; what it says goes to `said`
  { time "$@" >/dev/null 2>said; } 2>&1 | awk '{ print $1 + $2 }'
}
median() { sort -g | awk '{ a[NR] = $1 } END { print a[int((NR + 1) / 2)] }'; }
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
echo '| work | ranks | CPU s | of one process | talk, CPU s | sent, MB | received, MB |'
echo '|---|---|---|---|---|---|---|'
for work in "${works[@]}"; do
  rm -f ratios.*
  for ((i = 0; i < rounds; ++i)); do
    # shellcheck disable=SC2086
    one=$(seconds "$aureole" $work -t 1)
    for ranks in 2 4 8; do
      # shellcheck disable=SC2086
      many=$(seconds mpirun --bind-to none -n "$ranks" "$aureole" $work -t 1)
      awk "BEGIN { print $many / $one }" >>ratios.$ranks
      printf '%.2f | %s | %s\n' "$many" "$(median <ratios.$ranks)" "$(talk)" >row.$ranks
    done
  done
  name=$(sed "s|$source/||; s| --stats||; s| -o a.exr||; s| --table a.table||" <<<"$work")
  printf '| `%s` | 1 | %.2f | 1 | | | |\n' "$name" "$one"
  for ranks in 2 4 8; do
    IFS='|' read -r many ratio rest <row.$ranks
    printf '| | %d | %s| %.2f |%s |\n' "$ranks" "$many" "${ratio// /}" "$rest"
  done
done

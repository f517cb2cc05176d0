#!/usr/bin/env bash
# What several processes cost beside one: scripts/ranks.sh [--quick] [PROGRAM [ROUNDS]]. In each round of a work one thread, one process
# of two threads, and then 2, 4 and 8 ranks of one thread do the same, one after the other. Ratios are those within a round:
# their median, and the least and the most, between which the true median lies but for a chance of 2^(1 - ROUNDS). The rows
# of a work are printed when its rounds are over. A last line says how much others used the processors meanwhile: times on the wall
# mean something on quiet processors only. "2 apart" are two processes that know nothing of each other and render a half each (--shard):
# what the machine itself takes from two that run at once. The first work is next to nothing, so it shows what starting costs. --quick: one
# round of smaller works, within a minute.
set -uo pipefail
quick=
[ "${1:-}" != --quick ] || { quick=1; shift; }
aureole=$(realpath "${1:-build/release/aureole}")
rounds=${2:-$([ $quick ] && echo 1 || echo 5)}
source=$(cd "$(dirname "$0")/.." && pwd)
command -v mpirun >/dev/null || { echo "ranks.sh: there is no mpirun" >&2; exit 2; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 AUREOLE_CACHE=
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
box=$source/scenes/cornell-box/cornell-box.xml
cube=$source/scenes/keller/cube.xml
works=("render $box --width 16 --height 16 --spp 1")
if [ $quick ]; then
  works+=("render $box --width 128 --height 128 --spp 32"
          "render $box --width 128 --height 128 --spp 4 --integrator finalgather"
          "render $cube --width 64 --height 64 --integrator radiosity:paths=262144"
          "weights spherical-fibonacci -n 256 --lobe cosine --lobe2 phong:50 --n2 256 --angles 8"
          "measure spherical-fibonacci -n 400 -m cap")
else
  works+=("render $box --width 512 --height 512 --spp 24"
          "render $box --width 512 --height 512 --spp 4 --integrator finalgather"
          "render $cube --width 128 --height 128 --integrator radiosity:paths=2097152"
          "weights spherical-fibonacci -n 512 --lobe cosine --lobe2 phong:50 --n2 512 --angles 8"
          "measure spherical-fibonacci -n 700 -m cap")
fi
TIMEFORMAT='%U %S %R'
# Processor seconds and those on the wall of a command and its children; what it says goes to `said`.
seconds() { { time "$@" >/dev/null 2>said; } 2>&1 | awk '{ print $1 + $2, $3 }'; }
# Seconds in which the processors were not idle, and were taken by other virtual machines.
busy() { awk -v tick="$(getconf CLK_TCK)" '/^cpu / { print ($2 + $3 + $4 + $7 + $8 + $9) / tick, $9 / tick }' /proc/stat; }
# The median of the ratios of a column of a file to the same column of another, line by line, their least and most.
spread() { # spread FILE OTHER COLUMN
  paste -d ' ' "$1" "$2" | awk -v c="$3" '{ print $c / $(c + 2) }' | sort -g | awk '{ a[NR] = $1 } END {
    printf "%.2f", (a[int((NR + 1) / 2)] + a[int(NR / 2) + 1]) / 2
    if (NR > 1) printf " (%.2f to %.2f)", a[1], a[NR] }'
}
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
read -r busy_before stolen_before < <(busy)
started=$(date +%s.%N)
echo '| work | ranks x threads | CPU s | of 1 x 1 | of 1 x 2 | wall, of 1 x 1 | talk, CPU s | sent, MB | received, MB |'
echo '|---|---|---|---|---|---|---|---|---|'
for work in "${works[@]}"; do
  case $work in
    render*) options='--stats -o a.exr' ;;
    weights*) options='--table a.table' ;;
    *) options= ;;
  esac
  rm -f ./*.times
  forms=('1 x 1' '1 x 2')
  [[ $work != render* || $work = *--integrator* ]] || forms+=('2 apart')
  forms+=('2 x 1' '4 x 1' '8 x 1')
  for ((i = 0; i < rounds; ++i)); do
    # shellcheck disable=SC2086
    for form in "${forms[@]}"; do
      command=("$aureole" $work $options -t "${form#* x }")
      if [ "$form" = '2 apart' ]; then
        command=(bash -c '"$@" --shard 1/2 -o 1.part & "$@" --shard 2/2 -o 2.part & wait' bash "$aureole" $work -t 1)
      fi
      [ "${form%% *}" = 1 ] || [ "$form" = '2 apart' ] || command=(mpirun --bind-to none -n "${form%% *}" "${command[@]}")
      seconds "${command[@]}" | tee -a all >>"$form.times"
      talk >"$form.talk"
    done
  done
  title="\`${work//"$source/"/}\`"
  for form in "${forms[@]}"; do
    printf '| %s | %s | %.2f |' "$title" "$form" "$(sort -g "$form.times" | awk '{ a[NR] = $1 } END { print a[int((NR + 1) / 2)] }')"
    title=
    [ "$form" = '1 x 1' ] && { echo ' 1 | | 1 | | | |'; continue; }
    printf ' %s | %s | %s | %s |\n' "$(spread "$form.times" '1 x 1.times' 1)" \
      "$([[ $form = '1 x 2' || $form = '2 apart' ]] || spread "$form.times" '1 x 2.times' 1)" "$(spread "$form.times" '1 x 1.times' 2)" "$(cat "$form.talk")"
  done
done
echo
read -r busy_after stolen < <(busy)
awk -v busy="$busy_after" -v before="$busy_before" -v stolen="$stolen" -v stolen_before="$stolen_before" -v own="$(awk '{ s += $1 } END { print s }' all)" \
  -v wall="$(awk "BEGIN { print $(date +%s.%N) - $started }")" -v processors="$(nproc)" -v rounds="$rounds" 'BEGIN {
    all = wall * processors; others = (busy - before - own) / all; if (others < 0) others = 0
    printf "%d rounds on %d processors, of which others took %.0f %% and other virtual machines %.0f %%: %s.\n", rounds, processors,
      100 * others, 100 * (stolen - stolen_before) / all, others < 0.05 ? "quiet" : "not quiet, so that times on the wall say nothing" }'

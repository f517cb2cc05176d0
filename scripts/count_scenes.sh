#!/usr/bin/env bash
# Counts what loads of the Mitsuba scenes under a folder, and why the others do not: scripts/count_scenes.sh PROGRAM FOLDER [OPTION...].
# Files without a <sensor> are parts of other scenes and are left out. A scene is read by `info`, which refuses what `render`
# refuses, with the options that are given; files that a scene names and that are not there are a reason of their own.
set -u
[ $# -ge 2 ] || { sed -n '2,4s/^# //p' "$0"; exit 2; }
program=$1 folder=$2
shift 2
reasons=$(mktemp) || exit 2
trap 'rm -f "$reasons"' EXIT
count=0 loaded=0
while IFS= read -r -d '' scene; do
  message=$("$program" info "$scene" "$@" 2>&1 >/dev/null)
  status=$?
  [[ $message == *"the scene has no <sensor>"* ]] && continue
  count=$((count + 1))
  if [ $status = 0 ]; then
    loaded=$((loaded + 1))
    continue
  fi
  echo "$scene"
  # One reason a scene and thing: without places, and without what else there would be.
  printf '%s\n' "$message" | awk '!/^aureole: warning: / || /: unknown / || / is not supported: /' | sed -E -n 's/^aureole: (warning: )?[^ ]*\.xml:[0-9]+:[0-9]+: //p' |
    sed -E "s/(; there are|; did you mean| \(looked in| \(nearest).*//; s/cannot find '[^']*'.*/a file that is not there/" |
    sort -u >>"$reasons"
done < <(find "$folder" -name '*.xml' -type f -print0 | sort -z)
echo
echo "$loaded of $count scenes load"
[ -s "$reasons" ] && sort "$reasons" | uniq -c | sort -rn
exit 0

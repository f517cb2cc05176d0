#!/usr/bin/env bash
# What README.md and docs/guide.md say to type can be typed: their ```sh and ```console blocks run in turn in a folder of
# their own beside the scenes, every command of them succeeds, and those of ```console print what stands below them.
set -u
program=$1 source_tree=$2
status=0
aureole() { "$program" "$@"; }
export program
export -f aureole
models=true
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >probe.obj
aureole info probe.obj >probe 2>&1 || models=false
for page in README.md docs/guide.md; do
  folder=$PWD/$(basename "$page" .md)
  mkdir "$folder" && ln -s "$source_tree/scenes" "$folder/scenes"
  awk '/^```/ { inside = ($0 == "```console"); next } inside' "$source_tree/$page" >"$folder/session"
  grep -q '^\$ aureole ' "$folder/session" || { echo "$page has no session"; status=1; }
  # Without assimp there are no models.
  awk -v models=$models '/^```/ { inside = $0 == "```console" || $0 == "```sh" || (models == "true" && $0 == "```sh models")
                                  typed = $0 ~ /^```sh/; next }
    inside && typed && NF { print "run\t" $0 } inside && !typed && /^\$ / { print "show\t" substr($0, 3) }' "$source_tree/$page" >"$folder/commands"
  (cd "$folder" && while IFS=$'\t' read -r how command <&3; do
    if [ "$how" = show ]; then
      printf '$ %s\n' "$command"
      bash -c "$command" 2>&1
    else
      bash -c "$command" >said 2>&1
    fi || echo "$page: fails: $command: $(tail -2 said)" >>failures
  done 3<commands >printed)
  [ ! -e "$folder/failures" ] || { cat "$folder/failures"; status=1; }
  diff "$folder/session" "$folder/printed" || { echo "$page shows something else than is printed"; status=1; }
done
exit $status

#!/usr/bin/env bash
# docs/architecture.md: the drawing is what the include table gives, every function of a walk is defined in its file, every folder
# of the tree exists, and every folder of src is drawn.
set -u
cd "$2" || exit 1
status=0
wrong() { echo "docs/architecture.md: $*"; status=1; }
bash scripts/architecture_page.sh | diff - docs/architecture.svg >/dev/null || wrong "run scripts/architecture_page.sh >docs/architecture.svg"
for folder in src/*/*/; do
  grep -q ">$(basename "$folder")</text>" docs/architecture.svg || wrong "$folder is not drawn"
done
rows=0
while IFS='|' read -r _ file function _; do
  rows=$((rows + 1))
  file=$(tr -d '` ' <<<"$file") function=$(tr -d '` ' <<<"$function")
  # A definition begins its line and is no declaration.
  grep -qE "^[a-z].*\b$function\(([^;]*|.*\{)$" "src/$file" 2>/dev/null || wrong "src/$file does not define $function"
done < <(grep -E '^\| `[a-z_/]+\.c` \| `' docs/architecture.md)
[ "$rows" -ge 25 ] || wrong "only $rows functions were read"
while read -r folder; do [ -d "$folder" ] || wrong "there is no folder $folder"; done < <(sed -nE 's/^\| `([a-z]+)` \| [^`|]*.*/\1/p' docs/architecture.md | grep -v '^aureole$\|^libaureole$')
[ "$(wc -w <docs/architecture.md)" -le 1500 ] || wrong "has more than 1500 words"
exit $status

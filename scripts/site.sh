#!/usr/bin/env bash
# Makes a site of the documentation in the folder OUT: every page of the tree, the papers' pages, the gallery, manual pages where the build
# has them, the files that pages point to, and by Doxygen a reference of the public headers. It needs no network to be made or read, may
# be opened as files, and has a search of its own.
#   scripts/site.sh OUT
# BUILD: the build whose manual pages are taken (build/release). DOXYGEN: another doxygen; empty for none, with words.
# Needs Debian's python3-markdown-it; takes doxygen where it is. Exit status 1 where a link leads nowhere, 2 where something is missing.
set -euo pipefail
out=${1:?usage: scripts/site.sh OUT}
mkdir -p "$out"
out=$(realpath "$out")
cd "$(dirname "$0")/.."
python=${PYTHON:-/usr/bin/python3}
"$python" -c 'import markdown_it' 2>/dev/null || { echo "site.sh: install python3-markdown-it" >&2; exit 2; }

reference=()
doxygen=${DOXYGEN-doxygen}
if [ -n "$doxygen" ] && command -v "$doxygen" >/dev/null; then
  rm -rf "$out/reference"
  # The headers' comments are plain ones: those before a declaration, and those behind a member, are taken for Doxygen's.
  {
    cat scripts/site/Doxyfile
    echo "OUTPUT_DIRECTORY = \"$out\""
    echo "PROJECT_NUMBER = $(sed -n 's/^version: //p' CITATION.cff)"
  } | "$doxygen" - >"$out/doxygen.log" 2>&1 || { tail -5 "$out/doxygen.log"; exit 1; }
  ! grep 'error:' "$out/doxygen.log" || exit 1
  rm "$out/doxygen.log"
  reference=(--reference reference/index.html)
else
  echo "site.sh: without the reference of the headers: there is no doxygen" >&2
fi
manuals=()
while IFS= read -r page; do manuals+=(--manual "$page"); done < <(find "${BUILD:-build/release}/man" -name '*.[1-8]' 2>/dev/null | sort)
# What the lab found, from the tables in the tree.
aureole=${BUILD:-build/release}/aureole
if [ -x "$aureole" ] && [ -d docs/report/results ]; then
  mkdir -p "$out/docs"
  "$aureole" lab report docs/report/results --small -o "$out/docs/report" >/dev/null
fi
exec "$python" scripts/site/pages.py "$out" "${reference[@]}" "${manuals[@]}"

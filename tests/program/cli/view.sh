#!/usr/bin/env bash
# The page of images is opened by xdg-open at a terminal of a desktop, and nowhere else.
set -u
aureole=$1
. "$2/tests/terminal.sh.inc"
printf 'PF\n1 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0' >a.pfm
mkdir -p bin pages
printf '#!/bin/sh\necho "$1" >>"%s/opened.txt"\n' "$PWD" >bin/xdg-open
chmod +x bin/xdg-open
export PATH=$PWD/bin:$PATH TMPDIR=$PWD/pages
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
DISPLAY=:99 "$aureole" view a.pfm >path.txt && [ -s "$(cat path.txt)" ] || fail "no page: $(cat path.txt)"
at_terminal() { env "$@" script -qec "'$aureole' view a.pfm $output" /dev/null | tr -d '\r' >path.txt; }
output=
at_terminal -u DISPLAY -u WAYLAND_DISPLAY
output="-o page.html" at_terminal DISPLAY=:99
[ ! -e opened.txt ] || fail "opened without a desktop, a terminal or in spite of -o: $(cat opened.txt)"
at_terminal DISPLAY=:99
for _ in $(seq 100); do [ -s opened.txt ] && break; sleep 0.1; done
cmp path.txt opened.txt || fail "what was opened: $(cat path.txt opened.txt)"
exit $((failures > 0))

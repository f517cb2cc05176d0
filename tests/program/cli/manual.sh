#!/usr/bin/env bash
# The manual pages: every command has one with all its options, the page of scenes names every thing of every kind, its example is
# a scene, and man and groff find nothing wrong with any of them.
set -u
aureole=$1
status=0
fail() {
  echo "FAILED: $*"
  status=1
}
plain() { sed 's/\\-/-/g; s/,\\:/,/g; s/\\(aq/'"'"'/g; s/\\(ti/~/g; s/\\(ha/^/g; s/\\(ga/`/g; s/\\&//g; s/\\e/\\/g' "$@"; }

"$aureole" manual -o pages || fail "manual -o"
"$aureole" help command --format csv | tail -n +2 | cut -d, -f1 >verbs
while read -r verb; do
  "$aureole" manual "$verb" | cmp -s - "pages/man1/aureole-$verb.1" || fail "manual $verb is not the page of manual -o"
  plain "pages/man1/aureole-$verb.1" >page
  "$aureole" help command "$verb" --format csv | tail -n +2 | grep -oE '^"?--[a-z0-9-]*[a-z0-9]' | tr -d '"' | while read -r option; do
    grep -q -- "^\\\\fB.*$option" page || echo "$verb: the page has no $option"
  done >missing
  [ -s missing ] && fail "$(cat missing)"
done <verbs
[ "$(find pages/man1 -name 'aureole-*.1' | wc -l)" = "$(wc -l <verbs)" ] || fail "pages of commands: $(ls pages/man1)"
"$aureole" manual aureole | cmp -s - pages/man1/aureole.1 || fail "manual aureole"
for kind in integrator bsdf texture spectrum shape emitter sensor medium phase volume film rfilter; do
  "$aureole" help "$kind" --format csv | tail -n +2 | cut -d, -f1 | while read -r name; do
    grep -qxF "\\fB${name//-/\\-}\\fR" pages/man5/aureole-scene.5 || echo "aureole-scene(5) has no $kind $name"
  done
done >missing
[ -s missing ] && fail "$(cat missing)"
sed '1,/^\.nf/d; /^\.fi/,$d' pages/man5/aureole-scene.5 | plain >scene.xml
"$aureole" render scene.xml --spp 1 --width 16 -q -o scene.exr || fail "the example of aureole-scene(5) is no scene"

for page in pages/man*/*; do
  ! command -v groff >/dev/null || groff -ww -man -Tutf8 "$page" 2>&1 >/dev/null | head -3
  ! command -v man >/dev/null || LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l -Tutf8 "$page" 2>&1 >/dev/null | head -3
done >warnings
[ -s warnings ] && fail "$(head -5 warnings)"

"$aureole" manual rendr 2>message && fail "a page that is not there"
grep -q "did you mean 'render'?" message || fail "manual rendr: $(cat message)"
"$aureole" manual 2>message && fail "no page"
grep -q "PAGE to print, or -o FOLDER" message || fail "manual: $(cat message)"
: >file
"$aureole" manual -o file/below 2>message
[ $? = 3 ] || fail "a folder that cannot be made: $(cat message)"
exit $status

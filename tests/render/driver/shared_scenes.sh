#!/usr/bin/env bash
# Public scenes of ../shared/scenes, which are not in the tree, against images by another renderer: shared_*.sh.inc.
set -u
status=0
for test in "$(dirname "$0")"/shared_*.sh.inc; do
  name=${test##*/shared_}
  name=${name%.sh.inc}
  [ -f "$2/../shared/scenes/${name//_/-}/scene.xml" ] || { echo "skipped: ../shared/scenes is not there"; exit 77; }
  (mkdir "$name" && cd "$name" && bash "$test" "$@") || status=1
done
exit $status

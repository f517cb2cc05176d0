#!/usr/bin/env bash
# One side of an image alone keeps the shape that the scene gives it.
set -eu
program=$1 source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >scene.xml <<'XML'
<scene version="3.0.0">
  <integrator type="depth"/>
  <sensor type="perspective">
    <film type="hdrfilm"><integer name="width" value="300"/><integer name="height" value="200"/></film>
    <sampler type="independent"><integer name="sample_count" value="1"/></sampler>
  </sensor>
  <shape type="sphere"/>
</scene>
XML

# Prints the size of the image that the options give.
size() {
  "$program" render scene.xml -q -o picture.pfm "$@"
  head -c 20 picture.pfm | sed -n 2p
}

failures=0
expect() {
  local wanted=$1
  shift
  local found
  found=$(size "$@")
  [ "$found" = "$wanted" ] || {
    echo "$*: $found instead of $wanted"
    failures=$((failures + 1))
  }
}
expect '300 200'
expect '150 100' --width 150
expect '150 100' --height 100
expect '31 21' --width 31
expect '1 1' --width 1
expect '40 90' --width 40 --height 90
expect '300 200' --width 300
[ "$failures" = 0 ]

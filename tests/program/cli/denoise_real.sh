#!/usr/bin/env bash
# Isolated bright pixels after denoising with Open Image Denoise itself, from AUREOLE_OIDN or the system.
set -u
aureole=$1
source=$2
command -v python3 >/dev/null || { echo "no python3"; exit 77; }
isolated() { "$aureole" convert "$1" counted.pfm --channels "$2" && python3 "$source/tests/program/cli/isolated.py" counted.pfm; }
failures=0
# A mirrored lamp may be one bright pixel: as many as in the image of many samples.
for scene in cornell-box/cornell-box cornell-box/glossy room/room; do
  "$aureole" render "$source/scenes/$scene.xml" -q --width 64 --integrator path --filter box --spp 256 -o a.exr || exit 1
  read -r true _ < <(isolated a.exr R,G,B)
  for option in --rounds --spp; do # with the limit of changes, and without
    "$aureole" render "$source/scenes/$scene.xml" -q --width 64 --integrator path "$option" 2 -o a.exr --denoise 2>message.txt || {
      grep -q 'Open Image Denoise not found' message.txt && { echo "Open Image Denoise is not installed"; exit 77; }
      cat message.txt
      exit 1
    }
    read -r noisy _ < <(isolated a.exr noisy.R,noisy.G,noisy.B)
    read -r clean _ < <(isolated a.exr R,G,B)
    echo "$scene $option 2: $noisy isolated bright pixels, $clean after denoising, $true of 256 samples"
    [ "$noisy" -gt 10 ] && [ "$clean" -le "$true" ] || { echo "FAILED"; failures=$((failures + 1)); }
  done
done
exit $((failures > 0))

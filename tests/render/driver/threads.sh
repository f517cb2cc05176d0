#!/usr/bin/env bash
# An image is the same to the bit for any number of threads, and its crop is a part of it.
. "$(dirname "$0")/common.sh.inc"
scene=$source/scenes/cornell-box/glossy.xml
for integrator in path:interleaved=true path finalgather:photons=20000,diffuse_samples=16,glossy_samples=16 \
                  finalgather-lab:photons=20000,pattern=sobol,rotations=0; do
  name=${integrator%%[:,]*}
  for threads in 1 2 3; do
    "$aureole" render "$scene" -q -t $threads --integrator "$integrator" --width 48 --height 40 --spp 4 \
      -o $name-$threads.exr || fail "$integrator with $threads threads"
  done
  cmp $name-1.exr $name-2.exr || fail "$integrator: 1 and 2 threads differ"
  cmp $name-1.exr $name-3.exr || fail "$integrator: 1 and 3 threads differ"
  "$aureole" render "$scene" -q --integrator "$integrator" --width 48 --height 40 --spp 4 --seed 1 -o $name-seed.exr
  cmp -s $name-1.exr $name-seed.exr && fail "$integrator: the seed changes nothing"
  "$aureole" compare $name-1.exr $name-seed.exr --tolerance 1 >/dev/null || fail "$integrator: seeds too far apart"
done
"$aureole" render "$scene" -q --integrator path --width 48 --height 40 --spp 4 -t 2 -o again.exr
cmp again.exr path-1.exr || fail "the same command twice"

# The film's own crop is that of --crop, and holds for the film's own size.
sed 's|<rfilter|<integer name="crop_offset_x" value="200"/><integer name="crop_offset_y" value="300"/><integer name="crop_width" value="20"/><integer name="crop_height" value="9"/><rfilter|
     s|value="meshes/|value="'"$source"'/scenes/cornell-box/meshes/|' "$source/scenes/cornell-box/cornell-box.xml" >film.xml
"$aureole" render film.xml -q --spp 2 -o film.exr || fail "the film's crop"
"$aureole" render "$source/scenes/cornell-box/cornell-box.xml" -q --spp 2 --crop 200,220,300,309 -o crop.exr || fail "--crop"
cmp film.exr crop.exr || fail "the film's crop is not --crop"
"$aureole" render film.xml -q --spp 1 --width 16 --height 8 -o small.exr || fail "another size"
[ "$("$aureole" info small.exr --format csv | awk -F, 'NR == 2 { print $2 "x" $3 }')" = 16x8 ] || fail "another size: $("$aureole" info small.exr)"
sed -i 's|"crop_width" value="20"|"crop_width" value="400"|' film.xml
"$aureole" render film.xml -q -o bad.exr 2>message.txt
[ $? -eq 2 ] && grep -q 'film.xml:[0-9]*:[0-9]*: film .hdrfilm.: the crop of 400 x 9 at 200, 300 is not inside 512 x 512' message.txt ||
  fail "a crop beyond the film: $(cat message.txt)"
exit $((failures > 0))

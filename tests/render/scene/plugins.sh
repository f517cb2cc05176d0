#!/usr/bin/env bash
# Plugins of Mitsuba 3 in the scenes of bench/peers/plugins, which plugins.py there compares with Mitsuba: each is loaded and
# rendered by `path` and by `finalgather`, which must agree within what their noise allows; what has no effect here is said
# once, and what a scene asks of a mesh that does not have it is refused.
set -u
aureole=$1
scenes=$2/bench/peers/plugins

# 24 x 24 pixels of 64 samples: the noise of all of an image is below 1 %, and 5 % is far beyond it.
for scene in "$scenes"/*.xml; do
  name=$(basename "$scene" .xml)
  if grep -q '<medium' "$scene"; then
    "$aureole" render "$scene" -q --integrator volpath --spp 1 -o "$name.exr" || { echo "$name: volpath fails"; exit 1; }
    "$aureole" render "$scene" -q --integrator finalgather -o "$name.exr" 2>refusal
    [ $? = 2 ] && grep -q "finalgather' takes no media" refusal || { echo "$name: finalgather takes media"; exit 1; }
    continue
  fi
  # Short: a sample per pixel and few photons, of which nothing is said.
  for integrator in path "finalgather${AUREOLE_SHORT_TESTS:+:photons=5000}"; do
    "$aureole" render "$scene" -q --integrator "$integrator" --seed 3 -o "$name-${integrator%%:*}.exr" ${AUREOLE_SHORT_TESTS:+--spp 1} ||
      { echo "$name: $integrator fails"; exit 1; }
  done
  [ -n "${AUREOLE_SHORT_TESTS:-}" ] || "$aureole" compare "$name-path.exr" "$name-finalgather.exr" --downsample 24 --metric relative-rmse --tolerance 0.05 >compared ||
    { echo "$name: path and finalgather differ"; cat compared; exit 1; }
done

"$aureole" render "$scenes/filters.xml" -D spp=1 -o filters.exr 2>warnings || exit 1
[ "$(grep -c unpolarised warnings)" = 1 ] || { echo "that light is unpolarised is not said once:"; cat warnings; exit 1; }

for ending in bmp tga; do
  "$aureole" compare "$scenes/picture.png" "$scenes/picture.$ending" >compared || { echo "$ending is not the PNG"; cat compared; exit 1; }
done

# White hair in white surroundings cannot be seen: rays that leave a curve do not meet its inside. The noise
# of 16 samples in the mean of an image is .3 %; what 64 bounces leave out is less.
for curve in none linearcurve bsplinecurve; do
  {
    echo "<scene version='3.0.0'><emitter type='constant'/><sensor type='perspective'><float name='fov' value='20'/>"
    echo "<transform name='to_world'><lookat origin='1,3,5' target='0,0.6,0' up='0,1,0'/></transform><film type='hdrfilm'>"
    echo "<integer name='width' value='24'/><integer name='height' value='24'/><rfilter type='box'/></film></sensor>"
    [ $curve = none ] || echo "<shape type='$curve'><string name='filename' value='$scenes/hair.txt'/><bsdf type='diffuse'>" \
      "<rgb name='reflectance' value='1'/></bsdf></shape>"
    echo "</scene>"
  } >furnace.xml
  "$aureole" render furnace.xml -q --integrator path:max_depth=64 --spp 16 -o furnace-$curve.exr || exit 1
  "$aureole" compare furnace-$curve.exr furnace-none.exr --downsample 24 --metric relative-rmse --tolerance 0.01 >compared ||
    { echo "white $curve can be seen"; cat compared; exit 1; }
done

# A beam that is wider than what is seen is parallel light of that irradiance.
wall="<sensor type='orthographic'><transform name='to_world'><lookat origin='0,0,3' target='0,0,0' up='0,1,0'/></transform>\
<film type='hdrfilm'><integer name='width' value='8'/><integer name='height' value='8'/></film></sensor>\
<shape type='rectangle'><transform name='to_world'><scale value='3'/></transform></shape>"
turn="<transform name='to_world'><scale value='5'/><lookat origin='2,0,4' target='0,0,0' up='0,1,0'/></transform>"
for shape in rectangle disk; do
  echo "<scene version='3.0.0'>$wall<shape type='$shape'>$turn<emitter type='directionalarea'/></shape></scene>" >beam.xml
  echo "<scene version='3.0.0'>$wall<emitter type='directional'>$turn</emitter></scene>" >parallel.xml
  for scene in beam parallel; do
    "$aureole" render $scene.xml -q --integrator direct --spp 4 -o $scene.exr || exit 1
  done
  "$aureole" compare beam.exr parallel.exr --metric relative-rmse --tolerance 1e-6 >compared ||
    { echo "the beam of a $shape is not parallel light"; cat compared; exit 1; }
done

# A batch of one camera is that camera; of two, each has its half of the film.
camera() { # camera DISTANCE [FILM]: how far the wall is
  echo "<sensor type='orthographic'><transform name='to_world'><lookat origin='0.1,0,$1' target='0.1,0,0' up='0,1,0'/></transform>${2:-}</sensor>"
}
film() { # film WIDTH CROP_OFFSET
  echo "<film type='hdrfilm'><integer name='width' value='$1'/><integer name='height' value='8'/><integer name='crop_offset_x' value='$2'/>\
<integer name='crop_width' value='8'/><rfilter type='box'/></film>"
}
picture() { # picture NAME INTEGRATOR SENSOR: of a wall
  echo "<scene version='3.0.0'>$3<shape type='rectangle'><transform name='to_world'><scale value='2'/></transform></shape><emitter type='constant'/></scene>" >batch.xml
  "$aureole" render batch.xml -q --integrator "$2" --spp 4 -o "$1.exr" || exit 1
}
picture one path "$(camera 3 "$(film 8 0)")"
picture batch path "<sensor type='batch'>$(camera 3 "$(film 4 0)")$(film 8 0)</sensor>"
cmp one.exr batch.exr || { echo "a batch of one camera is not that camera"; exit 1; }
for half in 0 8; do
  picture one depth "$(camera $((3 + half)) "$(film 8 0)")"
  picture batch depth "<sensor type='batch'>$(camera 3)$(camera 11)$(film 16 $half)</sensor>"
  "$aureole" compare one.exr batch.exr --metric relative-rmse --tolerance 1e-6 >compared ||
    { echo "the half of a batch at $half is not that of its camera"; cat compared; exit 1; }
done

refuses() { # refuses WORDS BODY
  echo "<scene version='3.0.0'>${3-<sensor type='perspective'/>}$2</scene>" >refused.xml
  "$aureole" info refused.xml >out 2>&1
  local status=$?
  [ $status = 2 ] && grep -q "$1" out || { echo "'$1' is not said with status 2 of: $2"; cat out; exit 1; }
}
colors="<bsdf type='diffuse'><texture type='mesh_attribute' name='reflectance'><string name='name' value='"
refuses "no attribute 'vertex_color'" "<shape type='cube'>${colors}vertex_color'/></texture></bsdf></shape>"
refuses "no attribute 'face_color'" "<shape type='sphere'>${colors}face_color'/></texture></bsdf></shape>"
refuses "must begin with vertex_ or face_" "<shape type='cube'>${colors}ao'/></texture></bsdf></shape>"
refuses "needs a texture" "<bsdf type='bumpmap'><bsdf type='diffuse'/></bsdf>"
refuses "needs two nested" "<bsdf type='blendbsdf'><bsdf type='diffuse'/></bsdf>"
refuses "only a rectangle or a disk" "<shape type='sphere'><emitter type='directionalarea'/></shape>"
refuses "'eta' or 'specular', not both" \
  "<bsdf type='principled'><float name='eta' value='1.5'/><float name='specular' value='0.5'/></bsdf>"
refuses "it needs a <sensor> inside" "" "<sensor type='batch'/>"
refuses "cannot be inside another" "" "<sensor type='batch'><sensor type='batch'/></sensor>"
refuses "must be in one medium" "" "<sensor type='batch'><sensor type='perspective'/><sensor type='perspective'>\
<medium type='homogeneous'/></sensor></sensor>"

# All that is not known is said at once, and before a mesh is looked for; a sensor that is left out may have what it likes.
printf 'void brightfunc b 2 a b 0 0\nb blob c 0 0 8 0 0 0 0 0 1 1 .5\nb sphere s 0 0 4 0 0 0 1\n' >left-out.rad
refuses "film 'nofilm'" "<shape type='ply'><string name='filename' value='none.ply'/></shape><include filename='left-out.rad'/>" \
  "<sensor type='perspective'><film type='nofilm'><rfilter type='sinc'/></film></sensor><sensor type='perspective'><film type='another'/></sensor>"
for words in "left-out.rad:1: 'brightfunc' is not read" "left-out.rad:2: 'blob' is not read" "rfilter 'sinc'"; do
  grep -q "$words" out && ! grep -q "none.ply\|another" out || { echo "not all is said at once:"; cat out; exit 1; }
done
refuses "bsdf 'hair'" "<shape type='ply'><string name='filename' value='none.ply'/><bsdf type='hair'/></shape><emitter type='sunskies'/>"
grep -q "emitter 'sunskies'" out && ! grep -q none.ply out || { echo "not all is said at once:"; cat out; exit 1; }

# What loads of a folder is counted, and why the rest does not.
"$2/scripts/count_scenes.sh" "$aureole" "$scenes" >count || exit 1
grep -Eq '^([0-9]+) of \1 scenes load$' count || { echo "not all of $scenes load:"; cat count; exit 1; }
mkdir -p folder/deeper
cp refused.xml folder/deeper/a.xml && cp refused.xml folder/b.xml && sed 's/hair/diffuse/; s/sunskies/point/' refused.xml >folder/c.xml
"$2/scripts/count_scenes.sh" "$aureole" folder >count || exit 1
grep -q '^0 of 3 scenes load$' count && grep -q "2 bsdf 'hair' is not supported: " count && grep -q "1 a file that is not there" count ||
  { echo "reasons are not counted:"; cat count; exit 1; }
exit 0

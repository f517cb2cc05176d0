#!/usr/bin/env bash
# What a listing says is the default can be written, and changes no byte of the result: every option of every command, every key
# of every set and integrator, and every key of what a scene is made of.
set -u
aureole=$1
source=$2
plugins=$source/bench/peers/plugins
status=0
fail() {
  echo "FAIL: $*"
  status=1
}

# The rows of a listing that have a default: name, type, default and values between tabs.
defaults() { # defaults ARGUMENT_OF_HELP...
  "$aureole" help "$@" --format csv | awk -v quote='"' '
    NR > 1 {
      n = 0; text = $0
      while (n < 4) {
        if (substr(text, 1, 1) == quote) { end = index(substr(text, 2), quote ","); field[++n] = substr(text, 2, end - 1); text = substr(text, end + 3) }
        else { end = index(text, ","); field[++n] = substr(text, 1, end - 1); text = substr(text, end + 1) }
      }
      if (field[3] != "") printf "%s\t%s\t%s\t%s\n", field[1], field[2], field[3], field[4]
    }'
}

# --- options

cube='v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\n'
printf "$cube" >box.obj
"$aureole" points random -n 9 --domain sphere -o points.csv
"$aureole" points random -n 4 --domain sphere --seed 1 -o queries.csv
"$aureole" weights --lobe cosine --lobe2 ggx:0.3 -n 4 --table table --angles 2 --rotations 1 spherical-fibonacci >/dev/null || fail "a table"
box=$source/scenes/cornell-box/cornell-box.xml
printf '.3 .3 .3 0 0 1\n.7 .3 .2 0 1 0\n' >sensors.pts
printf 'solid s\nfacet normal 0 0 0\nouter loop\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 .5\nendloop\nendfacet\nendsolid s\n' >triangle.stl
printf 'OFF\n3 1 0\n-1 -1 0\n1 -1 0\n0 1 .5\n3 0 1 2\n' >triangle.off
printf '<scene version="3.0.0"><emitter type="constant"/><shape type="obj"><string name="filename" value="box.obj"/></shape></scene>' >open.xml
bash "$source/scripts/weather.sh" 48 11 1 | awk -F, -v OFS=, 'NF > 30 && $3 != 21 { $14 = $15 = $16 = 0 } { print }' >weather.epw
"$aureole" render "$box" -q --width 16 --spp 1 -o one.exr && "$aureole" render "$box" -q --width 16 --spp 1 --seed 1 -o two.exr ||
  fail "two images"

# What each command is tried on. An option may belong to some of the rows only; it must have been tried on one.
commands=(
  "sets"
  "points sobol -n 5"
  "points super-fibonacci -n 5 --domain rotations"
  "points file:points.csv -o result.npy"
  "measure sobol -n 16 --metric star,centered"
  "measure sobol -n 16"
  "measure points.csv --domain sphere --metric energy"
  "nearest spherical-fibonacci queries.csv -n 20"
  "voronoi spherical-fibonacci -n 12"
  "weights spherical-fibonacci -n 16 --domain sphere --method exact"
  "weights sobol -n 12 --lobe phong:5"
  "weights sobol -n 9 --report"
  "weights sobol -n 6 --lobe cosine --lobe2 phong:9 --angle 30"
  "weights spherical-fibonacci -n 4 --lobe cosine --lobe2 ggx:0.3 --table result"
  "weights --table table --lookup 20"
  "render $box -q --width 8 --samples 2 -o result.exr"
  "render small.xml -q -o result.exr"
  "render $box -q --width 8 --samples 2 -o result.exr --checkpoint kept"
  "irradiance box.xml --sensors sensors.pts -n 64"
  "irradiance open.xml --sensors box.obj -n 64 --reflected map"
  "irradiance open.xml --sensors sensors.pts --error 50% -o result.json"
  "irradiance open.xml --sensors sensors.pts -n 64 --weather weather.epw -o result.npy"
  "viewfactors box.obj --rays 64 --format csv"
  "viewfactors box.obj --radiosity .5 --sky 1 --format csv"
  "viewfactors box.obj --radiosity .5 --emission 1 --format csv"
  "viewfactors box.obj -o result.csv"
  "compare one.exr two.exr"
  "compare one.exr two.exr --metric flip -o result.png"
  "convert one.exr result.png"
  "view one.exr -o result.html"
  "lab list"
  "info points.csv"
  "help measure"
)
cp open.xml box.xml
sed "s|</scene>|<sensor type='perspective'><film type='hdrfilm'><integer name='width' value='8'/><integer name='height' value='8'/></film></sensor></scene>|" open.xml >small.xml

# Runs a command and prints its exit status and the sum of what it wrote.
sum() {
  rm -rf result result.*
  "$aureole" "$@" >output 2>words
  echo "$? $(cat output $(find . -name 'result*' -maxdepth 1 | sort) | cksum)"
}

# Where only a path can be written and the default is none.
is_place() {
  case $1 in weights\ -o* | render\ -o* | viewfactors\ -o* | view\ -o* | lab\ -o* | lab\ --scenes*) return 0 ;; esac
  return 1
}

for verb in $("$aureole" help --format csv 2>/dev/null | sed -n '/^  [a-z]/s/^  \([a-z]*\) .*/\1/p'); do
  [ "$verb" != set ] || break # the kinds come after the commands
  defaults verb "$verb" >options || fail "the options of $verb"
  while IFS=$'\t' read -r name type default values; do
    name=${name##*, } name=${name%%[ [=]*}
    is_place "$verb ${name/--output/-o}" && continue
    tried=0
    for command in "${commands[@]}"; do
      read -ra words <<<"$command"
      [ "${words[0]}" = "$verb" ] || continue
      [[ " $command " != *" $name "* ]] || continue
      case $name in
        --size | --count | --directions) [[ "$command" != *" -n "* ]] || continue ;;
        --output) [[ "$command" != *" -o "* ]] || continue ;;
      esac
      key="sum_${command//[^a-z0-9]/_}"
      [ -n "${!key:-}" ] || printf -v "$key" '%s' "$(sum "${words[@]}")"
      plain=${!key}
      [ "${plain%% *}" = 0 ] || [ "$verb" = compare ] || fail "aureole $command: status ${plain%% *}"
      spelled=$(sum "${words[@]}" "$name" "$default")
      [ "${spelled%% *}" != 2 ] || continue # it does not go with this command
      tried=1
      [ "$spelled" = "$plain" ] || fail "aureole $command $name '$default': another result"
    done
    [ $tried = 1 ] || fail "$verb $name '$default' is refused: $(cat words)"
  done <options
done

# --- keys of sets and integrators, all of a row at once; where some exclude each other, one after the other

same() { # same WORDS PLAIN SPELLED: two sums
  [ "$2" = "$3" ] || fail "$1: $3, not $2: $(cat words)"
}
spell() { # spell KIND ROW: key=default,...
  defaults "$1" "$2" | while IFS=$'\t' read -r name type default values; do
    case $default in *,*) default="($default)" ;; esac
    printf ',%s=%s' "$name" "$default"
  done | sed 's/^,/:/'
}
for set in $("$aureole" help set --format csv | tail -n +2 | cut -d, -f1); do
  keys=$(spell set "$set")
  [ -n "$keys" ] || continue
  for command in "-n 16" "-n 16 --domain hemisphere" "-n 16 --domain rotations" "-n 7 --dim 3 --domain cube"; do
    plain=$(sum points $set $command)
    [ "${plain%% *}" = 0 ] || continue
    same "$set$keys $command" "$plain" "$(sum points "$set$keys" $command)"
  done
done
for integrator in $("$aureole" help integrator --format csv | tail -n +2 | cut -d, -f1); do
  keys=$(spell integrator "$integrator")
  [ -n "$keys" ] || continue
  plain=$(sum render small.xml -q --spp 2 -o result.exr --integrator $integrator)
  same "$integrator$keys" "$plain" "$(sum render small.xml -q --spp 2 -o result.exr --integrator "$integrator$keys")"
done

# --- keys of what a scene is made of

# The elements that give a kind's row its defaults.
children() { # children KIND ROW
  defaults "$1" "$2" | while IFS=$'\t' read -r name type default values; do
    [ "$2:$name" != irradiancemeter:to_world ] || continue # it stands where its shape is
    case $type:$values in
      vector:*) tag=vector && [[ $default != *[a-z]* ]] || tag=string ;;
      boolean:* | integer:*) tag=$type ;;
      number:*) tag=float ;;
      color:*) tag=rgb ;;
      choice:* | text:* | item:*substance | item:millimetres) tag=string ;;
      item:*number*) tag=float ;;
      transform:*) echo "<transform name='$name'/>"; continue ;;
      item:bsdf) continue ;; # below
      item:*) echo "<$values name='$name' type='$default'/>"; continue ;;
    esac
    case $2:$name in projector:irradiance | normalmap:normalmap | bumpmap:texture | sun:sun_direction) continue ;; esac # given below
    echo "<$tag name='$name' value=\"$default\"/>"
  done
}

colour="<rgb name='reflectance' value='0.2 0.5 0.8'/>"
grey="<bsdf type='diffuse'/>"
coloured="<bsdf type='diffuse'>$colour</bsdf>"
picture="<texture type='bitmap' name='%s'><string name='filename' value='$plugins/picture.png'/></texture>"
# What a row must be given besides.
needs() { # needs KIND ROW
  case $1:$2 in
    bsdf:twosided | bsdf:mask | bsdf:*coating) echo "$coloured" ;;
    bsdf:blendbsdf) echo "$grey$coloured" ;;
    bsdf:bumpmap | bsdf:normalmap) printf "$grey$picture" "${2/bumpmap/texture}" ;;
    texture:bitmap) echo "<string name='filename' value='$plugins/picture.png'/>" ;;
    texture:mesh_attribute) echo "<string name='name' value='vertex_color'/>" ;;
    shape:obj | shape:serialized) echo "<string name='filename' value='$plugins/wave.$2'/>" ;;
    shape:stl | shape:off) echo "<string name='filename' value='$PWD/triangle.$2'/>" ;;
    shape:ply) echo "<string name='filename' value='$plugins/colored.ply'/>" ;;
    shape:*curve) echo "<string name='filename' value='$plugins/hair.txt'/>" ;;
    shape:polygon) echo "<string name='vertices' value='0 0 0 1 0 0 0 1 0'/>" ;;
    emitter:envmap) echo "<string name='filename' value='$plugins/picture.png'/>" ;;
    emitter:photometric)
      printf 'IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 50\n' >lamp.ies
      echo "<string name='filename' value='$PWD/lamp.ies'/>" ;;
    emitter:projector) printf "$picture" irradiance ;;
    sensor:thinlens) echo "<float name='aperture_radius' value='0.1'/><float name='focus_distance' value='3'/>" ;;
    phase:tabphase) echo "<string name='values' value='1, 2, 3'/>" ;;
    phase:blendphase) echo "<phase type='isotropic'/><phase type='hg'/><float name='weight' value='.3'/>" ;;
    volume:gridvolume) echo "<string name='filename' value='$plugins/smoke.vol'/>" ;;
    spectrum:regular) echo "<string name='values' value='.1, .2, .3'/>" ;;
    spectrum:irregular) echo "<string name='wavelengths' value='400, 500, 600'/><string name='values' value='.1, .2, .3'/>" ;;
    spectrum:blackbody) echo "<float name='temperature' value='3000'/>" ;;
    emitter:sun) echo "<vector name='sun_direction' value='0 1 1'/>" ;;
    sampler:matrices) echo "<string name='file' value='matrices.txt'/>" ;;
  esac
}
stage() { # stage FILM_AND_SAMPLER REST: a camera before what the rest says
  echo "<scene version='3.0.0'><sensor type='perspective'><transform name='to_world'>\
<lookat origin='.5,1,4' target='0,0,0' up='0,1,0'/></transform><float name='fov' value='50'/>$1</sensor>$2</scene>"
}
film="<film type='hdrfilm'><integer name='width' value='8'/><integer name='height' value='8'/></film>"
sky="<emitter type='constant'><rgb name='radiance' value='.4 .5 .6'/></emitter>"
scene() { # scene KIND ROW CONTENT
  local thing="<$1 type='$2'>$3</$1>" named="<$1 type='$2' name='%s'>$3</$1>"
  case $1:$2 in
    bsdf:*) stage "$film" "$sky<shape type='cube'>$thing</shape>" ;;
    texture:mesh_attribute)
      stage "$film" "$sky<shape type='ply'><string name='filename' value='$plugins/colored.ply'/><bsdf type='diffuse'>$(printf "$named" reflectance)</bsdf></shape>" ;;
    texture:* | spectrum:*) stage "$film" "$sky<shape type='sphere'><bsdf type='diffuse'>$(printf "$named" reflectance)</bsdf></shape>" ;;
    shape:*) stage "$film" "$sky$thing" ;;
    emitter:area | emitter:directionalarea) stage "$film" "<shape type='rectangle'>$thing</shape><shape type='sphere'/>" ;;
    emitter:*) stage "$film" "$thing<shape type='sphere'/>" ;;
    sensor:batch) return 1 ;;
    sensor:irradiancemeter) echo "<scene version='3.0.0'>$sky<shape type='sphere'><sensor type='$2'>$3$film</sensor></shape></scene>" ;;
    sensor:*) echo "<scene version='3.0.0'><sensor type='$2'>$3$film</sensor>$sky<shape type='sphere'><point name='center' x='1' y='0' z='3'/></shape></scene>" ;;
    film:*) stage "$thing<sampler type='sobol'><integer name='sample_count' value='1'/></sampler>" "<emitter type='constant'/>" ;;
    rfilter:*) stage "${film/<\/film>/$thing<\/film>}" "$sky<shape type='sphere'>$coloured</shape>" ;;
    sampler:*) stage "$film$thing" "$sky<shape type='sphere'>$coloured</shape>" ;;
    medium:*) stage "$film" "$sky<shape type='sphere'><bsdf type='null'/><medium name='interior' type='$2'>$3</medium></shape>" ;;
    phase:* | volume:*)
      stage "$film" "$sky<shape type='cube'><bsdf type='null'/><medium name='interior' type='heterogeneous'>$(printf "$named" "${1/volume/sigma_t}")</medium></shape>" ;;
  esac
}
tried=0
for kind in bsdf texture spectrum shape emitter sensor film rfilter sampler medium phase volume; do
  for row in $("$aureole" help $kind --format csv | tail -n +2 | cut -d, -f1); do
    spelled=$(children $kind $row)
    [ -n "$spelled" ] || continue
    [ $kind:$row != bsdf:twosided ] || spelled=$coloured
    needed=$(needs $kind $row)
    scene $kind $row "$needed" >made.xml || continue
    plain=$(sum render made.xml -q -o result.exr)
    [ $kind != sampler ] || [ "${plain%% *}" = 0 ] || continue # no set of the square
    [ "${plain%% *}" = 0 ] || fail "$kind $row: $(cat words)"
    scene $kind $row "$needed$spelled" >made.xml
    same "$kind $row: $spelled" "$plain" "$(sum render made.xml -q -o result.exr)"
    tried=$((tried + 1))
  done
done
[ $tried -ge 60 ] || fail "only $tried rows of what scenes are made of have been tried"
exit $status

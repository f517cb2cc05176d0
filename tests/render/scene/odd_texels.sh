#!/usr/bin/env bash
# Texels that are no radiance: infinite ones are the largest half, NaN and negative ones 0, in an environment, a projected image, an emitting
# surface and a material, each counted in a warning that names the file; heights of a bumpmap keep their sign.
set -u
aureole=$1
inf='\x00\x00\x80\x7f' nan='\x00\x00\xc0\x7f' minus='\x00\x00\xa0\xc0' one='\x00\x00\x80\x3f' zero='\x00\x00\x00\x00' largest='\x00\xe0\x7f\x47' five='\x00\x00\xa0\x40' half='\x00\x00\x00\x3f'

pfm() { # pfm NAME TEXEL...: 4 x 4 grey
  { printf 'Pf\n4 4\n-1\n'; for texel in "${@:2}"; do printf "$texel"; done; } >"$1.pfm"
}
rest="$one $half $one $one $half $one $one $one $one $half $one"
pfm odd $inf $nan $minus $inf $minus $rest
pfm finite $largest $zero $zero $largest $zero $rest
pfm deep $minus $five $zero $minus $one $rest

scene() { # scene NAME BODY
  echo "<scene version='3.0.0'><integrator type='path'><integer name='max_depth' value='3'/></integrator><sensor type='perspective'><float name='fov' value='60'/>
    <transform name='to_world'><lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'><integer name='width' value='8'/>
    <integer name='height' value='8'/></film></sensor>$2</scene>" >"$1.xml"
  "$aureole" render "$1.xml" --spp 4 -o "$1.exr" 2>"$1.said" || { echo "$1 is refused:"; cat "$1.said"; exit 1; }
}

ball="<shape type='sphere'/>"
texture() { echo "<texture type='bitmap' name='$1'><string name='filename' value='FILE.pfm'/>${2:-}</texture>"; }
for kind in envmap projector area spot; do
  case $kind in
  envmap) body="$ball<emitter type='envmap'><string name='filename' value='FILE.pfm'/></emitter>" ;;
  projector) body="$ball<emitter type='projector'><transform name='to_world'><lookat origin='1,1,5' target='0,0,0' up='0,1,0'/></transform>$(texture irradiance)</emitter>" ;;
  area) body="<shape type='rectangle'><emitter type='area'>$(texture radiance)</emitter></shape>" ;;
  spot) body="$ball<emitter type='spot'><transform name='to_world'><lookat origin='1,1,5' target='0,0,0' up='0,1,0'/></transform>$(texture texture)</emitter>" ;;
  esac
  for file in odd finite; do
    scene $file "${body//FILE/$file}"
  done
  cmp odd.exr finite.exr || { echo "$kind: another image than of 65504 and 0"; exit 1; }
  grep -q 'odd.pfm: infinite values are read as 65504: 2' odd.said && grep -q 'odd.pfm: values that are NaN are read as 0: 1' odd.said && grep -q 'odd.pfm: 2 negative' odd.said || { echo "$kind: no warning"; cat odd.said; exit 1; }
  ! grep -q 'finite.pfm' finite.said || { echo "$kind: a warning of what is right"; exit 1; }
done

# Heights: the sign is kept, so that the surface is that of the same heights raised by 5.
bump() { echo "<shape type='rectangle'><bsdf type='bumpmap'>$(texture heights "<boolean name='raw' value='true'/>")<bsdf type='diffuse'/></bsdf></shape><emitter type='directional'><vector name='direction' x='-1' y='-.5' z='-1'/></emitter>"; }
pfm raised $zero '\x00\x00\x20\x41' $five $zero '\x00\x00\xc0\x40' $(for texel in $rest; do [ $texel = $half ] && echo '\x00\x00\xb0\x40' || echo '\x00\x00\xc0\x40'; done)
body=$(bump)
for file in deep raised; do
  scene $file "${body//FILE/$file}"
done
"$aureole" compare deep.exr raised.exr --metric relative-rmse --tolerance 1e-5 >compared || { echo "heights below 0 are others"; cat compared; exit 1; }

# Channels that are no colour are refused by name where a colour is asked for, and the program says what it makes of values on the way.
"$aureole" convert odd.pfm odd.png 2>said && grep -q 'odd.pfm: 2 infinite, 1 NaN and 2 negative values: infinite ones become white' said || { cat said; exit 1; }
"$aureole" convert odd.pfm odd2.exr 2>said && grep -q '2 infinite, 1 NaN and 2 negative values: they are written as they are' said || { cat said; exit 1; }
"$aureole" convert odd2.exr back.pfm 2>said && cmp <(tail -c 64 odd.pfm) <(tail -c 64 back.pfm) || { echo "values changed on the way"; exit 1; }
"$aureole" convert finite.pfm finite.png 2>said && [ ! -s said ] || { cat said; exit 1; }
"$aureole" view odd.pfm -o odd.html >page 2>said && grep -q 'they are shown as they are' said || { cat said; exit 1; }

# Texels of which a part is in memory are the same; where their file cannot be, that is said.
{ printf 'PF\n256 256\n-1\n'; yes 'abcdefg' | tr '\n' '?' | head -c 786432; } >odd.pfm
scene odd "<shape type='rectangle'><emitter type='area'>$(texture radiance | sed s/FILE/odd/)</emitter></shape>"
"$aureole" render odd.xml --spp 4 --texture-memory 4M -o paged.exr && cmp odd.exr paged.exr || { echo "another image with --texture-memory"; exit 1; }
TMPDIR=/nowhere "$aureole" render odd.xml --spp 4 --texture-memory 4M -o paged.exr 2>said && { echo "a file in no folder"; exit 1; }
grep -q '/nowhere: a temporary file for textures: No such file' said || { cat said; exit 1; }
"$aureole" render odd.xml --texture-memory much 2>said && exit 1
grep -q -- "--texture-memory: expected a size in bytes, or such as 500M or 2G, not 'much'" said || { cat said; exit 1; }

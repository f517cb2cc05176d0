#!/usr/bin/env bash
# A scene renders alike wherever it stands. White furnaces, whose radiance is 1 everywhere: with 8 independent seeds the mean must
# be above .999 (.99 for grounds, which have more noise), and within t standard errors of 1, t = 7.89 the quantile of Student's t with
# 7 degrees of freedom for 1e-4.
# `--error` holds there: of 12 images to 4 % with 95 % confidence no more than 3 have a larger error (a chance of .002).
# Rooms: the means of two places differ by less than 5 standard errors (chance 6e-7 each).
. "$(dirname "$0")/common.sh.inc"

# render_seeds NAME SCENE ARGUMENTS...: means of 8 seeds.
render_seeds() {
  local name=$1 scene=$2
  shift 2
  for seed in $(either 1 "1 2 3 4 5 6 7 8"); do
    "$aureole" render "$scene" -q --seed $seed -o $name.pfm "$@" || { fail "$name: render"; return; }
    mean $name.pfm $name.pfm
  done
}

judge_furnace() { # NAME [LEAST]
  tr '\n' ' ' | judge -v name="$1" -v least=${2:-.999} '
    { for (i = 1; i <= NF; ++i) { sum += $i; squares += $i * $i }
      mean = sum / NF; variance = (squares - NF * mean * mean) / (NF - 1); if (variance < 0) variance = 0
      error = sqrt(variance / NF); off = mean - 1
      printf "%s: %.6f +- %.6f\n", name, mean, error
      exit !(NF == 8 && mean > least && off * off <= (7.89 * error + 1e-4) ^ 2) }' || fail "$1"
}

cat >furnace.xml <<'XML'
<scene version="3.0.0"><default name="x" value="0"/><default name="shape" value="sphere"/>
  <integrator type="path"/>
  <sensor type="perspective"><float name="fov" value="90"/>
    <transform name="to_world"><lookat origin="0, 0, 0" target="1, .3, 1" up="0, 1, 0"/><translate x="$x" y="$x"/></transform>
    <film type="hdrfilm"><integer name="width" value="12"/><integer name="height" value="12"/></film>
    <sampler type="independent"><integer name="sample_count" value="64"/></sampler></sensor>
  <shape type="$shape"><transform name="to_world"><scale value="5"/><translate x="$x" y="$x"/></transform>
    <boolean name="flip_normals" value="true"/>
    <bsdf type="diffuse"><rgb name="reflectance" value=".5"/></bsdf><emitter type="area"><rgb name="radiance" value=".5"/></emitter></shape>
  <shape type="obj"><string name="filename" value="speck.obj"/></shape></scene>
XML
# A town around the middle of the world, whose floats are those of rooms far away: recentring cannot help there.
town() { awk 'BEGIN { for (i = 0; i < 10000; ++i) { x = i % 100 - 50; y = int(i / 100) - 50
  printf "v %d %d -50\nv %d %d -50\nv %d %d -50\nf -3 -2 -1\n", x, y, x + 1, y, x, y + 1 } }'; }

printf 'v -1000 0 0\nv -1000.01 0 0\nv -1000 .01 0\nf 1 2 3\n' >speck.obj
for shape in sphere cube; do
  for x in 1e3 1e6 1e7; do
    render_seeds furnace furnace.xml -D x=$x -D shape=$shape | judge_furnace "$shape at $x"
  done
done
for seed in $(either "" "$(seq 12)"); do
  "$aureole" render furnace.xml -q --error 4% --integrator path -D x=5400000.3 -D shape=cube --seed $seed -o asked.pfm || fail "--error"
  tail -c $((12 * 12 * 12)) asked.pfm | od -An -v -t f4 -w4
  echo end
done | awk '/end/ { if (sqrt(sum / n) > .04) ++missed; n = sum = 0; next } { sum += ($1 - 1) ^ 2; ++n }
  END { exit missed > 3 }' || fail "--error at map coordinates"
town >speck.obj
for shape in sphere cube; do
  for integrator in path path:packets=false volpath; do
    render_seeds furnace furnace.xml -D x=1e4 -D shape=$shape --integrator $integrator |
      judge_furnace "$shape 2000 radii from a town, $integrator"
  done
done

# A white ground under a white sky, large and tilted, seen from near its middle, which is near the origin.
cat >tilted.xml <<'XML'
<scene version="3.0.0"><default name="size" value="1"/><default name="shape" value="rectangle"/><integrator type="path"/>
  <sensor type="perspective"><float name="fov" value="70"/>
    <transform name="to_world"><lookat origin=".02, 0, .1" target="0, 0, 0" up="0, 1, 0"/><scale value="$size"/><rotate x="1" y="2" z="-1" angle="40"/></transform>
    <film type="hdrfilm"><integer name="width" value="12"/><integer name="height" value="12"/></film>
    <sampler type="independent"><integer name="sample_count" value="128"/></sampler></sensor>
  <emitter type="constant"/>
  <shape type="$shape"><transform name="to_world"><translate x="-.13" y=".21"/><scale value="$size"/><rotate x="1" y="2" z="-1" angle="40"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="1"/></bsdf></shape></scene>
XML
for integrator in path path:packets=false volpath direct finalgather:photons=1000,diffuse_samples=16 \
                  finalgather-lab:photons=1000,diffuse_samples=16,packets=false; do
  for ground in "rectangle 1" "rectangle 1e4" "disk 1e4"; do
    read -r shape size <<<"$ground"
    render_seeds tilted tilted.xml -D size=$size -D shape=$shape --integrator $integrator |
      judge_furnace "a tilted $shape of $size, $integrator" .99
  done
done

# A room with a lamp, a sphere and a pillar at map coordinates.
cat >room.xml <<'XML'
<scene version="3.0.0"><default name="x" value="0"/><default name="y" value="0"/><default name="z" value="0"/>
  <integrator type="path"/>
  <sensor type="perspective"><float name="fov" value="80"/>
    <transform name="to_world"><lookat origin="-1.8, -2, 1.6" target="1, 1, 1" up="0, 0, 1"/><translate x="$x" y="$y" z="$z"/></transform>
    <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film>
    <sampler type="independent"><integer name="sample_count" value="64"/></sampler></sensor>
  <bsdf type="diffuse" id="white"><rgb name="reflectance" value=".6"/></bsdf>
  <shape type="cube"><transform name="to_world"><scale x="2" y="2.5" z="1.5"/><translate z="1.5"/><translate x="$x" y="$y" z="$z"/></transform>
    <boolean name="flip_normals" value="true"/><ref id="white"/></shape>
  <shape type="sphere"><transform name="to_world"><scale value=".4"/><translate x=".5" y=".3" z=".4"/><translate x="$x" y="$y" z="$z"/></transform><ref id="white"/></shape>
  <shape type="cylinder"><transform name="to_world"><scale x=".2" y=".2" z="3"/><translate x="-.5" y="1"/><translate x="$x" y="$y" z="$z"/></transform><ref id="white"/></shape>
  <shape type="rectangle"><transform name="to_world"><scale value=".5"/><rotate x="1" angle="180"/><translate z="2.9"/><translate x="$x" y="$y" z="$z"/></transform>
    <emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>
  <emitter type="point"><point name="position" x="-1" y="-1" z="2"/><transform name="to_world"><translate x="$x" y="$y" z="$z"/></transform><rgb name="intensity" value="1"/></emitter>
</scene>
XML
for integrator in path finalgather:photons=20000,diffuse_samples=16 volpath; do
  seeds=1000
  for place in "0 0 0" "1e5 1e5 0" "2600000 1200000 408.3" "500000.3 5400000.7 113" "-1e7 1e7 1e7"; do
    read -r x y z <<<"$place"
    seeds=$((seeds + 100))
    for seed in $(either 1 "1 2 3 4 5 6 7 8"); do
      "$aureole" render room.xml -q --seed $((seeds + seed)) --integrator $integrator -o room.pfm -D x=$x -D y=$y -D z=$z ||
        fail "$integrator at $place"
      echo "$x,$y,$z $(mean room.pfm room.pfm)"
    done
  done >means
  judge -v name=$integrator '
    { ++count[$1]; sum[$1] += $2; squares[$1] += $2 * $2 }
    END { for (at in sum) { n = count[at]; mean[at] = sum[at] / n
            variance += (squares[at] - n * mean[at] ^ 2) / (n - 1); ++places }
          error = sqrt(2 * variance / places / 8)
          for (at in mean) { off = (mean[at] - mean["0,0,0"]) / error; printf "%s at %s: %.6g, z = %.2f\n", name, at, mean[at], off
            bad += off > 5 || off < -5 }
          exit bad > 0 || places != 5 }' means || fail "$integrator"
done
exit $((failures > 0))

#!/usr/bin/env bash
# Final gathering where the glossy lobe is a texture that is black at (0, 0), alone and below three masks, in a box all of
# that material: the means of finalgather over 8 seeds are those of path within 5.41 standard errors (Student's t with 7
# degrees of freedom, a chance of 1e-3), by gather rays that meet lights alone (both exact but for noise and the .2 % of
# patterns that are turned only), and with photons (.5 % for the density estimate).
. "$(dirname "$0")/common.sh.inc"
cat >box.xml <<'XML'
<scene version="3.0.0">
  <default name="material" value="wall"/>
  <integrator type="path"/>
  <sensor type="perspective"><float name="fov" value="60"/>
    <transform name="to_world"><lookat origin="0.1, -0.1, -0.9" target="0, 0, 1" up="0, 1, 0"/></transform>
    <sampler type="sobol"><integer name="sample_count" value="16"/></sampler>
    <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/><rfilter type="box"/></film>
  </sensor>
  <bsdf type="phong_lobe" id="lobe"><float name="exponent" value="25"/>
    <rgb name="diffuse_reflectance" value="0.2"/>
    <texture type="checkerboard" name="specular_reflectance">
      <rgb name="color0" value="0"/><rgb name="color1" value="0.7"/></texture></bsdf>
  <bsdf type="twosided" id="wall"><ref id="lobe"/></bsdf>
  <bsdf type="mask" id="masked"><float name="opacity" value="0.9"/>
    <bsdf type="mask"><float name="opacity" value="0.8"/>
      <bsdf type="mask"><float name="opacity" value="0.9"/><ref id="wall"/></bsdf></bsdf></bsdf>
  <shape type="cube"><ref id="$material"/></shape>
  <shape type="cube"><transform name="to_world"><scale value="2"/></transform><ref id="wall"/></shape>
  <shape type="rectangle"><transform name="to_world"><scale value="0.4"/><rotate x="1" angle="90"/>
    <translate y="0.98"/></transform><emitter type="area"><rgb name="radiance" value="9, 9, 9"/></emitter></shape>
</scene>
XML

# agree NAME BIAS PATH GATHER ARGUMENTS...
agree() {
  local name=$1 bias=$2 path=$3 gather=$4 means=
  shift 4
  for seed in 1 2 3 4 5 6 7 8; do
    "$aureole" render box.xml -q --seed $seed --spp 64 --integrator "$path" -o path.pfm "$@" &&
      "$aureole" render box.xml -q --seed $seed --spp 16 --integrator "$gather" -o gather.pfm "$@" || fail "$name: render"
    means="$means $(mean path.pfm path.pfm) $(mean path.pfm gather.pfm)"
  done
  echo "$means" | awk -v name="$name" -v bias="$bias" '
    { for (i = 1; i <= NF; i += 2) { d = $(i + 1) - $i; n += 1; path += $i; sum += d; squares += d * d }
      off = sum / n; error = sqrt((squares / n - off * off) / (n - 1)); path /= n; allowed = 5.41 * error + bias * path
      printf "%s: path %.6f, finalgather %+.6f off (%.6f allowed)\n", name, path, off, allowed
      exit !(n == 8 && off <= allowed && off >= -allowed) }' || fail "$name"
}

for material in wall masked; do
  agree "$material-two" 0.002 path:max_depth=2 \
    finalgather-lab:direct=gather,incident=emitters,max_depth=2,density=same,decorrelation=random -D material=$material
  agree "$material" 0.005 path finalgather-lab:photons=100000,glossy_samples=128,decorrelation=random -D material=$material
done
exit $((failures > 0))

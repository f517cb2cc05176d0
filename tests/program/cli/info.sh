#!/usr/bin/env bash
# aureole info tells scenes, images and points apart by their content, and describes each.
set -u
aureole=$1
status=0
rm -rf ./*

fail() { echo "FAILED: $*"; status=1; }
# says FILE TEXT: the output has this line
says() {
  local file=$1 text=$2
  "$aureole" info "$file" --format csv >out 2>err || fail "info $file: $(cat err)"
  grep -qxF -- "$text" out || fail "info $file: '$text' is not in: $(cat out)"
}
refuses() {
  "$aureole" info "$@" >out 2>err
  [ $? = 2 ] || fail "info $*: exit status is not 2"
  [ "$(wc -l <err)" = 1 ] || fail "info $*: not one line: $(cat err)"
}

# A cube is 12 triangles in [-1,1]^3, a rectangle two; names do not matter.
cat >scene.txt <<'XML'
<scene version="3.0.0">
  <default name="width" value="32"/>
  <integrator type="path"/>
  <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="$width"/>
    <integer name="height" value="16"/><rfilter type="box"/></film></sensor>
  <shape type="cube"/>
  <shape type="rectangle"><emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
</scene>
XML
"$aureole" info scene.txt --format csv -D width=48 >out || fail "scene"
described=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) name[i] = $i }
  NR == 2 { for (i = 1; i <= NF; ++i) value[name[i]] = $i;
            print value["shapes"], value["triangles"], value["emitters"], value["width"], value["height"],
                  value["lower_x"], value["upper_z"], value["filter"], value["integrator"] }' out)
[ "$described" = "2 14 1 48 16 -1 1 box path" ] || fail "scene: $described"

# What render refuses of an integrator, info refuses in the same words.
for change in 's/"path"/"pth"/' 's/type="path"\/>/type="path"><integer name="max_dept" value="3"\/><\/integrator>/'; do
  sed -e "$change" scene.txt >unknown.xml
  for verb in info "render -o unknown.exr"; do
    # shellcheck disable=SC2086
    "$aureole" $verb unknown.xml >/dev/null 2>"said-${verb%% *}"
    [ $? = 2 ] || fail "$verb: $change: not refused"
  done
  cmp -s said-info said-render || fail "$change: info and render refuse in other words"
done

printf 'Pf\n2 1\n-1\n\x00\x00\x80\x3f\x00\x00\x40\x40' >picture.csv
says picture.csv "PFM,2,1,Y,1,2,3,0"
printf 'Pf\n2 1\n-1\n\x00\x00\xc0\x7f\x00\x00\x40\x40' >picture.csv
says picture.csv "PFM,2,1,Y,3,3,3,1"
printf 'Pf\n2 1\n-1\n\x00\x00\x40\xc0\x00\x00\x80\x3f' >picture.csv
says picture.csv "PFM,2,1,Y,-3,-1,1,0"
printf 'u,v\n0.25,0\n0.75,0.5\n' >points.xml
says points.xml "square,2,u,0.25,0.5,0.75,0"
says points.xml "square,2,v,0,0.25,0.5,0"
printf 'x,y,z,w\n0,0,1,0.5\n1,0,0,0.5\n' >points.exr
says points.exr "hemisphere,2,w,0.5,0.5,0.5,0"

# What comes by standard input is described in the same words.
for file in scene.txt picture.csv points.xml points.exr; do
  "$aureole" info "$file" >expected && "$aureole" info - <"$file" >out && cmp -s expected out || fail "info - <$file"
done
seq -f %.6f,0.5 0 0.0001 0.9999 >many.csv # more than one piece
"$aureole" info many.csv >expected && cat many.csv | "$aureole" info - >out && cmp -s expected out || fail "info - of many points"
refuses - </dev/null

# A solution of radiosity is no scene of Radiance's, whatever it is called.
"$aureole" render scene.txt -q --width 4 --spp 1 -o solved.exr --integrator radiosity:epsilon=0.5,save=solved.rad || fail "radiosity"
says solved.rad "solution of radiosity,render --integrator radiosity:load=FILE"

refuses missing.exr
refuses .
: >empty
refuses empty
refuses points.exr points.xml
refuses points.xml --format yaml
printf '<scene>' >broken.xml
refuses broken.xml
exit $status

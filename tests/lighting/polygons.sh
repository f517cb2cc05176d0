#!/usr/bin/env bash
# Concave faces, whichever corner is first and whichever way they go round, in every format: closed forms of an L-shaped room, an
# arrow under a plate, and sensors on the faces.
. "$2/tests/lighting/checks.sh.inc"

# turned SHIFT x y z x y z ...: the corners from number SHIFT on.
turned() {
  local shift=$((3 * $1)) corners=("${@:2}")
  echo "${corners[@]:shift}" "${corners[@]:0:shift}"
}

# Faces stand as lines "NAME x y z x y z ..." on standard input.
obj() { awk '{ print "g " $1; f = "f"; for (i = 2; i < NF; i += 3) { print "v", $i, $(i + 1), $(i + 2); f = f " " ++n }; print f }'; }
off() { awk '{ for (i = 2; i < NF; i += 3) { v = v $i " " $(i + 1) " " $(i + 2) "\n"; ids = ids " " n++ }; f = f (NF - 1) / 3 ids "\n"; ids = "" }
             END { printf "OFF %d %d 0\n%s%s", n, NR, v, f }'; }
ply() { awk '{ for (i = 2; i < NF; i += 3) { v = v $i " " $(i + 1) " " $(i + 2) "\n"; ids = ids " " n++ }; f = f (NF - 1) / 3 ids "\n"; ids = "" }
             END { printf "ply\nformat ascii 1.0\nelement face %d\nproperty list uchar int vertex_indices\nelement vertex %d\nproperty float x\n" \
                          "property double y\nproperty float z\nend_header\n%s%s", NR, n, f, v }'; }
rad() { awk '{ printf "void plastic m%d 0 0 5 .5 .5 .5 0 0\nm%d polygon %s 0 0 %d", NR, NR, $1, NF - 1; $1 = ""; print }'; }
xml() { awk 'BEGIN { print "<scene version=\"3.0.0\">" }
             { printf "<shape type=\"polygon\" id=\"%s\"><string name=\"vertices\" value=\"", $1; $1 = ""; print $0 "\"/></shape>" }
             END { print "</scene>" }'; }

# The room: floor and ceiling of 3, walls of 2 and 1. With emission 1 and reflectance .5 each radiosity is 2.
room() { # room SHIFT
  echo s0 $(turned "$1" 2 1 0 1 1 0 1 2 0 0 2 0 0 0 0 2 0 0)
  echo s1 $(turned "$1" 2 0 1 0 0 1 0 2 1 1 2 1 1 1 1 2 1 1)
  echo s2 0 0 0 0 0 1 2 0 1 2 0 0
  echo s3 2 0 0 2 0 1 2 1 1 2 1 0
  echo s4 2 1 0 2 1 1 1 1 1 1 1 0
  echo s5 1 1 0 1 1 1 1 2 1 1 2 0
  echo s6 1 2 0 1 2 1 0 2 1 0 2 0
  echo s7 0 2 0 0 2 1 0 0 1 0 0 0
}
back() { awk '{ line = $1; for (i = NF - 2; i > 1; i -= 3) line = line " " $i " " $(i + 1) " " $(i + 2); print line }'; }

for shift in 0 1 2 3 4 5; do
  for format in obj off ply rad xml; do
    for way in cat back; do
      room $shift | $way | $format >room.$format
      # inside out, the backs see: rows 0 to 7 are the fronts
      sides=$([ $way = back ] && echo --both-sides)
      group=$([ $format = ply ] || [ $format = off ] || echo --group)
      "$aureole" viewfactors room.$format $group $sides --radiosity .5 --sky 0 --emission 1 2>message.txt >room.csv ||
        { fail "room.$format from $shift: $(cat message.txt)"; continue; }
      grep -v "edges\|backs" message.txt && fail "room.$format from $shift says: $(cat message.txt)"
      awk -F, -v way=$way 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
          NR > 1 { if (way == "cat" || $column["row"] + 0 >= rows / 2) if (($column["radiosity"] - 2) ^ 2 > 1e-8) bad = 1; sum += $column["area"] }
          END { if ((sum - (way == "cat" ? 14 : 28)) ^ 2 > 1e-8) bad = 1; exit bad }' rows=$(($(wc -l <room.csv) - 1)) room.csv ||
        fail "room.$format from $shift, $way: $(cat room.csv)"
    done
  done
done

# An arrow under a plate: F = .58452916 by the contour integral, which is that of the two triangles with the notch's corner first.
for shift in 0 1 2 3; do
  for format in obj rad xml; do
    { echo arrow $(turned $shift 0 2 0 0.5 0 0 0 -2 0 2 0 0); echo plate 0 -2 1 0 2 1 2 2 1 2 -2 1; } | $format >arrow.$format
    "$aureole" viewfactors arrow.$format --group --to csv 2>/dev/null |
      awk -F, '$1 == 0 && $2 == 1 { found = ($3 - .58452916120178) ^ 2 < 1e-20 } END { exit !found }' || fail "arrow.$format from $shift"
  done
done

# Sensors stand within the face, and look the same way: light from above reaches all of them, or none.
echo "<scene version='3.0.0'><emitter type='directional'><vector name='direction' value='0 0 -1'/><rgb name='irradiance' value='3'/>
</emitter><shape type='sphere'><point name='center' value='9 9 9'/></shape></scene>" >sky.xml
for shift in 0 1 2 3 4 5; do
  for way in cat back; do
    room $shift | head -1 | $way | obj >floor.obj
    "$aureole" irradiance sky.xml --sensors floor.obj -n 16 2>message.txt >floor.csv || fail "sensors: $(cat message.txt)"
    awk -F, -v light=$([ $way = cat ] && echo 3 || echo 0) 'NR == 1 { next }
      { ++count; if ($1 <= 0 || $2 <= 0 || $1 >= 2 || $2 >= 2 || ($1 >= 1 && $2 >= 1) || ($4 - light) ^ 2 > 1e-10) bad = 1 }
      END { exit bad || count != 4 }' floor.csv || fail "sensors from $shift, $way: $(cat floor.csv message.txt)"
  done
done

# Facets without area have no sensor, and refuse nothing.
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 2 3 2\n' >thin.obj
"$aureole" irradiance sky.xml --sensors thin.obj -n 16 2>message.txt >thin.csv && [ "$(wc -l <thin.csv)" -eq 2 ] &&
  grep -q 'thin.obj:5: 1 facets have no area' message.txt && grep -q 'thin.obj:7: 1 of 3 faces have no area and are left out (face 2 is' message.txt ||
  fail "facets without area: $(cat message.txt thin.csv)"
finish

#!/usr/bin/env bash
# The programs of examples/ know the public headers alone and are short; each compiles and runs as its first comment says,
# and this file has what must come out.
set -u
build=$(dirname "$1")
source_tree=$2
[ -e "$build/libaureole.so" ] || { echo "skipped: the libraries are static"; exit 77; }
fail() { echo "$*"; exit 1; }
cc=$(sed -n 's/^CMAKE_C_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")

flags=$(sed -n 's/^AUREOLE_SANITIZE:[^=]*=\([a-z][a-z,]*\)$/-fsanitize=\1/p' "$build/CMakeCache.txt")
for file in "$source_tree"/examples/*.c; do
  name=$(basename "$file" .c)
  [ "$(wc -l <"$file")" -lt 100 ] || fail "$name.c: 100 lines or more"
  grep -q '#include "' "$file" && fail "$name.c: includes more than <...>"
  # what it is linked with stands in its first comment
  read -ra libraries <<<"$(sed -n "s|.*cc examples/$name.c \(.*\) -o $name .*|\1|p" "$file")"
  [ ${#libraries[@]} -gt 0 ] || fail "$name.c does not say how it is compiled"
  "$cc" -std=c17 -Wall -Wextra -Werror $flags -I "$source_tree/include" "$file" -o "$name" -L "$build" "${libraries[@]}" \
    -Wl,-rpath,"$build" || fail "$name.c does not compile"
  ./"$name" >"$name.txt" || fail "$name failed"
done

# The error is within three intervals, which are a thousandth of the power.
awk '$1 == "power" { power = $2 } $1 == "interval" { interval = $2 } $1 == "off" { off = $3 }
     END { exit !(power > 0 && interval <= 1e-3 * power && off <= 3 * interval) }' integrate.txt || fail "$(cat integrate.txt)"
grep -q "ended by *the tolerance" integrate.txt || fail "$(cat integrate.txt)"

# The mean square of the shift is delta^2 / 5, to a part in 10^5 from the even set.
awk '$1 == "spherical-fibonacci" { exit !($3 < 1e-3 && $3 > -1e-3 && $6 > 179.99 && $6 < 180.01) }' powder.txt || fail "$(cat powder.txt)"
# Six values of q; the rods' peak of width 1/(q L) is the least smooth at the largest.
awk '{ off = $4 - $6 } off > 6e-4 || off < -6e-4 { bad = 1 } END { exit bad || NR != 6 }' cylinder.txt || fail "$(cat cylinder.txt)"
# No direction is turned by more than the covering radius of 64 charges at rest, .30.
awk '$1 == "flux" { off = $2 - $4; flux = off < 1e-6 && off > -1e-6 } $1 == "turned" { turned = $2 < 0.31 && $4 < $2 }
     END { exit !(flux && turned) }' transport.txt || fail "$(cat transport.txt)"
# 32 charges at rest are the corners and faces of an icosahedron, exact to degree 5.
awk '$1 == "charges" { exit !($2 < 1e-7) }' ambisonics.txt || fail "$(cat ambisonics.txt)"
# The interval is a ten-thousandth of the factor, and the error within three of them.
awk '{ value[$1] = $2 } END { off = value["off"]; half = value["interval"]
       exit !(half > 0 && half <= 1e-4 * value["factor"] && off <= 3 * half && off >= -3 * half) }' estimate.txt || fail "$(cat estimate.txt)"
# The error of random axes, told by turning them, is within four of itself.
awk '$1 == "random" { exit !($8 > 0 && ($6 - 180) < 4 * $8 && ($6 - 180) > -4 * $8) }' powder.txt || fail "$(cat powder.txt)"
# One ray of 256 is .004; random directions are off by a standard deviation of .027.
awk '{ off = $2 - 0.75 } off > 0.004 || off < -0.004 { exit 1 }' occlusion.txt || fail "$(cat occlusion.txt)"
# The radiance is smooth: optimal weights take away a third of the error and more.
awk '!($4 > 0 && $4 < 0.67 * $2) { exit 1 }' gather.txt || fail "$(cat gather.txt)"
# A grey sphere below an even sky has the radiance of its reflectance, within three errors.
awk '{ off = $2 / 0.5 - 1; exit !($4 > 0 && $4 <= 0.02 && off < 3 * $4 && off > -3 * $4) }' image.txt || fail "$(cat image.txt)"
# 40 equal cells of the cap of 110 degrees have a radius of 15 degrees; at the rim covering is at most twice as much.
awk '$1 == "covering" { good = $2 > 15 && $2 < 30 && $4 > 20 && $4 < 30 } END { exit !(good && NR == 41) }' views.txt || fail "$(tail -1 views.txt)"
# 65536 equal cells have a radius of .45 degrees.
awk '!($2 > 0.4 && $2 < 0.6 && $2 < $5 && $3 < $6) { exit 1 }' normals.txt || fail "$(cat normals.txt)"
awk '{ off = $2 - $7; exit !(off < 3e-4 * $7 && off > -3e-4 * $7) }' environment.txt || fail "$(cat environment.txt)"
# A set from a file has the bits of the arrays that it was written from.
awk '{ $1 == "custom" ? custom = $2 $3 $4 : $1 == "file:custom.npy" ? filed = $2 $3 $4 : 0 }
     $4 - 0.25 > 2e-3 || 0.25 - $4 > 2e-3 { bad = 1 } END { exit !(custom == filed && !bad && NR == 3) }' custom_set.txt || fail "$(cat custom_set.txt)"
awk '{ off = $NF - 1 } off > 1e-9 || off < -1e-9 { bad = 1 } $1 == "floor" { up = $3 } $1 == "ceiling" { down = $2 }
     END { exit bad || NR != 6 || up != down }' room.txt || fail "$(cat room.txt)"
exit 0

#!/usr/bin/env bash
# Sets of one's own: a file for each size, in the lab, in measure and in a renderer; weights of a file; prefixes are told.
set -u
aureole=$1
source=$2
status=0
fail() { echo "FAILED: $*"; status=1; }
mkdir folder
for n in 8 16 32 64 128 256 512 1024; do
  "$aureole" points spherical-fibonacci -n $n --domain sphere -o sphere-$n.csv || fail "points"
  "$aureole" points spherical-fibonacci -n $n --domain hemisphere -o folder/h$n.npy || fail "points"
done

# A set for each size is that set, in measures and in the lab.
for set in 'file:sphere-%d.csv' spherical-fibonacci; do
  "$aureole" measure "$set" -n 64,128,1024 -m energy --domain sphere --format csv | cut -d, -f2- >"measure-${set%%:*}.txt" || fail "measure $set"
done
cmp measure-file.txt measure-spherical-fibonacci.txt || fail "measure"
"$aureole" measure 'file:sphere-%d.csv' -m energy >none.txt 2>&1 && fail "no size"
grep -q 'size\|-n is missing' none.txt || fail "$(cat none.txt)"
"$aureole" lab run marques-2019-discrepancy --quick -q --set 'file:sphere-%d.csv' -o results >run.txt 2>&1 || fail "$(cat run.txt)"
for set in spherical-fibonacci 'file:sphere-%d.csv'; do
  grep "^$set," results/marques-2019-discrepancy/marques-2019-discrepancy.csv | cut -d, -f2- >"lab-${set%%:*}.txt"
  [ -s "lab-${set%%:*}.txt" ] || fail "no row of $set"
done
cmp lab-file.txt lab-spherical-fibonacci.txt || fail "lab"

# Directions are rotated where they cannot be shifted: every 2018 experiment on weights takes them.
for experiment in gains slopes beyond sensitivity fig7; do
  "$aureole" lab run marques-2018-$experiment --quick -q --set file:folder -o results >run.txt 2>&1 || fail "$experiment: $(cat run.txt)"
  grep -q "^file:folder\|file:folder " run.txt || fail "$experiment has no row of file:folder"
  grep "left out" run.txt && fail "$experiment leaves file:folder out"
done

# The first points of a file are told of.
"$aureole" lab run domains-prefixes --quick -q --set file:sphere-1024.csv -o results >run.txt 2>&1 || fail "$(cat run.txt)"
grep -q 'file:sphere-1024.csv is one file of 1024 points' run.txt || fail "a prefix is not told of"
"$aureole" lab run domains-prefixes --quick -q --set 'file:none-%d.csv' -o results >run.txt 2>&1 && fail "no file at all"

# Weights of a file are used: every direction twice, with weights 1.5 and .5 of 1/N, is every direction once.
awk -F, 'NR == 1 { sub(/,?#.*/, ""); print $0 ",w"; next } { print $0 ",0.01171875" > "first"; print $0 ",0.00390625" > "second" }' \
  <("$aureole" points spherical-fibonacci -n 64 --domain hemisphere) >twice.csv
cat first second >>twice.csv
"$aureole" points spherical-fibonacci -n 64 --domain hemisphere -o once.csv
for file in once twice; do
  n=$(($(wc -l <$file.csv) - 1))
  "$aureole" render "$source/scenes/cornell-box/cornell-box.xml" --width 16 --height 16 --spp 1 -q -o $file.exr --integrator \
    "finalgather:pattern=file:$file.csv,diffuse_samples=$n,photons=20000,short_rays=0,direct=none" 2>render.txt || fail "$file: $(cat render.txt)"
done
rmse=$("$aureole" compare once.exr twice.exr --metric rmse --format csv | tail -1 | cut -d, -f2)
awk -v r="$rmse" 'BEGIN { exit !(r != "" && r < 1e-6) }' || fail "weights of a pattern: rmse $rmse"
"$aureole" render "$source/scenes/cornell-box/cornell-box.xml" --width 16 --spp 1 -q -o ao.exr --integrator "ao:pattern=file:twice.csv,samples=128" \
  >ao.txt 2>&1 && fail "ao counts directions"
grep -q 'have weights' ao.txt || fail "$(cat ao.txt)"
exit $status

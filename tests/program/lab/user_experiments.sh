#!/usr/bin/env bash
# Experiments outside of the tree: the example's module in C, and aureole-integrand and aureole-scene with functions and scenes of one's own.
set -u
aureole=$1
source=$2
build=$(dirname "$1")
status=0
fail() { echo "FAILED: $*"; status=1; }
[ -e "$build/libaureole-lab.so" ] || { echo "skipped: the libraries are static"; exit 77; }
cc=$(sed -n 's/^CMAKE_C_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")
"$cc" -std=c17 -Wall -Wextra -Werror -shared -fPIC -I "$source/include" "$source/examples/lab/custom_experiment.c" -o custom_experiment.so ||
  { echo "the example does not compile"; exit 1; }
own=(--module custom_experiment.so -q -o results)
"$aureole" lab list --module custom_experiment.so | grep -q custom-distances || fail "the list"
"$aureole" lab run custom-distances --set fibonacci-lattice "${own[@]}" >run.txt 2>&1 || fail "$(cat run.txt)"
grep -q 'claim: golden points.*: holds' run.txt || fail "$(cat run.txt)"
# The rows are what the program measures.
distance=$("$aureole" measure hammersley -n 64 -m min-distance --domain square --format csv | tail -1 | cut -d, -f4)
awk -F, -v d="$distance" '$1 == "hammersley" && $2 == 64 { off = $3 - 8 * d; found = off < 1e-12 && off > -1e-12 } END { exit !found }' \
  results/custom-distances/custom-distances.csv || fail "$(cat results/custom-distances/custom-distances.csv)"
[ "$(grep -c '^callback:golden,' results/custom-distances/custom-distances.csv)" = 4 ] || fail "sizes"
"$aureole" lab run custom-distances -D largest=64 "${own[@]}" >run.txt 2>&1 || fail "$(cat run.txt)"
[ "$(grep -c '^callback:golden,' results/custom-distances/custom-distances.csv)" = 2 ] || fail "a parameter"
"$aureole" lab run custom-distances -D nonsense=64 "${own[@]}" >run.txt 2>&1 && fail "an unknown parameter"
grep -q "unknown parameter 'nonsense': expected largest" run.txt || fail "$(cat run.txt)"
"$aureole" lab report results --module custom_experiment.so -o report >run.txt 2>&1 || fail "$(cat run.txt)"
grep -q 'custom-distances' report/index.html && [ -s report/custom-distances-distance.pdf ] || fail "the report"
"$aureole" lab run custom-distances -o results >run.txt 2>&1 && fail "without its module"

# The set of a module is one for the experiments of the tree.
"$aureole" lab run aureole-integrand --quick --set callback:golden "${own[@]}" >run.txt 2>&1 || fail "$(cat run.txt)"
grep -q '^callback:golden  *256' run.txt || fail "$(cat run.txt)"
# Nothing but a module of this version is one.
sed 's/LAB_VERSION/"0.0.1"/' "$source/examples/lab/custom_experiment.c" >old.c
"$cc" -std=c17 -shared -fPIC -I "$source/include" old.c -o old.so
"$aureole" lab list --module old.so >run.txt 2>&1 && fail "another version"
grep -q 'old.so: built for version 0.0.1' run.txt || fail "$(cat run.txt)"
echo 'int nothing;' | "$cc" -shared -fPIC -x c - -o nothing.so
"$aureole" lab list --module nothing.so >run.txt 2>&1 && fail "no module"
"$aureole" lab list --module none.so >run.txt 2>&1 && fail "no file"

# Integrands have their known means: the error of 4096 random points is of the order of 1/64.
"$aureole" lab run aureole-integrand --quick --integrand clamped-cosine -q -o results >run.txt 2>&1 || fail "$(cat run.txt)"
awk -F, '$1 == "spherical-fibonacci" && $2 == 256 { good = $3 < 1e-3 } END { exit !good }' results/aureole-integrand/aureole-integrand.csv ||
  fail "$(cat run.txt)"
"$aureole" lab run aureole-integrand --integrand nonsense -o results >run.txt 2>&1 && fail "an unknown integrand"
# A scene of one's own.
"$aureole" lab run aureole-scene --quick --scene "$source/scenes/cornell-box/cornell-box.xml" --set r2 -q -o results >run.txt 2>&1 || fail "$(cat run.txt)"
grep '^r2 ' run.txt | sort | uniq -c | awk '$1 != 2 { bad = 1 } END { exit bad || NR != 3 }' || fail "r2 twice: $(grep '^r2 ' run.txt)"
"$aureole" lab run aureole-scene --scene none.xml -o results >run.txt 2>&1 && fail "no scene"
"$aureole" lab run marques-2019-shifts --quick --scene none.xml -o results >run.txt 2>&1 && fail "an experiment that takes no scene"
# The scene of an experiment by its name: the same numbers, of which none is judged by what is published.
glossy=$source/scenes/cornell-box/glossy.xml
"$aureole" lab run marques-2013-fig1 --quick -q --scenes "$source/scenes" -o named >run.txt 2>&1 || fail "$(cat run.txt)"
"$aureole" lab run marques-2013-fig1 --quick -q --scene "$glossy" -o given >run.txt 2>&1 || fail "$(cat run.txt)"
for folder in named given; do grep -v '^#' $folder/marques-2013-fig1/marques-2013-fig1.csv | cut -d, -f1-8 >$folder.csv; done
cmp named.csv given.csv || fail "another scene by its name"
grep -v '^#' given/marques-2013-fig1/marques-2013-fig1.csv | tail -n +2 | grep -qv 'not published$' && fail "verdicts on another scene"
grep -q '^# scene .*published values are not compared$' given/marques-2013-fig1/marques-2013-fig1.csv || fail "no note of the scene"
"$aureole" lab run marques-2013-fig4 --quick --scene "$glossy" -o results >run.txt 2>&1 && fail "a scene in place of several"
grep -q "takes no scene: it compares the paper's scenes" run.txt || fail "$(cat run.txt)"
exit $status

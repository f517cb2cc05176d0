#!/usr/bin/env bash
# Every way of weighing on every domain that has it, with points that are few, doubled or wrong: weights that add up to 1, or
# status 2 and one line that says what is wrong and where.
set -u
aureole=$1
status=0
fail() { echo "FAILED: $*"; status=1; }

"$aureole" points spherical-fibonacci -n 20 --domain hemisphere -q -o good.csv || exit 1
printf 'x,y,z\n' >none.csv
printf 'x,y,z\n0,0,1\n' >one.csv
printf 'x,y,z\n0,0,1\n0.6,0,0.8\n' >two.csv
printf 'x,y,z\n0,0,1\n0,0,1\n0,0,1\n' >same.csv
{ cat good.csv; tail -3 good.csv; } >doubled.csv
{ cat good.csv; echo 0.6,0.1,0.8; } >off.csv
{ cat good.csv; echo 0.6,0,-0.8; } >below.csv
{ cat good.csv; echo nan,0,1; } >nan.csv
{ cat good.csv; echo 0,abc,1; } >word.csv
{ cat good.csv; echo 0,1; } >short.csv

# What comes of a file by one method on one domain: "sum" or words of the message.
try() { # words, file, options
  local words=$1 file=$2
  shift 2
  local out code
  out=$("$aureole" weights "$file.csv" "$@" -q 2>message.txt)
  code=$?
  if [ "$words" = sum ]; then
    [ $code = 0 ] && awk -F, 'NR > 1 { sum += $4 } END { exit !(sum > 1 - 1e-12 && sum < 1 + 1e-12) }' <<<"$out" ||
      fail "$file $*: $code, $(cat message.txt)"
  else
    [ $code = 2 ] && [ -z "$out" ] && [ "$(wc -l <message.txt)" = 1 ] && grep -qE -- "$words" message.txt ||
      fail "$file $*: $code, $(cat message.txt), not '$words'"
  fi
}

for domain in "--domain sphere" "--domain hemisphere" "--cap 90" "--cap 120"; do
  for method in exact voronoi osw equal; do
    case "$domain$method" in --cap*osw | --cap*equal) continue ;; esac
    how="$domain --method $method"
    # Cells of few points are no polygons that a rim could cut.
    few=sum
    [ "$how" = "--cap 120 --method voronoi" ] && few="fewer than three sides"
    # shellcheck disable=SC2086
    {
      try "none.csv: no points" none $how
      try "$few" one $how
      try "$few" two $how
      try "$few" same $how
      try sum doubled $how
      try "off.csv:22: a direction must have length 1" off $how
      try "nan.csv:22: column 1: 'nan'" nan $how
      try "word.csv:22: column 2: 'abc'" word $how
      try "short.csv:22" short $how
      case "$domain" in
        *sphere) [ "$domain" = "--domain sphere" ] || try "below.csv:22: .*below the hemisphere" below $how ;;
        *) try "point 21 .*(outside|below)" below $how ;;
      esac
    }
  done
  # shellcheck disable=SC2086
  {
    try "degree 4 to 1e-10" good $domain --method exact --degree 4
    try "must be between 0 and 1500, not '2000'" good $domain --method exact --degree 2000
    try "--degree, --levels, --negative, --near, --symmetry and --tolerance are for" good $domain --method voronoi --degree 2
  }
done
# A degree that needs negative weights says the least; they are given where they are allowed.
"$aureole" points random -n 20 --domain sphere -q -o uneven.csv
try "needs negative weights, the least of them -[0-9.]+/N" uneven --domain sphere --method exact --degree 3
try sum uneven --domain sphere --method exact --degree 3 --negative
# Other domains have exact weights alone and take no directions, no set has 0 points, and caps are of some size.
declare -A dim=([cube]="--dim 3")
for domain in square cube disk rotations; do
  try "says that the points are on the sphere, not on the $domain" good --domain $domain
  for method in voronoi osw equal ratio; do
    "$aureole" points sobol -n 16 --domain $domain ${dim[$domain]:-} -o $domain.csv
    try "this method needs directions: on the domain '$domain' use --method exact" $domain --domain $domain --method $method
  done
  try "caps and lobes are for directions" $domain --domain $domain --cap 20
  try "(functions|polynomials) of degree 7" $domain --domain $domain --degree 7
done
try "not for visible normals" good --domain hemisphere --lobe visible:0.4:30
try "not for visible normals" good --domain hemisphere --lobe visible:0.4:30 --method exact
try "not for visible normals" good --domain hemisphere --lobe visible:0.4:30 --method voronoi
try "unknown point group 'Q'" good --domain sphere --method exact --symmetry Q
try "unknown symmetry '5'" rotations --symmetry 5
try "needs --domain sphere or rotations" good --domain hemisphere --method exact --symmetry Oh
for method in exact voronoi osw equal ratio; do
  "$aureole" weights sobol -n 0 --method $method >/dev/null 2>message.txt && fail "no points by $method"
  grep -q "at least 1, not '0'" message.txt || fail "$(cat message.txt)"
done
for cap in 0 -3 181 nan; do
  try "--cap: must be" good --cap $cap --method exact
  try "--cap: must be" good --cap $cap --method voronoi
done
try "for the domain sphere" good --domain hemisphere --cap 91 --method voronoi
try "for the domain sphere" good --domain hemisphere --cap 91 --method exact
exit $status

#!/usr/bin/env bash
# The commands compare and convert as a user runs them: figures, exit statuses, messages, files whole or not at all.
set -u
aureole=$1
status=0
rm -rf ./*

fail() { echo "FAILED: $*"; status=1; }
# expect STATUS COMMAND...: runs the program, keeps its output in out and err.
expect() {
  local wanted=$1
  shift
  "$aureole" "$@" >out 2>err
  local got=$?
  [ "$got" = "$wanted" ] || { fail "exit status $got instead of $wanted: aureole $*"; cat out err; }
}
# A failure is one line on standard error that has this text in it.
complains() {
  [ "$(wc -l <err)" = 1 ] || fail "not one line on standard error: $(cat err)"
  grep -qF -- "$1" err || fail "'$1' is not in: $(cat err)"
}

# 2 x 2 grey pixels: 1, 1, 1, 1 and 1, 1, 1, 3 (the lower row first). MSE = 4/4 = 1, MAE = 0.5.
one='\x00\x00\x80\x3f'
printf "Pf\n2 2\n-1\n$one$one$one$one" >ones.pfm
printf "Pf\n2 2\n-1\n$one$one$one\x00\x00\x40\x40" >spike.pfm
printf "Pf\n1 2\n-1\n$one$one" >narrow.pfm
printf "Pf\n2 2\n-1\n$one$one$one\x00\x00\xc0\x7f" >nan.pfm

expect 0 compare ones.pfm ones.pfm
expect 1 compare ones.pfm spike.pfm --metric rmse,mse,mae --format csv
[ "$(head -1 out | cut -d, -f1-5)" = "image,rmse,mse,mae,relative_rmse" ] || fail "header: $(head -1 out)"
[ "$(tail -1 out | cut -d, -f1-5,8-)" = "spike.pfm,1,1,0.5,1,1.5,1.5,1.5,1,1,1" ] || fail "figures: $(tail -1 out)"
awk -F, 'END { exit !($6 > 1 / 1.01 - 1e-9 && $6 < 1 / 1.01 + 1e-9 && $7 > 0 && $7 < 1) }' out || fail "error measures: $(tail -1 out)"
expect 0 compare ones.pfm spike.pfm --tolerance 1
expect 1 compare ones.pfm spike.pfm --tolerance 0.999
expect 1 compare ones.pfm ones.pfm spike.pfm # one of several is enough
expect 0 compare spike.pfm spike.pfm --downsample 2
expect 1 compare ones.pfm spike.pfm --downsample 2 --metric mae --format json
grep -qF '"mae": 0.5,' out || fail "downsampled: $(cat out)"

expect 1 compare ones.pfm spike.pfm --output difference.png
[ "$(head -c 4 difference.png | tail -c 3)" = PNG ] || fail "difference.png is no PNG"
expect 2 compare ones.pfm spike.pfm ones.pfm --outfile other.png
complains "--output takes one image"
[ -e other.png ] && fail "other.png was written"

expect 2 compare ones.pfm narrow.pfm
complains "narrow.pfm: the sizes differ"
expect 2 compare ones.pfm nan.pfm
complains "nan.pfm: the image has the value nan at column 1 of row 0"
expect 2 compare ones.pfm missing.exr
complains "missing.exr: cannot read: No such file"
expect 2 compare ones.pfm
complains "at least one image"
expect 2 compare ones.pfm ones.pfm --metric rsme
complains "did you mean 'rmse'"
expect 2 compare ones.pfm ones.pfm --tolerance=-1
complains "--tolerance"
expect 2 compare ones.pfm ones.pfm --channels Q
complains "unknown channel 'Q': expected Y"
expect 2 compare ones.pfm ones.pfm --fast
complains "unknown option '--fast'"

# Through every format and back; PFM keeps every bit.
for format in exr hdr png pfm; do
  expect 0 convert spike.pfm "a.$format"
  expect 0 convert spike.pfm - --to "$format"
  cmp -s out "a.$format" || fail "standard output differs from a.$format"
  expect 0 convert "a.$format" "back-$format.pfm"
done
cmp -s spike.pfm back-pfm.pfm && fail "the scale is written as -1.0"
cmp -s a.pfm back-pfm.pfm || fail "PFM to PFM"
cmp -s a.pfm back-exr.pfm || fail "EXR to PFM"
expect 0 convert a.exr half.exr --half
expect 0 compare a.exr half.exr
"$aureole" convert - stdin.exr <a.pfm || fail "standard input"
cmp -s stdin.exr a.exr || fail "standard input gives another file"
expect 0 convert a.exr dark.png --exposure -1
expect 0 convert a.exr film.png --tone filmic
cmp -s a.png film.png && fail "--tone has no effect"
cmp -s a.png dark.png && fail "--exposure has no effect"

echo precious >kept.exr
expect 2 convert nan.exr kept.exr
expect 2 convert a.exr a.gif
complains "exr, pfm, hdr, png or jpg"
expect 2 convert a.exr b.exr --exposure 1
complains "--exposure cannot be used for exr"
expect 2 convert a.exr b.png --half
complains "--half cannot be used for png"
expect 2 convert a.exr
complains "one input and one output"
expect 2 convert a.exr b.png --tone cinema
complains "srgb, filmic"
expect 3 convert a.exr no/such/folder/b.exr
complains "no/such/folder/b.exr: cannot write"
head -c 200 a.exr >cut.exr
expect 2 convert cut.exr kept.exr
complains "cut.exr: broken EXR"
[ "$(cat kept.exr)" = precious ] || fail "a failed convert replaced its output"
if [ -w /dev/full ]; then
  for format in exr pfm hdr png; do
    expect 3 convert a.exr /dev/full --to $format
    complains "/dev/full: cannot write: No space left"
  done
fi
ls -A | grep -qF .tmp && fail "a temporary file was left: $(ls)"
exit $status

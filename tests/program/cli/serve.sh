#!/usr/bin/env bash
# The page of a render that is watched: what it serves and what it does not, that it changes no bit, that it can stop the
# render, and what Chromium shows of it where there is one.
set -u
aureole=$1
source=$2
scene=$source/scenes/cornell-box/cornell-box.xml
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
begin() { # begin NAME OPTION...: a render into NAME.exr that is served; $pid, $port and $token say where
  local name=$1
  shift
  rm -f "$name.txt" # what an earlier render of that name said
  "$aureole" render "$scene" --width 64 -q -t 2 -o "$name.exr" --serve "$@" 2>"$name.txt" &
  pid=$!
  for _ in $(seq 300); do grep -qs 'http.*/$' "$name.txt" && break; sleep 0.1; done
  read -r port token < <(sed -n 's,^aureole: serving the image at http://127\.0\.0\.1:\([0-9]*\)/\([0-9a-f]\{32\}\)/$,\1 \2,p' "$name.txt")
  [ -n "${token:-}" ] || fail "no address: $(cat "$name.txt")"
}
raw() { # raw BYTES: the answer to a request, sent at once: what comes after an answer resets the connection
  exec 3<>"/dev/tcp/127.0.0.1/$port" || return
  printf '%b' "$1" | dd bs=64k iflag=fullblock status=none >&3
  cat <&3
  exec 3>&- 3<&-
}
ask() { raw "$1 $2 HTTP/1.1\r\nHost: x\r\n\r\n"; }
status() { [ "$(head -1 <<<"$2" | cut -d' ' -f2)" = "$1" ] || fail "$3: $1 was expected, not $(head -1 <<<"$2")"; }

"$aureole" render "$scene" --width 64 -q --spp 4 -o plain.exr || fail "no image"
begin served --spp 4
wait "$pid" && cmp plain.exr served.exr || fail "an image that is served has other bits"
"$aureole" render "$scene" --width 64 -q --rounds 3 -o plain.exr || fail "no image"
begin served --rounds 3
wait "$pid" && cmp plain.exr served.exr || fail "an image of rounds that is served has other bits"

# What a page is told belongs together: the samples and the error of one finished round, as a render of so many rounds prints
# them, and a share that never falls; and before the first image it is told what is done.
if command -v python3 >/dev/null; then
  begin told --rounds 14
  ask GET "/$token/state/1/0" >/dev/null # so that the page is waited for while Python starts
  python3 - "$port" "$token" "$aureole" "$scene" <<'PY' || fail "what a page is told"
import json, re, subprocess, sys, urllib.request
port, token, aureole, scene = sys.argv[1:]
states, serial = [], 0
while not states or states[-1]["ended"] == "":
    with urllib.request.urlopen("http://127.0.0.1:%s/%s/state/1/%d" % (port, token, serial)) as answer:
        states.append(json.load(answer))
    serial = states[-1]["serial"]
urllib.request.urlopen(urllib.request.Request("http://127.0.0.1:%s/%s/bye/1" % (port, token), method="POST"))
of_rounds = {}
for rounds in range(1, 15):
    printed = subprocess.run([aureole, "render", scene, "--width", "64", "-q", "-o", "round.exr", "--json", "--rounds", str(rounds)],
                             capture_output=True, check=True).stdout
    it = json.loads(printed)[0]
    of_rounds["%.4g" % it["samples_per_pixel"]] = tuple("%.3g" % (100 * it[name + "_error"]) for name in ("relative", "mean", "display"))
pairs = [re.match(r"error after (\S+) samples per pixel .*: relative (\S+) % .*, mean (\S+) % .*, display (\S+) %", state["known"]) for state in states if state["known"]]
assert states[0]["what"] in ("planning", "rendering"), states[0]
assert pairs and all(pairs), [state["known"] for state in states]
for pair in pairs:
    assert of_rounds.get(pair[1]) == pair.groups()[1:], (pair[0], of_rounds)
assert pairs[-1][1] == max(of_rounds, key=float), "the end is told with the error of an earlier round"
shares = [state["share"] for state in states]
assert shares == sorted(shares), shares
PY
  wait "$pid" || fail "an image that a page is told of: $(cat told.txt)"
fi

begin long --spp 1000000 --integrator aov
page=$(ask GET "/$token/")
status 200 "$page" "the page"
for what in '<title>long.exr</title>' 'class Viewer' 'class Live' "default-src 'none'" 'no-store'; do
  grep -qF "$what" <<<"$page" || fail "no $what in the page"
done
grep -qE '(src|href)="?(https?:)?//' <<<"$page" && fail "the page looks for something elsewhere"
status 200 "$(ask HEAD "/$token/")" "the head of the page"
[ "$(ask HEAD "/$token/" | wc -l)" -lt 12 ] || fail "a head with a body"
wrong=$(tr 0-9a-f 1-9a-f0 <<<"$token")
for path in / "/$wrong/" "/$wrong/state/1/0" "/$token" "/$token/x" "/$token/../$token/" "/$token/image/99" "/$token/state/1" /etc/passwd; do
  status 404 "$(ask GET "$path")" "$path"
done
status 405 "$(ask GET "/$token/stop")" "GET of stop"
status 405 "$(ask POST "/$token/")" "POST of the page"
status 404 "$(ask POST "/$wrong/stop")" "POST without the token"
[ -z "$(raw 'nonsense\r\n\r\n')" ] || fail "an answer to what is no request"
status 400 "$(raw 'GET /\r\n\r\n')" "no version"
status 400 "$(raw "GET http://elsewhere/ HTTP/1.1\r\n\r\n")" "a proxy's request"
status 505 "$(raw "GET /$token/ HTTP/2.0\r\n\r\n")" "another version"
status 413 "$(raw "POST /$token/stop HTTP/1.1\r\nContent-Length: 5\r\n\r\n12345")" "a body"
status 431 "$(raw "GET / HTTP/1.1\r\nA: $(printf '%8200s' '')")" "endless fields"
status 414 "$(ask GET "/$(printf '%8200s' '' | tr ' ' a)")" "an endless target"
state=
for serial in 0 1 2 3 4 5 6 7 8 9; do
  state=$(ask GET "/$token/state/1/$serial")
  grep -q '"name": "albedo"' <<<"$state" && break
done
status 200 "$state" "the state"
for what in '"what": "rendering"' '"width": 64' '"name": "image", "channels": \["R", "G", "B"\]' '"ended": ""'; do
  grep -q "$what" <<<"$state" || fail "no $what in $(tail -1 <<<"$state")"
done
picture=$(ask GET "/$token/image/1")
grep -q '"width": 64, "height": 64, "channels": 3, .*"name": "albedo", "data": "eA' <<<"$picture" || fail "a picture: $(tail -1 <<<"$picture" | head -c 200)"
# A second program cannot have the same port, and says so before it works.
"$aureole" render "$scene" -q -o none.exr --serve="$port" 2>message.txt
[ $? -eq 2 ] && grep -q -- "--serve: cannot listen at 127.0.0.1:$port: Address already in use" message.txt || fail "a port in use: $(cat message.txt)"
status 200 "$(ask POST "/$token/bye/1")" "goodbye"
status 200 "$(ask POST "/$token/stop")" "stop"
wait "$pid"
[ $? -eq 3 ] && [ -s long.partial.exr ] && [ ! -e long.exr ] || fail "stop: $(cat long.txt)"
for place in x 65536 :80 '[::1' a:b:80 -1; do
  "$aureole" render "$scene" -q -o none.exr --serve="$place" 2>message.txt
  [ $? -eq 2 ] && grep -qF -- "--serve: expected PORT, HOST:PORT or [HOST]:PORT, with a port of at most 65535, not '$place'" message.txt || fail "$place: $(cat message.txt)"
done

# A page turns the camera: the image is that of a camera there. The middle of the wedge is (1.5, .75, .5).
printf 'v %s\n' '0 0 0' '3 0 0' '3 0 1' '0 0 1' '0 1.5 0' '0 1.5 1' >wedge.obj
printf 'f %s\n' '1 2 3 4' '1 5 2' '4 3 6' '2 5 6 3' '1 4 6 5' >>wedge.obj
turned() { # turned TURN PLACE: from (1.5, .75, 8.5)
  local plain=$scene
  scene=wedge.obj
  begin turned --height 48 --ground none --integrator depth --filter box --spp 3000 --camera 1.5,.75,8.5,1.5,.75,.5,40
  scene=$plain
  ask GET "/$token/state/1/0" >/dev/null # from which on it is rendering
  status 200 "$(ask POST "/$token/turn/$1")" "turning by $1"
  status 200 "$(ask POST "/$token/bye/1")" "goodbye"
  wait "$pid" || fail "turned by $1: $(cat turned.txt)"
  "$aureole" render wedge.obj -q --width 64 --height 48 --ground none --integrator depth --filter box --spp 3000 --camera "$2,1.5,.75,.5,40" -o there.exr
  "$aureole" compare there.exr turned.exr --metric relative-rmse --tolerance 1e-3 >compared.txt || fail "turned by $1: $(cat compared.txt)"
}
turned 90/0/1 9.5,.75,.5
turned 0/30/2 1.5,8.75,14.356406460551018
turned 0/0/1 1.5,.75,8.5
begin refused --spp 2000 --checkpoint kept.chk
for wrong in 1/2 1/2/0 1/2/nan 1/2/3/4 x/0/1; do status 404 "$(ask POST "/$token/turn/$wrong")" "turning by $wrong"; done
status 404 "$(ask POST "/$token/turn/1/1/1")" "turning what a checkpoint keeps"
status 200 "$(ask POST "/$token/stop")" "stop"
wait "$pid"

# The file that the page saves, by its own script.
if command -v node >/dev/null; then
  node - "$source/src/program/watch/page/live.js" >values.exr <<'END'
const fs = require('fs');
globalThis.document = {addEventListener() {}};
const make = new Function(fs.readFileSync(process.argv[2], 'utf8') + '; return exrFile;')();
const plane = values => Uint16Array.from(values);
const codes = [plane([0x3c00, 0x4000]), plane([0x4200, 0x4400]), plane([0x4500, 0x4600])];
fs.writeSync(1, Buffer.from(make([{channels: ['R', 'G', 'B']}, {channels: ['depth.T']}],
  [{width: 2, height: 1, codes}, {codes: [plane([0x4700, 0x4800])]}])));
END
  { printf 'PF\n2 1\n-1.0\n'; printf '%b' '\0\0\x80\x3f\0\0\x40\x40\0\0\xa0\x40\0\0\0\x40\0\0\x80\x40\0\0\xc0\x40'; } >values.pfm
  "$aureole" compare values.pfm values.exr --channels R,G,B >compared.txt 2>&1 || fail "the file that the page saves: $(cat compared.txt)"
  "$aureole" info values.exr 2>&1 | grep -q 'depth.T' || fail "the channels of the file that the page saves"
fi

command -v chromium >/dev/null || { echo "skipped: no chromium: what the page does is not tested"; exit $((failures > 0 ? 1 : 77)); }
# The clock of such a Chromium stands still while the page waits for an answer: it prints the page when the render has ended.
begin seen --spp 1000000
timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$PWD/chromium" --window-size=900,700 --virtual-time-budget=1000 \
  --dump-dom "http://127.0.0.1:$port/$token/#viewer=0&z=16&x=3&y=5&tone=filmic" >dom.html 2>chromium.txt &
chromium=$!
hexadecimal=$(printf '0100007F:%04X' "$port")
for _ in $(seq 300); do # until the page waits for news
  awk -v at="$hexadecimal" '$2 == at && $4 == "01" { found = 1 } END { exit !found }' /proc/net/tcp && break
  sleep 0.1
done
sleep 1
status 200 "$(ask POST "/$token/stop")" "stop"
wait "$pid"
[ $? -eq 3 ] || fail "stopped: $(cat seen.txt)"
wait "$chromium"
for what in 'The render was stopped.' 'data-ended' 'z=16&amp;x=3&amp;y=5&amp;tone=filmic' 'Save EXR' '<output>pixel 3, 5   image: '; do
  grep -qF "$what" dom.html || fail "no $what in the page: $(grep -o 'id="said"[^/]*' dom.html) $(grep -o 'data-state="[^"]*"' dom.html)"
done
grep -q 'pixel 3, 5   image: 0.000 0.000 0.000' dom.html && fail "the page shows a black picture"
rm -rf chromium
exit $((failures > 0))

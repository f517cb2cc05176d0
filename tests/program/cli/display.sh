#!/usr/bin/env bash
# Sending an image to a display server by tev's protocol: the packets, read by a small server, make the image that is written.
set -u
aureole=$1
source=$2
scene=$source/scenes/cornell-box/cornell-box.xml
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
command -v python3 >/dev/null || { echo "skipped: no python3: nothing receives"; exit 77; }
receive() { # receive NAME OPTION...: a render into NAME.exr and what is received in NAME.pfm
  local name=$1
  shift
  rm -f port.txt
  timeout 100 python3 "$source/tests/program/cli/display.py" port.txt "$name.pfm" >"$name.txt" 2>&1 &
  local server=$!
  for _ in $(seq 300); do [ -s port.txt ] && break; sleep 0.1; done
  "$aureole" render "$scene" --width 150 -q -o "$name.exr" --display-server "127.0.0.1:$(cat port.txt)" "$@" || fail "$name: no picture"
  wait "$server" || fail "$name: $(tail -3 "$name.txt")"
}
receive a --spp 2
"$aureole" render "$scene" --width 150 -q -o plain.exr --spp 2
cmp a.exr plain.exr || fail "an image that is sent has other bits"
"$aureole" compare a.pfm a.exr >compared.txt || fail "the image that was received: $(cat compared.txt)"
[ "$(sed -n 1p a.txt)" = "close a.exr" ] && [ "$(sed -n 2p a.txt)" = "create 1 a.exr 150 150 R,G,B" ] || fail "$(cat a.txt)"
[ "$(sed -n 's/^updates //p' a.txt)" -ge 4 ] || fail "150 pixels are four parts: $(cat a.txt)"
receive b --rounds 2
"$aureole" compare b.pfm b.exr >compared.txt || fail "the image of rounds that was received: $(cat compared.txt)"
"$aureole" render "$scene" -q -o none.exr --display-server "127.0.0.1:$(cat port.txt)" 2>message.txt
[ $? -eq 2 ] && grep -q -- "--display-server: cannot connect to 127.0.0.1:$(cat port.txt): Connection refused" message.txt || fail "nobody there: $(cat message.txt)"
"$aureole" render "$scene" -q -o none.exr --display-server host:x 2>message.txt
[ $? -eq 2 ] && grep -q -- "--display-server: expected PORT, HOST:PORT" message.txt || fail "no port: $(cat message.txt)"
exit $((failures > 0))

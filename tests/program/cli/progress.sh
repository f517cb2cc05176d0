#!/usr/bin/env bash
# Each command has one progress bar, on a terminal: its share never falls, whatever phases the command has, and it is taken
# off the terminal in the end.
set -u
aureole=$1
source=$2
. "$source/tests/terminal.sh.inc"
command -v python3 >/dev/null || { echo "skipped: no python3 to make a terminal with"; exit 77; }
scene=$source/scenes/cornell-box/cornell-box.xml
for x in 100 200 300 400; do for z in 100 200 300 400; do echo "$x 10 $z 0 1 0"; done; done >points
awk 'BEGIN { for (i = 0; i < 9; ++i) for (j = 0; j < 9; ++j) { x = 10 * i; y = 10 * j; h = 3 + (7 * i + 5 * j) % 11
  printf "v %d %d 0\nv %d %d 0\nv %d %d 0\nv %d %d 0\nf -4 -3 -2 -1\n", x, y, x + 10, y, x + 10, y + 10, x, y + 10
  printf "v %d %d 0\nv %d %d 0\nv %d %d %d\nv %d %d %d\nf -4 -3 -2 -1\n", x, y + 5, x + 9, y + 5, x + 9, y + 5, h, x, y + 5, h } }' >city.obj
cat >watch.py <<'PY'
import os, pty, re, subprocess, sys
"""Runs a program with a terminal as its standard error; prints what is wrong with the bar there."""
master, slave = pty.openpty()
child = subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=slave)
os.close(slave)
text = b""
while True:
    try:
        piece = os.read(master, 65536)
    except OSError:
        break
    if not piece:
        break
    text += piece
status = child.wait()
text = text.decode()
bars = re.findall(r"\r\x1b\[K([^\[\r\n]*) \[[#.]*\] +(\d+) %  ([0-9:]+), (\S+) left", text)
shares = [int(bar[1]) for bar in bars]
wrong = []
if status != 0:
    wrong.append("status %d: %s" % (status, text[-300:]))
if shares != sorted(shares):
    wrong.append("the share falls: %s" % shares)
if any(share > 99 for share in shares):
    wrong.append("100 %% before the end: %s" % shares)
if bars and "\r\x1b[K" not in text[text.rfind(" left"):]:
    wrong.append("the bar stays: %r" % text[-200:])
print("%s: %s %s" % (" ".join(sys.argv[2:]), shares, sorted({bar[0] for bar in bars})))
for line in wrong:
    print("FAILED: " + line)
sys.exit(bool(wrong))
PY
status=0
bar() { python3 watch.py "$@" | tee -a seen || status=1; }
set -o pipefail
bar "$aureole" render "$scene" --width 96 --spp 16 --integrator finalgather --no-cache -t 1 -o a.exr
bar "$aureole" render "$scene" --width 48 --rounds 12 --no-cache -t 1 -o a.exr
bar "$aureole" irradiance "$scene" --sensors points -n 8192 --reflected map -t 1
bar "$aureole" viewfactors city.obj --rays 4096 -t 1
bar "$aureole" viewfactors city.obj --radiosity .7 --sun 1,1,1 --matrix-free --rays 8192 -t 1
bar "$aureole" measure sobol -n 4000,8000 -m l2-star,centered -t 1
bar "$aureole" measure random -n 2000 -m energy,mesh-ratio --domain sphere --seeds 20 -t 1
bar "$aureole" weights spherical-fibonacci -n 2500 --domain sphere --method exact --report -t 1
bar "$aureole" weights spherical-fibonacci -n 40000 --domain sphere --method voronoi --report -t 1
bar "$aureole" voronoi spherical-fibonacci -n 60000 --cells cells.obj -t 1
# Quick commands may end before their bar is drawn.
[ "$(grep -c '\[[0-9]' seen)" -ge 5 ] || { echo "FAILED: hardly a bar was drawn"; status=1; }
exit $status

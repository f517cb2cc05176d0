#!/usr/bin/env bash
# Limits of the page's server: clients that are slow or wait hold no connection for long, and none delays the end.
set -u
aureole=$1
source=$2
command -v python3 >/dev/null || { echo "skipped: no python3: nobody asks"; exit 77; }
"$aureole" render "$source/scenes/cornell-box/cornell-box.xml" --width 64 -q -t 1 -o long.exr --spp 100000000 --integrator aov --serve 2>address.txt &
pid=$!
for _ in $(seq 300); do grep -qs 'http.*/$' address.txt && break; sleep 0.1; done
python3 - "$pid" address.txt <<'PY'
import os, re, signal, socket, sys, threading, time
pid, port, token = int(sys.argv[1]), *re.search(r":(\d+)/(\w+)/", open(sys.argv[2]).read()).groups()
MOST, READING, WAITING = 32, 10.0, 15.0  # connections, and seconds, of src/program/serve/serve.c

def connect(text=b""):
    connection = socket.create_connection(("127.0.0.1", int(port)), timeout=40.0)
    connection.sendall(text)
    return connection

def request(path):
    return b"GET /%s/%s HTTP/1.1\r\nHost: x\r\n\r\n" % (token.encode(), path.encode())

def answer(connection):
    text = b""
    while part := connection.recv(65536):
        text += part
    return text

def ends(connection):
    try:
        return answer(connection) == b""
    except ConnectionResetError:
        return True

# One connection waits for a state that never comes; all others send a byte now and then and no request.
begin = time.monotonic()
waiting = connect(request("state/1/%d" % 2**63))
slow = [connect(b"G") for _ in range(MOST - 1)]
stop = threading.Event()

def drip():
    while not stop.wait(0.5):
        for connection in slow:
            try:
                connection.send(b"G")
            except OSError:
                pass

dripping = threading.Thread(target=drip)
dripping.start()
last = connect(request("x"))  # there is no place for it yet
assert answer(last).startswith(b"HTTP/1.1 404 "), "a page among slow clients"
took = time.monotonic() - begin
assert READING - 1.0 < took < READING + 3.0, "slow clients were cut after %.2f s" % took
stop.set()
dripping.join()
assert all(map(ends, slow)), "slow clients are answered"
state = answer(waiting)
took = time.monotonic() - begin
assert state.startswith(b"HTTP/1.1 200 ") and WAITING - 1.0 < took < WAITING + 3.0, "a state after %.2f s: %s" % (took, state[:40])

# The page has said goodbye, and others that are connected delay nothing.
goodbye = connect(b"POST /%s/bye/1 HTTP/1.1\r\nHost: x\r\n\r\n" % token.encode())
assert answer(goodbye).startswith(b"HTTP/1.1 200 "), "goodbye"
idle = [connect() for _ in range(MOST // 2)]
begin = time.monotonic()
os.kill(pid, signal.SIGINT)
assert all(map(ends, idle)), "idle clients are answered"
took = time.monotonic() - begin
assert took < 1.0, "the end took %.2f s" % took
PY
good=$?
[ $good = 0 ] || kill "$pid" # a second signal would end what writes its partial result
wait "$pid"
[ $? -eq 3 ] || { echo "another end: $(cat address.txt)"; exit 1; }
exit "$good"

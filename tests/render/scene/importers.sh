#!/usr/bin/env bash
# The process that reads a model may do what it likes: programs that crash, hang, lie, take all memory or go away stand for it,
# and each is an error that names the file, at once. A signal ends the reader with the program.
set -u
aureole=$1
fail() { echo "$1"; exit 1; }
/usr/bin/python3 -c '' 2>/dev/null || { echo "skipped: there is no Python to write programs with"; exit 77; }
: >model.fbx

# importer NAME: a program of that name, which has read the first message; standard input is its code.
importer() {
  {
    printf '#!/usr/bin/python3 -IS\n'
    cat <<'PYTHON'
import os, struct, sys, time
def take(size):
    data = b""
    while len(data) < size:
        piece = os.read(0, size - len(data))
        if not piece:
            os._exit(1)
        data += piece
    return data
def receive():
    kind, value, size = struct.unpack("=IIQ", take(16))
    return kind, value, take(size)
def send(kind, data=b"", value=0, size=None):
    data = struct.pack("=IIQ", kind, value, len(data) if size is None else size) + data
    while data:
        data = data[os.write(0, data):]
OPEN, FIND, MESH, PICTURE, NOTE, FAIL, SCENE = range(3, 10)
first = receive()
# A mesh of one triangle, a camera far away and no light.
mesh = b"""ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
"""
def records(*texts):
    return b"".join(text + b"\0" for text in texts)
shape = records(b"<shape", b"=type", b"ply", b"<string", b"=name", b"filename", b"=value", b"*0", b">", b">")
def scene(elements=shape):
    return struct.pack("=12d2I", *[0.0] * 12, 0, 0) + elements
PYTHON
    cat
  } >"$1"
  chmod +x "$1"
}

# told NAME STATUS WORDS [OPTION...]: the program ends with the status and the words, which name the file.
told() {
  AUREOLE_IMPORT=$PWD/$1 timeout 60 "$aureole" info model.fbx "${@:4}" >said 2>&1
  local status=$?
  [ $status = "$2" ] || fail "$1 ends with $status: $(cat said)"
  grep -q "^aureole: .*model.fbx: .*$3" said || fail "$1 is not reported as '$3': $(cat said)"
}

importer good <<<'send(NOTE, b"a note\x1b[31m"); send(MESH, mesh); send(SCENE, scene())'
AUREOLE_IMPORT=$PWD/good "$aureole" info model.fbx >said 2>&1 || fail "an honest program is refused: $(cat said)"
grep -q '^triangles  *1$' said && grep -q 'model.fbx: a note' said && grep -q 'has no camera' said || fail "not what was sent: $(cat said)"
grep -q $'\x1b' said && fail "control characters of a file reach the terminal"

importer crash <<<'os.kill(os.getpid(), 11)'
told crash 2 'crashed on it (signal 11)'
# A parent that ignores ended children does not hide how this one ended.
env --ignore-signal=CHLD AUREOLE_IMPORT="$PWD/crash" "$aureole" info model.fbx >said 2>&1
grep -q "crashed on it (signal 11)" said || fail "where SIGCHLD is ignored: $(cat said)"
importer abort <<<'send(MESH, mesh); os.abort()'
told abort 2 'crashed on it (signal 6)'
importer killed <<<'os.kill(os.getpid(), 9)'
told killed 3 'killed'
importer gone <<<'os._exit(0)'
told gone 2 'no whole answer'
importer failed <<<'os._exit(5)'
told failed 2 'exit status 5'
importer half <<<'os.write(0, b"12345"); os._exit(0)'
told half 2 'no whole answer'
importer cut <<<'send(MESH, mesh, size=100000); os._exit(0)'
told cut 2 'no whole answer'
importer closed <<<'os.close(0); time.sleep(1000)'
told closed 3 'killed'
importer kind <<<'send(77, mesh)'
told kind 2 'damaged'
importer huge <<<'send(MESH, mesh, size=1 << 62)'
told huge 2 'more than'
importer flood <<<'
while True:
    send(MESH, bytes(1 << 26))'
told flood 2 'more than'
importer greedy <<<'
try:
    held = bytes(2 << 30)
except MemoryError:
    send(FAIL, b"no memory", 2)'
if nm "$(dirname "$aureole")/libaureole-render.so" 2>/dev/null | grep -q '__asan\|__tsan'; then
  echo "sanitizers leave no limit of memory"
else
  told greedy 3 'no memory'
fi
importer zero <<<'send(OPEN, b"a\0b")'
told zero 2 'damaged'
importer nameless <<<'send(OPEN)'
told nameless 2 'damaged'
importer short <<<'send(SCENE, b"<scene")'
told short 2 'damaged'
importer words <<<'send(FAIL, b"no\nwords\0here", 20)'
told words 2 'no words'
# Elements that are no tree: without an end, of no kind, ended too often, an attribute of none or without a value, too deep; and
# control characters. Elements by which XML names files are unknown here.
for elements in 'shape[:-1]' 'shape[:-2]' 'b"shape\0"' 'b"\0" + shape' 'shape + records(b">")' 'records(b"=type", b"ply") + shape' \
                'shape + records(b"<shape", b"=type")' 'records(*[b"<shape"] * 101, *[b">"] * 101)' 'shape.replace(b"*0", b"\x1b")'; do
  importer tree <<<"send(MESH, mesh); send(SCENE, scene($elements))"
  told tree 2 'damaged'
done
importer many <<<'send(SCENE, scene(records(b"<shape", *[b"=type", b"ply"] * 4, b">")))'
told many 2 'too many attributes'
importer outside <<<'send(SCENE, scene(records(b"<include", b"=filename", b"model.fbx", b">")))'
told outside 2 'unknown element <include>'
importer nowhere <<<'send(SCENE, scene(b""))'
AUREOLE_IMPORT=$PWD/nowhere "$aureole" info model.fbx >said 2>&1
[ $? = 2 ] || fail "a scene without a camera and mesh is no error: $(cat said)"
told ./none 2 'cannot start'

# What it asks for is confined as what a scene names; without confinement it is read.
mkdir -p inside && cp model.fbx inside/ && echo outside >outside.txt && echo inside >inside/Part.TXT
importer spy <<<'
send(OPEN, b"../outside.txt")
kind, value, data = receive()
send(FAIL, b"read " + data, 20)'
cp spy inside/
(cd inside && told spy 2 'read outside' && told spy 2 'outside of the scene' --confine) || exit 1
importer letters <<<'
send(OPEN, b"part.txt")
kind, value, data = receive()
send(OPEN, b"C:/of/another/machine/part.txt")
assert receive()[2] == data
send(OPEN, b"nothing.txt")
assert receive()[1] == 0
send(FAIL, b"read " + data, 20)'
cp letters inside/
(cd inside && told letters 2 'read inside' --confine) || exit 1
sed -i 's/^send(FAIL.*/send(MESH, mesh); send(SCENE, scene())/' inside/letters
(cd inside && AUREOLE_IMPORT=$PWD/letters "$aureole" info model.fbx >said 2>&1) || fail "letter case is not forgiven: $(cat inside/said)"
grep -q "2 files have other spellings: 'part.txt' as 'Part.TXT', 'C:/of/another/machine/part.txt' as 'Part.TXT'" inside/said &&
  grep -q "1 file cannot be found: 'nothing.txt'" inside/said || fail "other names are not reported: $(cat inside/said)"

# A signal ends the reader with the program; the reader ends with a program that is killed.
importer waits <<<'
open("reader", "w").write(str(os.getpid()))
time.sleep(1000)'
wait_for() { # COMMAND...: at most 10 s until it is true
  for _ in {1..100}; do
    "$@" && return 0
    sleep .1
  done
  return 1
}
reader_is_gone() { ! kill -0 "$(cat reader)" 2>/dev/null; }
AUREOLE_IMPORT=$PWD/waits "$aureole" render model.fbx -o o.exr >said 2>&1 &
program=$!
wait_for [ -s reader ] || fail "the reader does not start"
kill -TERM $program
wait $program
[ $? = 3 ] || fail "after SIGTERM the program does not end with 3: $(cat said)"
wait_for reader_is_gone || fail "the reader lives on after SIGTERM"
AUREOLE_IMPORT=$PWD/waits "$aureole" info model.fbx --time-limit 1s >said 2>&1
[ $? = 3 ] || fail "--time-limit does not hold while a model is read: $(cat said)"

# Our own reader ends with whoever has started it, opens no file, and starts for nobody else.
import=$(dirname "$aureole")/aureole-import
if [ -x "$import" ]; then
  "$import" 1 </dev/null && fail "the reader starts for a process that is not its parent"
  rm -f reader
  /usr/bin/python3 - "$import" <<'PYTHON' && fail "a killed process ends well"
import os, signal, socket, subprocess, sys
ours, theirs = socket.socketpair()
child = subprocess.Popen([sys.argv[1], str(os.getpid())], stdin=theirs)
open("reader", "w").write(str(child.pid))
theirs.close()
os.kill(os.getpid(), signal.SIGKILL)
PYTHON
  wait_for reader_is_gone || fail "the reader lives on when its parent was killed"
fi
# Digits of nodes of glTF that no float holds reach the scene: the reader by hand, for a file in memory.
if [ -x "$import" ]; then
  VERSION=$("$aureole" --version | grep -o '[0-9][0-9.]*' | head -1) /usr/bin/python3 - "$import" <<'PYTHON' || fail "a node at map coordinates is rounded"
import json, os, re, socket, struct, subprocess, sys
positions = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
import base64
child = {"mesh": 0, "translation": [0.1, 0.2, 0.3]}
def model(nodes, roots):
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": roots}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 1.5, "znear": 0.1}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions)}],
        "buffers": [{"byteLength": len(positions), "uri": "data:application/octet-stream;base64," + base64.b64encode(positions).decode()}]}).encode()
def read(data):
    ours, theirs = socket.socketpair()
    program = subprocess.Popen([sys.argv[1], str(os.getpid())], stdin=theirs)
    theirs.close()
    stream = ours.makefile("rwb")
    def send(kind, value, data):
        stream.write(struct.pack("=IIQ", kind, value, len(data)) + data)
        stream.flush()
    send(1, 0, os.environ["VERSION"].encode() + b"\0a.gltf\0")
    while True:
        kind, value, size = struct.unpack("=IIQ", stream.read(16))
        data_read = stream.read(size)
        if kind == 3:
            send(2, 1, data) if data_read == b"a.gltf" else send(2, 0, b"")
        elif kind == 8:
            sys.exit(data_read)
        elif kind == 9:
            program.wait()
            origin = struct.unpack_from("=3d", data_read)
            matrices = [[float(v) for v in m.split()] for m in re.findall(rb"<matrix\0=value\0([^\0]*)", data_read)]
            return origin, matrices
at = [500000.3, 5400000.7, 412.15]
# Several roots, nested nodes, one node as a matrix.
nodes = [{"translation": at, "children": [1]}, child, {"camera": 0, "translation": [500001.1, 5400002.2, 415.3]},
         {"mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 2600000.1, 1200000.9, 500.7, 1]}]
origin, matrices = read(model(nodes, [0, 2, 3]))
where = [[m[3], m[7], m[11]] for m in matrices]
assert [a + b for a, b in zip(at, child["translation"])] in where, where
assert [2600000.1, 1200000.9, 500.7] in where, where
assert list(origin) == [500001.1, 5400002.2, 415.3], origin
# One root is assimp's own.
origin, matrices = read(model([{"translation": at, "children": [1]}, child], [0]))
assert [matrices[0][i] for i in (3, 7, 11)] == [a + b for a, b in zip(at, child["translation"])], matrices
PYTHON
fi
echo "importers: every failure is an error"

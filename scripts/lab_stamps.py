#!/usr/bin/env python3
"""lab_stamps.py [--stale | --write | --outdated | --files] [--build FOLDER] [NAME...]: which sources the experiments of the lab depend on.

Without an option, prints for each experiment whether it traces rays and a hash of its sources. --write stores both beside its kept
tables, in docs/report/results/NAME/NAME-stamp.csv, --outdated stores no hash, because the tables are not those of the sources. --stale
names the experiments whose sources have changed since. --files lists the sources of each.

The sources are read from a finished release build (build/release): the object files that the linker needs for the experiment, by
the symbols that each defines and needs; the headers and data that their sources include; and the scenes that files of the lab
name. Comments and white space of C files do not count. An experiment traces rays when it needs the file that calls Embree."""
import argparse
import hashlib
import pathlib
import re
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
KEPT = TOP / "docs/report/results"
RAYS = "src/render/trace/accel.c"


def read_symbols(build):
    """The file that defines each symbol, and the symbols that each file needs, of the libraries and the program."""
    folders = [f for f in (build / "CMakeFiles").glob("*.dir") if re.match(r"aureole_|aureole-program", f.name)]
    # A build folder still has the objects of targets that a file has left: the newest object of a source comes last and counts.
    objects = sorted((o for f in folders for o in f.rglob("*.c.o")), key=lambda o: o.stat().st_mtime)
    newest = {re.sub(r".*?\.dir/", "", str(o)): o for o in objects}
    objects = sorted(newest.values())
    defined, needed = {}, {}
    text = subprocess.run(["nm", "-A", *objects], capture_output=True, text=True, check=True).stdout
    for line in text.splitlines():
        path, kind, symbol = re.match(r".*?\.dir/(.*?)\.o:\S* +(\S) (\S+)", line).groups()
        path = re.sub(r"^kernels/(.*)_avx\d+\.c$", r"\1.c", path)
        if not (TOP / path).exists():
            continue
        if kind == "U":
            needed.setdefault(path, set()).add(symbol)
        elif kind.isupper():
            defined.setdefault(symbol, path)
    return defined, needed


def linked(start, defined, needed):
    """The files that the linker needs beside one."""
    found, rest = {start}, [start]
    while rest:
        for symbol in needed.get(rest.pop(), ()):
            path = defined.get(symbol)
            if path is not None and path not in found:
                found.add(path)
                rest.append(path)
    return found


def named_by(path):
    """The files that one includes, or whose scenes it names."""
    text = (TOP / path).read_text(encoding="utf-8", errors="replace")
    folder = pathlib.Path(path).parent
    for name in re.findall(r'^\s*#\s*include\s*["<]([^">]+)[">]', text, re.M):
        name = re.sub(r"^(.*)\.inc$", r"data/\1.txt", name)
        places = (folder / name, pathlib.Path("src") / name, pathlib.Path("include") / name, pathlib.Path(name))
        yield from (str(place) for place in places[: None if "/" in name else 1] if (TOP / place).is_file())
    if path.startswith("lab/"):
        for name in re.findall(r'"([a-z0-9/-]+)(?:\.xml)?"', text):
            scene = TOP / "scenes" / name
            folder = scene if scene.is_dir() else scene.parent if scene.with_suffix(".xml").is_file() else None
            if folder is not None and folder != TOP / "scenes":
                yield from (str(f.relative_to(TOP)) for f in folder.rglob("*") if f.suffix == ".xml")


def sources(start, defined, needed, memory):
    found = linked(start, defined, needed)
    rest = list(found)
    while rest:
        path = rest.pop()
        if path not in memory:
            memory[path] = set(named_by(path)) if path.endswith((".c", ".h")) else set()
        rest += memory[path] - found
        found |= memory[path]
    return sorted(found)


def content(path):
    data = (TOP / path).read_bytes()
    if path.endswith((".c", ".h")):
        text = data.decode("utf-8", "replace")
        token = r'//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\')'
        text = re.sub(token, lambda m: m.group(1) or " ", text, flags=re.S)
        data = "".join(text.split()).encode()
    return hashlib.sha256(data).digest()


def main():
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for option in ("--stale", "--write", "--outdated", "--files"):
        reader.add_argument(option, action="store_true")
    reader.add_argument("--build", type=pathlib.Path, default=TOP / "build/release")
    reader.add_argument("names", nargs="*")
    how = reader.parse_args()
    defined, needed = read_symbols(how.build)
    table = (TOP / "src/program/lab/lab.c").read_text(encoding="utf-8")
    symbols = {s[4:].replace("_", "-"): s for s in re.findall(r"&(lab_\w+)", table)}
    unknown = [name for name in how.names if name not in symbols]
    if unknown or not symbols:
        sys.exit(f"lab_stamps.py: no experiment {', '.join(unknown)}")
    memory, hashes = {}, {}
    for name in how.names or sorted(symbols):
        files = sources(defined[symbols[name]], defined, needed, memory)
        for path in files:
            hashes.setdefault(path, content(path))
        total = hashlib.sha256(b"".join(path.encode() + hashes[path] for path in files)).hexdigest()[:16]
        total = "outdated" if how.outdated else total
        stamp = f"experiment,rays,sources\n{name},{'yes' if RAYS in files else 'no'},{total}\n"
        place = KEPT / name / f"{name}-stamp.csv"
        if how.files:
            print(*(f"{name}: {path}" for path in files), sep="\n")
        elif (how.write or how.outdated) and place.parent.exists():
            place.write_text(stamp, encoding="utf-8")
        elif how.stale and not (place.exists() and place.read_text(encoding="utf-8") == stamp):
            print(name)
        elif not (how.stale or how.write or how.outdated):
            print(stamp.splitlines()[1])


main()

#!/usr/bin/env python3
"""single_header.py [OUT]: makes include/aureole_sampling.h from the library's own sources.

scripts/single_header.h.in is the frame; a line `@ FILE NAME...` in it stands for those functions, types and tables of
src/FILE or include/FILE with their comments. Names begin with aureole_ in the header, so that it goes beside the library's own.
It ends by clang-format 14, as every file of the tree.
"""

import pathlib
import re
import subprocess
import sys

TREE = pathlib.Path(__file__).resolve().parent.parent


def items(text):
    """The top-level pieces of a C file: pairs of a comment and what it stands before."""
    comment, piece, depth = [], [], 0
    lines = iter(text.split("\n"))
    for line in lines:
        if not piece and line.startswith("/*"):
            comment = [line]
            while not line.endswith("*/"):
                line = next(lines)
                comment.append(line)
        elif not piece and (line in ("", 'extern "C" {', "}") or (line.startswith("#") and not line.startswith("#define"))):
            comment = [] if not line else comment
        else:
            piece.append(line)
            code = re.sub(r"/\*.*?\*/", "", line)
            depth += code.count("{") - code.count("}")
            define = piece[0].startswith("#")
            if (define and not line.endswith("\\")) or (not define and depth == 0 and code.rstrip().endswith((";", "}"))):
                yield "\n".join(comment), "\n".join(piece)
                comment, piece = [], []


def defines(piece, name):
    head = piece.split("{")[0]
    if piece.startswith("enum {"):
        return name in re.findall(r"\w+", piece)
    if piece.startswith(("typedef", "#define")):
        return piece.endswith(f" {name};") or piece.startswith(f"#define {name} ")
    return re.search(rf"\b{name}\b *[\[(=]", head) is not None and ("{" in piece or "=" in piece)


def take(path, names):
    file = next(root / path for root in (TREE / "src", TREE / "include") if (root / path).exists())
    body = path.endswith("phase_body.h")  # a text that is included with REAL and NAME, by its one name
    text = file.read_text()
    found = []
    for name in names:
        if body:
            text = text.replace("NAME", name).replace("REAL", "double")
        matches = [item for item in items(text) if defines(item[1], name)]
        if not matches:
            sys.exit(f"{file}: no {name} in it")
        comment, piece = matches[0]
        if not piece.startswith(("typedef", "enum", "#")):
            function = "=" not in piece.split("{")[0]
            piece = re.sub(r"^(static )?(inline )?" + ("" if function else "(const )?"), "", piece)
            piece = ("AUREOLE_INLINE " if function else "AUREOLE_TABLE ") + piece
        found.append((comment + "\n" if comment and not body else "") + piece)
    return "\n\n".join(found)


def plastic():
    """The steps of r2 in two dimensions in 128 bits, as src/points/pointset/generators/recurrence.c makes them."""

    def multiply(a, b):
        low = (1 << 64) - 1
        return (a >> 64) * (b >> 64) + ((a >> 64) * (b & low) >> 64) + ((a & low) * (b >> 64) >> 64)

    t = 0
    for bit in reversed(range(128)):
        candidate = t | 1 << bit
        square = multiply(candidate, candidate)
        if square + multiply(square, candidate) < 1 << 128:
            t = candidate
    return ["{UINT64_C(%#x), UINT64_C(%#x)}" % divmod(step, 1 << 64) for step in (t, multiply(t, t))]


def main():
    frame = (TREE / "scripts/single_header.h.in").read_text()
    text = re.sub(r"^@ (\S+) (.*)$", lambda match: take(match[1], match[2].split()), frame, flags=re.M)
    for name, step in zip(("@STEP1@", "@STEP2@"), plastic()):
        text = text.replace(name, step)
    text = re.sub(r"\baur_", "aureole_", text)
    text = re.sub(r"\bAUR_", "AUREOLE_", text)
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else TREE / "include/aureole_sampling.h"
    formatter = ["clang-format-14", f"--style=file:{TREE / '.clang-format'}"]
    out.write_text(subprocess.run(formatter, input=text, text=True, capture_output=True, check=True).stdout)


main()

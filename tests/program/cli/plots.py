"""Reads the figures of plots.sh back: their structure, the places of points on the axes, and their words."""

import csv
import math
import re
import struct
import sys
import xml.etree.ElementTree as tree
import zlib

odd = sys.argv[1]
failures = 0


def check(holds, what):
    global failures
    if not holds:
        failures += 1
        print("FAILED:", what)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


table = rows("figures.csv")
measures = ["l2-star", "star"]
sources = list(dict.fromkeys(row["set"] for row in table))


def expected(panel, source):
    return [(float(row["n"]), float(row[measures[panel]])) for row in table if row["set"] == sources[source]]


class Axis:
    """Numbers at places, on a logarithmic axis or a linear one: what a place stands for."""

    def __init__(self, ticks, log):
        (a, u), (b, v) = ticks[0], ticks[-1]
        self.log, self.scale = log, math.log10 if log else float
        self.low, self.at, self.step = self.scale(a), u, (v - u) / (self.scale(b) - self.scale(a))
        for number, place in ticks:
            check(abs(self.place(number) - place) < 0.02, f"the number {number} stands at {place}")

    def place(self, value):
        return self.at + (self.scale(value) - self.low) * self.step


# SVG: well-formed, and the numbers are text beside the lines of the grid.
SVG = "{http://www.w3.org/2000/svg}"


def numbers(path):
    return [float(number) for number in re.findall(r"-?[\d.]+", path)]


def svg_panels(path, log):
    """For each frame its axes, and the marks of the file by class: (x, y, fill)."""
    root = tree.parse(path).getroot()
    axes, marks, texts, lines, pending = [], {}, [], {}, {"x": [], "y": []}
    grid = []
    for element in root:
        if element.tag == SVG + "text":
            texts.append(element.text)
            try:
                pending["y" if element.get("text-anchor") == "end" else "x"].append(float(element.text))
            except ValueError:
                pass
        kind = element.get("class", "")
        for child in element:
            if kind == "grid":
                x0, y0, x1, y1 = numbers(child.get("d"))
                grid.append(("x", x0) if x0 == x1 else ("y", y0))
            elif kind == "frame" and child.tag == SVG + "path" and grid:
                both = {}
                for name in "xy":
                    places = [place for of, place in grid if of == name]
                    both[name] = Axis(list(zip(pending[name], places)), log)
                axes.append(both)
                grid, pending = [], {"x": [], "y": []}
            elif child.tag == SVG + "circle":
                marks.setdefault(kind, []).append((float(child.get("cx")), float(child.get("cy")), child.get("fill"), float(child.get("r"))))
            elif not child.get("d", "").endswith("Z"):
                lines.setdefault(kind, []).append(numbers(child.get("d")))
            elif child.get("d", ""):
                at = numbers(child.get("d"))
                marks.setdefault(kind, []).append(((min(at[::2]) + max(at[::2])) / 2, (min(at[1::2]) + max(at[1::2])) / 2, child.get("fill")))
    return axes, marks, texts, lines


def agrees(places, axes, data, what):
    check(len(places) == len(data), f"{what}: {len(places)} marks of {len(data)}")
    for (x, y, *_), (n, value) in zip(places, data):
        off = max(abs(axes["x"].place(n) - x), abs(axes["y"].place(value) - y))
        check(off < 0.03, f"{what}: {n}, {value} stand {off} pixels off")


axes, marks, texts, lines = svg_panels("a.svg", True)
check(len(axes) == 2, f"{len(axes)} panels")
for source, mark in enumerate(["m0", "m1"]):  # disks and squares, whose middles are the points
    count = len(expected(0, source))
    places = [place for place in marks[mark]]
    # Each panel's marks are followed by the one of its legend.
    for panel in range(2):
        agrees(places[panel * (count + 1):][:count], axes[panel], expected(panel, source), f"SVG {sources[source]} {panel}")
# Bars of the random set go from one spread below the mean to one above; the line is the fit by least squares.
spreads = [(float(row["n"]), float(row["l2-star"]), float(row["l2-star-spread"])) for row in table if row["set"] == "random"]
# A bar is one line: its upper end, down, and its lower end unless it leaves the panel.
bars = [(at[4], at[7], at[6], at[5]) for at in lines["l2"] if len(at) in (8, 12) and at[4] == at[6]][:len(spreads)]
for (x, bottom, _, top), (n, value, spread) in zip(bars, spreads):
    axis = axes[0]["y"]
    check(abs(x - axes[0]["x"].place(n)) < 0.03 and abs(axis.place(value + spread) - top) < 0.03, f"the bar at {n}")
    check(value <= spread or abs(axis.place(value - spread) - bottom) < 0.03, f"the lower end of the bar at {n}")
check(len(bars) == 3, "bars")
logs = [(math.log(n), math.log(value)) for n, value in expected(0, 0)]
mx, my = (sum(of) / len(logs) for of in zip(*logs))
slope = sum((x - mx) * (y - my) for x, y in logs) / sum((x - mx) ** 2 for x, _ in logs)
ends = next(at for at in lines["l0"] if abs(at[0] - at[2]) > 10) # bars have shorter strokes
for x, n in ((0, 16), (2, 200)):
    y = math.exp(my + slope * (math.log(n) - mx))
    check(abs(ends[x] - axes[0]["x"].place(n)) < 0.03 and abs(ends[x + 1] - axes[0]["y"].place(y)) < 0.03, f"the fit at {n}")
check(any(text.startswith(f"sobol  slope {slope:.3f}") for text in texts), f"the slope {slope}")
check(any(text.startswith(odd) for text in texts), "SVG has the odd name")

axes, marks, texts, lines = svg_panels("floor.svg", False)
floor = rows("floor.csv")
lux = [float(row["lux"]) for row in floor]
cells = marks["scale"][:len(floor)]
agrees(cells, axes[0], [(float(row["x"]), float(row["z"])) for row in floor], "cells")
check(len(marks["scale"]) == len(floor) + 64, "cells and the scale")
check(cells[lux.index(max(lux))][2] == "#ffffe0", f"the brightest cell is {cells[lux.index(max(lux))][2]}")
check("lux" in texts, "the scale has its unit")
for (_, _, color), value in zip(cells, lux):  # the ramp of aur_image_false_color has these parts of red
    ramp = [0.00, 0.16, 0.42, 0.70, 0.90, 0.98, 0.98, 1.00]
    at = min(7 * value / max(lux), 6.999999)
    red = 255 * (ramp[int(at)] + (at - int(at)) * (ramp[int(at) + 1] - ramp[int(at)]))
    check(abs(int(color[1:3], 16) - red) < 1.01, f"{value} lux is {color}")
axes, marks, texts, lines = svg_panels("power.svg", False)
power = rows("power.csv")
agrees(marks["scale"][:len(power)], axes[0], [(float(row["kx"]), float(row["ky"])) for row in power], "periodogram")
for (_, _, color), row in zip(marks["scale"], power):
    grey = round(255 * min(float(row["power"]) / 4, 1))
    check(abs(int(color[1:3], 16) - grey) <= 1 and color[1:3] == color[5:7], f"power {row['power']} is {color}")

_, marks, _, _ = svg_panels("points.svg", False)
points = [(float(row["u"]), float(row["v"])) for row in rows("points.csv")]
check(len(marks["text"]) == 60, "points")
for (x, y, *_), (u, v) in zip(marks["text"], points):
    check(abs(x - (20 + 360 * u)) < 0.006 and abs(y - (380 - 360 * v)) < 0.006, f"point {u}, {v} at {x}, {y}")

_, marks, _, _ = svg_panels("weights.svg", False)
weights = rows("weights.csv")
for (x, y, _, _), row in zip(marks["scale"], weights):
    u = [float(row[name]) for name in "xyz"]
    r = math.sqrt(1 - u[2]) / math.hypot(u[0], u[1])
    middle, half = 0.5 * (24 + 460), 0.5 * 436 / 1.05
    check(abs(x - (240 + half * r * u[0])) < 0.02 and abs(y - (middle - half * r * u[1])) < 0.02, f"sample {u} at {x}, {y}")
check(len([mark for mark in marks["scale"] if len(mark) == 4]) == 50, "samples")

# PDF: the table of objects, the length of the stream, and the same places as in SVG.
for name in ("a", "weights", "points", "floor"):
    data = open(name + ".pdf", "rb").read()
    start = int(re.search(rb"startxref\n(\d+)\n%%EOF\n$", data)[1])
    count = int(re.match(rb"xref\n0 (\d+)\n", data[start:])[1])
    entries = data[data.index(b"\n", start + 5) + 1:][:20 * count]
    check(entries[:20] == b"0000000000 65535 f \n", f"{name}.pdf: the free entry")
    for index in range(1, count):
        entry = entries[20 * index:20 * index + 20]
        check(re.fullmatch(rb"\d{10} 00000 n \n", entry) is not None, f"{name}.pdf: {entry}")
        check(data[int(entry[:10]):].startswith(b"%d 0 obj\n" % index), f"{name}.pdf: object {index} is elsewhere")
    begin = data.index(b"stream\n") + 7
    length = int(re.search(rb"6 0 obj\n(\d+)\n", data)[1])
    check(data[begin + length:].startswith(b"endstream"), f"{name}.pdf: the length of its stream")
data = open("a.pdf", "rb").read()
stream = data[data.index(b"stream\n"):data.index(b"endstream")].decode("latin-1")
circles = re.findall(r"([\d.]+) ([\d.]+) m\n(?:[-\d. ]+ c\n){4}f", stream)
svg_circles = [mark[:2] for mark in svg_panels("a.svg", True)[1]["m0"]]
check([(round(float(x) - 2.6, 2), float(y)) for x, y in circles] == svg_circles, "PDF has the disks of SVG")
words = re.search(r"\((a<b>.*?)\) Tj", stream)[1]
check(re.search(r"[^\\][()]", words) is None, f"PDF has a bracket too many in {words}")
latin = re.sub(r"\\(\d{3})", lambda code: chr(int(code[1], 8)), re.sub(r"\\([()\\])", r"\1", words))
check(latin.startswith(odd), f"PDF has the words {latin}")
check("(100) Tj" in stream, "PDF has the number 100")
# A number of three digits, each 556 thousandths wide (Adobe's metrics), has its middle at its line of the grid.
x = float(re.search(r"1 0 0 -1 ([\d.]+) [\d.]+ Tm \(100\) Tj", stream)[1]) + 1.5 * 0.556 * 12
check(abs(x - svg_panels("a.svg", True)[0][0]["x"].place(100)) < 0.02, "PDF centres its numbers")

# PNG: chunks and sums; the points of the square are dark, and nothing between them is.
for name in ("a", "weights", "points", "floor"):
    data = open(name + ".png", "rb").read()
    check(data[:8] == b"\x89PNG\r\n\x1a\n", f"{name}.png")
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        check(struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + body), f"{name}.png: {kind}")
        if kind == b"IHDR":
            width, height = struct.unpack(">II", body[:8])
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    root = tree.parse(name + ".svg").getroot()
    check((str(width), str(height)) == (root.get("width"), root.get("height")), f"{name}.png has the size of {name}.svg")
    if name in ("a", "points"):
        raw, stride, before, pixels = zlib.decompress(packed), 3 * width, bytearray(3 * width), []
        for row in range(height):
            kind, line = raw[row * (stride + 1)], bytearray(raw[row * (stride + 1) + 1:(row + 1) * (stride + 1)])
            for i in range(stride):
                a, b = line[i - 3] if i > 2 else 0, before[i]
                c = before[i - 3] if i > 2 else 0
                p = [abs(b - c), abs(a - c), abs(a + b - 2 * c)]
                line[i] = (line[i] + [0, a, b, (a + b) // 2, (a, b, c)[p.index(min(p))]][kind]) & 255
            before = line
            pixels.append(line[::3])
    if name == "a":  # the number 100 has its middle at its line of the grid, below the frame
        x = svg_panels("a.svg", True)[0][0]["x"].place(100)
        ink = [i for row in pixels[364:378] for i in range(int(x) - 16, int(x) + 16) if row[i] < 60]
        check(len(ink) > 20 and abs(sum(ink) / len(ink) + 0.5 - x) < 1.5, "PNG centres its numbers")
    if name == "points":
        for u, v in points:
            check(pixels[int(380 - 360 * v)][int(20 + 360 * u)] < 30, f"no dot of PNG at {u}, {v}")
        far = [pixels[y][x] for y in range(22, 379, 3) for x in range(22, 379, 3)
               if all(math.hypot(x + 0.5 - 20 - 360 * u, y + 0.5 - 380 + 360 * v) > 6 for u, v in points)]
        check(min(far) == 255, "PNG has ink where no point is")

# TeX: braces are balanced, and the tables are the data.
for name in ("a", "weights", "points", "floor"):
    text = open(name + ".tex", encoding="utf-8").read()
    bare = re.sub(r"\\[\\{}$&#_%]", "", "\n".join(line for line in text.split("\n") if not line.startswith("%")))
    depth = 0
    for letter in bare:
        depth += (letter == "{") - (letter == "}")
        check(depth >= 0, f"{name}.tex: a brace too many")
    check(depth == 0, f"{name}.tex: braces")
    check(re.findall(r"\\begin\{(\w+)\}", text) == re.findall(r"\\end\{(\w+)\}", text)[::-1], f"{name}.tex: environments")
text = open("a.tex", encoding="utf-8").read()
tables = [[[float(number) for number in line.split()] for line in body.split("\\\\\n")[:-1]]
          for body in re.findall(r"x y above below\\\\\n(.*?)\};", text, re.S)]
wanted = [expected(panel, source) for panel in range(2) for source in range(len(sources))]
check(len(tables) == len(wanted), f"{len(tables)} tables in TeX")
for got, data in zip(tables, wanted):
    check(len(got) == len(data) and all(a == n and b == float(f"{value:.9g}") for (a, b, *_), (n, value) in zip(got, data)),
          f"a table in TeX: {got}")
bars = tables[sources.index("random")]
check(all(abs(above - spread) < 1e-8 and abs(below - spread) < 1e-8 for (_, _, above, below), (_, _, spread) in zip(bars, spreads)),
      f"bars in TeX: {bars}")
escaped = "".join({"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}.get(c, "\\" + c if c in "{}$&#_%" else c)
                  for c in odd)
check(r"\addlegendentry{" + escaped in text, "TeX has the odd name")
text = open("floor.tex", encoding="utf-8").read()
corners = [line.split() for line in re.search(r"x y value\\\\\n(.*?)\};", text, re.S)[1].split("\\\\\n")[:-1]]
check([float(corners[4 * i][2]) for i in range(len(floor))] == [float(f"{value:.9g}") for value in lux], "TeX has the lux")
bad = next(element.text for element in tree.parse("bad.svg").getroot() if (element.text or "").startswith("b"))
check(re.fullmatch(r"b\?\s\?{6}e\.csv", bad), f"SVG of bad letters: {bad!r}")
check(r"\addlegendentry{b" + 8 * "?" + "e.csv}" in open("bad.tex", encoding="utf-8").read(), "TeX of bad letters")
check(b"(b" + 8 * b"?" + b"e.csv) Tj" in open("bad.pdf", "rb").read(), "PDF of bad letters")
sys.exit(failures > 0)

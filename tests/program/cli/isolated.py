"""isolated.py IMAGE.pfm: counts pixels whose luminance is above 1.5 times that of all pixels around, or below it over 1.5."""
import array
import sys

with open(sys.argv[1], "rb") as file:
    head, size, scale, data = file.read().split(b"\n", 3)
width, height = map(int, size.split())
values = array.array("f", data)
light = [0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in zip(values[::3], values[1::3], values[2::3])]
bright = dark = 0
for y in range(height):
    for x in range(width):
        near = [light[v * width + u] for v in range(max(y - 1, 0), min(y + 2, height))
                for u in range(max(x - 1, 0), min(x + 2, width)) if (u, v) != (x, y)]
        bright += light[y * width + x] > 1.5 * max(near)
        dark += 1.5 * light[y * width + x] < min(near)
print(bright, dark)

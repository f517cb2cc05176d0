#!/usr/bin/env python3
"""Writes a city of blocks on a square grid as an OBJ: towers of 3 x 3 cells, streets of 2 cells, random heights.

    python3 bench/peers/city.py CITY.obj [--facets 22000] [--seed 1]

Cells are 5 m wide, walls are divided into squares of 5 m, and squares into two triangles. There are at least as many facets
as requested. Towers (g tower-X-Y) and the ground are groups.
"""
import argparse
import random


def make(towers, seed):
    """Quads of corners in cells: {group: [(a, b, c, d), ..]}, counter-clockwise seen from outside."""
    dice = random.Random(seed)
    size = 5 * towers + 2
    height = [[0] * size for _ in range(size)]
    group = [["ground"] * size for _ in range(size)]
    for x in range(towers):
        for y in range(towers):
            levels = dice.randint(1, 7)
            for i in range(3):
                for j in range(3):
                    height[5 * x + 2 + i][5 * y + 2 + j] = levels
                    group[5 * x + 2 + i][5 * y + 2 + j] = f"tower-{x}-{y}"
    quads = {}
    for x in range(size):
        for y in range(size):
            h = height[x][y]
            mine = quads.setdefault(group[x][y], [])
            mine.append(((x, y, h), (x + 1, y, h), (x + 1, y + 1, h), (x, y + 1, h)))
            # Each side of the cell: its two corners, so that the wall faces away from the cell.
            sides = (((x + 1, y), (x + 1, y + 1), (1, 0)), ((x, y + 1), (x, y), (-1, 0)),
                     ((x + 1, y + 1), (x, y + 1), (0, 1)), ((x, y), (x + 1, y), (0, -1)))
            for a, b, (dx, dy) in sides:
                other = height[x + dx][y + dy] if 0 <= x + dx < size and 0 <= y + dy < size else h
                for z in range(other, h):
                    mine.append(((*a, z), (*b, z), (*b, z + 1), (*a, z + 1)))
    return quads


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("path")
    options.add_argument("--facets", type=int, default=22000)
    options.add_argument("--seed", type=int, default=1)
    given = options.parse_args()
    towers = max(1, int((given.facets / 220) ** 0.5))  # a tower has some 150 facets
    while 2 * sum(map(len, (quads := make(towers, given.seed)).values())) < given.facets:
        towers += 1
    numbers = {}
    with open(given.path, "w") as out:
        for name, faces in quads.items():
            out.write(f"g {name}\n")
            for corners in faces:
                for corner in corners:
                    if corner not in numbers:
                        numbers[corner] = len(numbers) + 1
                        out.write("v {} {} {}\n".format(*(5 * c for c in corner)))
                out.write("f {} {} {} {}\n".format(*(numbers[c] for c in corners)))


if __name__ == "__main__":
    main()

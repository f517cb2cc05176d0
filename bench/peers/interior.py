#!/usr/bin/env python3
"""Writes a living room of many shapes as a scene for Mitsuba 3 and Aureole: textures, plastics, glass, metal and masks.

    python3 bench/peers/interior.py FOLDER [--shelves 3] [--seed 1]

FOLDER/interior.xml has about 40 shapes per shelf and 50 more: books are boxes, vases and balls are meshes with vertex
normals, leaves are rectangles with a mask. Light sources are three rectangles below the ceiling and a sphere.
"""
import argparse
import math
import os
import random
import struct
import zlib


def write_png(path, width, height, texel):
    """8 bits per channel; texel(x, y) returns red, green and blue."""
    rows = b"".join(b"\0" + bytes(max(0, min(255, int(c))) for x in range(width) for c in texel(x, y)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_pictures(folder, dice):
    planks = [dice.uniform(.7, 1) for _ in range(64)]
    grain = [[dice.uniform(.85, 1) for _ in range(16)] for _ in range(256)]

    def wood(x, y):
        shade = planks[x // 32] * grain[y][x % 16] * (0.5 if x % 32 == 0 else 1)
        return 190 * shade, 130 * shade, 80 * shade

    def paper(x, y):
        stripe = 1 if (x // 16) % 2 else .85
        return 225 * stripe, 215 * stripe, 190 * stripe + 20 * math.sin(y / 9)

    def cover(x, y):
        border = x < 8 or y < 8 or x > 119 or y > 119
        return (230, 200, 120) if border else (60 + x, 90 + grain[y][x % 16] * 60, 180 - y)

    def leaf(x, y):
        inside = abs(x - 32) < 30 * math.sin(math.pi * (y + .5) / 128) ** .8
        return (255, 255, 255) if inside else (0, 0, 0)
    write_png(os.path.join(folder, "wood.png"), 256, 256, wood)
    write_png(os.path.join(folder, "paper.png"), 128, 128, paper)
    write_png(os.path.join(folder, "cover.png"), 128, 128, cover)
    write_png(os.path.join(folder, "leaf.png"), 64, 128, leaf)


def write_turned(path, profile, around=48):
    """A surface of revolution about y as OBJ, with normals and texture coordinates; the profile has (radius, height)."""
    rows = len(profile)
    with open(path, "w", encoding="utf-8") as file:
        for i, (radius, height) in enumerate(profile):
            before, after = profile[max(i - 1, 0)], profile[min(i + 1, rows - 1)]
            out, up = after[1] - before[1], before[0] - after[0]
            size = math.hypot(out, up) or 1
            for k in range(around + 1):
                c, s = math.cos(2 * math.pi * k / around), math.sin(2 * math.pi * k / around)
                file.write(f"v {radius * c:.6f} {height:.6f} {-radius * s:.6f}\nvt {k / around:.6f} {i / (rows - 1):.6f}\n"
                           f"vn {out / size * c:.6f} {up / size:.6f} {-out / size * s:.6f}\n")
        for i in range(rows - 1):
            for k in range(around):
                a, b = i * (around + 1) + k + 1, i * (around + 1) + k + 2
                for corners in ((a, b, b + around + 1), (a, b + around + 1, a + around + 1)):
                    file.write("f " + " ".join(f"{c}/{c}/{c}" for c in corners) + "\n")


def write_meshes(folder):
    steps = [i / 31 for i in range(32)]
    write_turned(os.path.join(folder, "ball.obj"), [(math.sin(math.pi * t), 1 - math.cos(math.pi * t)) for t in steps])
    write_turned(os.path.join(folder, "vase.obj"),
                 [(.28 + .3 * math.sin(math.pi * t ** .7) + .06 * math.sin(9 * t), 2 * t) for t in steps])
    write_turned(os.path.join(folder, "bowl.obj"), [(math.sin(1.5 * t) + .02, .8 * (1 - math.cos(1.5 * t))) for t in steps])


def rgb(name, color):
    return f'<rgb name="{name}" value="{color[0]:.3f}, {color[1]:.3f}, {color[2]:.3f}"/>'


def bitmap_texture(name, file, scale=1):
    return (f'<texture type="bitmap" name="{name}"><string name="filename" value="{file}"/><transform name="to_uv">'
            f'<scale x="{scale}" y="{scale}"/></transform></texture>')


def two_sided(inner):
    return f'<bsdf type="twosided">{inner}</bsdf>'


def shape(kind, transform, material, extra=""):
    return f'<shape type="{kind}">{extra}<transform name="to_world">{transform}</transform>{material}</shape>\n'


def mesh(name, size, place, material):
    return shape("obj", f'<scale value="{size}"/><translate x="{place[0]:.4f}" y="{place[1]:.4f}" z="{place[2]:.4f}"/>', material,
                 f'<string name="filename" value="{name}.obj"/>')


def box(size, place, material, turn=0.0):
    return shape("cube", f'<scale x="{size[0] / 2:.4f}" y="{size[1] / 2:.4f}" z="{size[2] / 2:.4f}"/><rotate y="1" angle="{turn:.2f}"/>'
                 f'<translate x="{place[0]:.4f}" y="{place[1]:.4f}" z="{place[2]:.4f}"/>', material)


def wall(size, turn, place, material, extra=""):
    return shape("rectangle", f'<scale x="{size[0] / 2}" y="{size[1] / 2}"/>{turn}<translate x="{place[0]}" y="{place[1]}" '
                 f'z="{place[2]}"/>', material + extra)


def materials(dice):
    """Functions that create objects of a color."""
    def color():
        return [dice.uniform(.15, .85) for _ in range(3)]
    return [
        lambda: two_sided(f'<bsdf type="diffuse">{rgb("reflectance", color())}</bsdf>'),
        lambda: two_sided(f'<bsdf type="diffuse">{bitmap_texture("reflectance", "cover.png")}</bsdf>'),
        lambda: two_sided(f'<bsdf type="plastic">{rgb("diffuse_reflectance", color())}</bsdf>'),
        lambda: two_sided(f'<bsdf type="plastic">{bitmap_texture("diffuse_reflectance", "cover.png")}</bsdf>'),
        lambda: two_sided(f'<bsdf type="roughplastic"><float name="alpha" value=".15"/>{rgb("diffuse_reflectance", color())}</bsdf>'),
        lambda: two_sided('<bsdf type="roughconductor"><string name="material" value="Cu"/><float name="alpha" value=".2"/></bsdf>'),
        lambda: '<bsdf type="dielectric"/>',
    ]


def interior(shelves, dice):
    diffuse = two_sided('<bsdf type="diffuse"><rgb name="reflectance" value=".7, .68, .64"/></bsdf>')
    paper = two_sided(f'<bsdf type="diffuse">{bitmap_texture("reflectance", "paper.png", 4)}</bsdf>')
    wood = two_sided(f'<bsdf type="roughplastic"><float name="alpha" value=".2"/>{bitmap_texture("diffuse_reflectance", "wood.png", 3)}</bsdf>')
    board = two_sided(f'<bsdf type="diffuse">{bitmap_texture("reflectance", "wood.png")}</bsdf>')
    text = wall((6, 5), '<rotate x="1" angle="-90"/>', (0, 0, 0), wood) + wall((6, 5), '<rotate x="1" angle="90"/>', (0, 3, 0), diffuse)
    text += wall((6, 3), "", (0, 1.5, -2.5), paper) + wall((6, 3), '<rotate y="1" angle="180"/>', (0, 1.5, 2.5), paper)
    text += wall((5, 3), '<rotate y="1" angle="90"/>', (-3, 1.5, 0), diffuse) + wall((5, 3), '<rotate y="1" angle="-90"/>', (3, 1.5, 0), paper)
    for x in (-1.8, 0, 1.8):
        text += wall((.9, .3), '<rotate x="1" angle="90"/>', (x, 2.98, .3), '<bsdf type="diffuse"/>',
                     f'<emitter type="area">{rgb("radiance", (40, 34, 26))}</emitter>')
    kinds = materials(dice)
    for level in range(shelves):
        y = .5 + 2.2 * level / max(shelves, 1)
        text += box((5.2, .04, .4), (0, y, -2.3), board)
        x = -2.5
        while x < 2.45:
            thick, high = dice.uniform(.05, .16), dice.uniform(.25, .42)
            if dice.random() < .15:
                text += mesh(dice.choice(("vase", "ball", "bowl")), .12, (x + .12, y + .021, -2.28), dice.choice(kinds)())
                x += .26
            else:
                text += box((thick, high, .28), (x + thick / 2, y + .021 + high / 2, -2.3), dice.choice(kinds[:5])(), dice.uniform(-4, 4))
                x += thick + .02
    text += box((1.6, .05, .9), (.2, .72, -.2), '<bsdf type="thindielectric"/>')  # a table of glass on four legs
    for x, z in ((-.5, -.55), (.9, -.55), (-.5, .15), (.9, .15)):
        text += box((.05, .69, .05), (x, .346, z), board)
    for i in range(12):
        angle = 2 * math.pi * i / 12
        text += mesh(dice.choice(("vase", "ball", "bowl")), .09, (.2 + .6 * math.cos(angle), .746, -.2 + .32 * math.sin(angle)),
                     dice.choice(kinds)())
    leaf = (f'<bsdf type="mask">{bitmap_texture("opacity", "leaf.png")}' +
            two_sided('<bsdf type="diffuse"><rgb name="reflectance" value=".15, .5, .1"/></bsdf>') + "</bsdf>")
    text += mesh("vase", .35, (-2.1, .01, -1.2), kinds[4]())
    for i in range(24):
        text += shape("rectangle", f'<scale x=".1" y=".35"/><translate y=".35"/><rotate x="1" angle="{dice.uniform(10, 70):.1f}"/>'
                      f'<rotate y="1" angle="{360 * i / 24 + dice.uniform(0, 9):.1f}"/><translate x="-2.1" y=".65" z="-1.2"/>', leaf)
    text += mesh("ball", .12, (2.2, 1.2, -1.2), f'<emitter type="area">{rgb("radiance", (12, 9, 6))}</emitter>')
    text += box((.5, 1.19, .5), (2.2, .6, -1.2), board)
    text += wall((1.2, .9), '<rotate y="1" angle="90"/>', (-2.98, 1.7, .3), two_sided('<bsdf type="conductor"/>'))  # a mirror
    return text


def write(folder, shelves=3, seed=1):
    """Returns the scene's path and how many shapes it has."""
    dice = random.Random(seed)
    write_pictures(folder, dice)
    write_meshes(folder)
    text = ('<scene version="3.0.0">\n<integrator type="path"/>\n<sensor type="perspective"><float name="fov" value="62"/>'
            '<transform name="to_world"><lookat origin="1.2, 1.6, 2.3" target="-.3, 1.1, -2" up="0, 1, 0"/></transform>'
            '<sampler type="independent"><integer name="sample_count" value="64"/></sampler><film type="hdrfilm">'
            '<integer name="width" value="480"/><integer name="height" value="320"/><rfilter type="box"/></film></sensor>\n')
    text += interior(shelves, dice) + "</scene>\n"
    path = os.path.join(folder, "interior.xml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path, text.count("<shape ")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--shelves", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    os.makedirs(given.folder, exist_ok=True)
    path, count = write(given.folder, given.shelves, given.seed)
    print(f"{path}: {count} shapes")


if __name__ == "__main__":
    main()

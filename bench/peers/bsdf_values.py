#!/usr/bin/env python3
"""Writes tests/render/material/mitsuba_values.h: values of Mitsuba 3's BSDFs for pairs of directions, with which a test compares
Aureole's (needs `pip install mitsuba`).

    bsdf_values.py > tests/render/material/mitsuba_values.h
"""
import random
import sys

import mitsuba as mi

mi.set_variant("scalar_rgb")

# Materials in the program's syntax PLUGIN:key=value,...; ">" precedes a nested BSDF, "|" a second one.
MATERIALS = (
    "principled:base_color=0.6 0.3 0.1",
    "principled:base_color=0.6 0.3 0.1,roughness=0.9,specular=0.2",
    "principled:base_color=0.6 0.3 0.1,roughness=0.3,metallic=1",
    "principled:base_color=0.6 0.3 0.1,roughness=0.4,metallic=0.3,anisotropic=0.7",
    "principled:base_color=0.6 0.3 0.1,sheen=0.8,sheen_tint=0.4,flatness=0.6",
    "principled:base_color=0.6 0.3 0.1,clearcoat=0.9,clearcoat_gloss=0.2,spec_tint=0.7",
    "principled:base_color=0.6 0.3 0.1,spec_trans=1,eta=1.5,roughness=0.4",
    "principled:base_color=0.6 0.3 0.1,spec_trans=0.6,eta=1.3,roughness=0.5,metallic=0.2,spec_tint=0.5,sheen=0.5",
    "principled:base_color=0.6 0.3 0.1,eta=0.8,metallic=0.5,spec_tint=0.5,clearcoat=0.5",
    "pplastic:diffuse_reflectance=0.6 0.3 0.1,int_ior=1.5,ext_ior=1,alpha=0.3,distribution=ggx",
    "normalmap:normalmap=0.7 0.4 0.9>roughconductor:alpha=0.4,distribution=ggx",
    "normalmap:normalmap=0.9 0.4 0.6>diffuse:reflectance=0.6 0.3 0.1",
    "normalmap:normalmap=0.2 0.3 0.8,use_shadowing_function=false>diffuse:reflectance=0.6 0.3 0.1",
    "blendbsdf:weight=0.3>diffuse:reflectance=0.6 0.3 0.1|roughconductor:alpha=0.4,distribution=ggx",
    "principledthin:base_color=0.6 0.3 0.1",
    "principledthin:base_color=0.6 0.3 0.1,spec_trans=0.7,roughness=0.4,eta=1.4,spec_tint=0.3",
    "principledthin:base_color=0.6 0.3 0.1,diff_trans=0.8,sheen=0.6,sheen_tint=0.3,flatness=0.4",
    "principledthin:base_color=0.6 0.3 0.1,spec_trans=0.5,anisotropic=0.8,diff_trans=1.5,roughness=0.6",
    "roughplastic:diffuse_reflectance=0.6 0.3 0.1,alpha=0.1,as_mitsuba=true",
    "roughplastic:diffuse_reflectance=0.6 0.3 0.1,alpha=0.4,nonlinear=true,as_mitsuba=true",
    "roughplastic:diffuse_reflectance=0.6 0.3 0.1,alpha=0.2,distribution=ggx,int_ior=1.6,as_mitsuba=true",
)
PAIRS = 12


def load(text):
    text, _, nested = text.partition(">")
    plugin, _, rest = text.partition(":")
    made = {"type": plugin}
    for i, inner in enumerate(nested.split("|") if nested else []):
        made[f"nested_{i}"] = load(inner)
    for item in rest.split(","):
        key, _, value = item.partition("=")
        if key == "as_mitsuba":  # a key of Aureole only
            continue
        numbers = [float(x) for x in value.split()] if value[0].isdigit() else []
        plain = value == "true" if value in ("true", "false") else value
        made[key] = {0: plain, 1: (numbers or [0])[0], 3: {"type": "rgb", "value": numbers}}[len(numbers)]
    return mi.load_dict(made)


def direction(draw):
    while True:
        v = mi.Vector3f(*[draw.uniform(-1, 1) for _ in range(3)])
        length = sum(float(c) ** 2 for c in v) ** 0.5
        if 0.2 < length < 1 and abs(v.z / length) > 0.05:
            return v / length


def main():
    if len(sys.argv) > 1:
        sys.exit(__doc__)
    print("/* What Mitsuba 3's materials evaluate to: BSDF times cosine, RGB. Written by bench/peers/bsdf_values.py with\n"
          f" * Mitsuba {mi.__version__}. */\n#pragma once\n\n#include \"core/vector.h\"\n\n"
          "typedef struct mitsuba_value {\n    const char *material;\n    aur_vector view, light, value;\n} mitsuba_value;\n\n"
          "static const mitsuba_value mitsuba_values[] = {")
    draw = random.Random(1)
    for text in MATERIALS:
        bsdf = load(text)
        for i in range(PAIRS):
            at = mi.SurfaceInteraction3f()
            at.wi, light = direction(draw), direction(draw)
            if i % 3 == 0:  # near the mirror direction, inside the lobes
                light = mi.Vector3f(-at.wi.x, -at.wi.y, at.wi.z) + 0.2 * light
                light = light / sum(float(c) ** 2 for c in light) ** 0.5
            elif i % 3 == 1:
                at.wi.z, light.z = abs(at.wi.z), abs(light.z)
            value = bsdf.eval(mi.BSDFContext(), at, light)
            numbers = ", ".join("{" + ", ".join(f"{float(c):.9g}f" if "." in f"{float(c):.9g}" or "e" in f"{float(c):.9g}"
                                                else f"{float(c):.9g}.0f" for c in v) + "}" for v in (at.wi, light, value))
            print(f'    {{"{text}",\n     {numbers}}},')
    print("};")


if __name__ == "__main__":
    main()

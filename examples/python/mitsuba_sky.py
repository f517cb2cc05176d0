"""Mitsuba 3 driven with Aureole's directions and weights: the light of a sky on a floor, open or below a ball.

    pip install mitsuba aureole && python mitsuba_sky.py [DIRECTIONS]

Mitsuba traces the rays and knows the sky; Aureole says where to look. Directions follow the cosine, so that equal weights are
their own way. Optimal weights (Marques 2018) take the same rays: they gain where light varies smoothly, as under the open sky,
and little where an edge hides part of it. At every point the set is turned at random about the normal, as a renderer would.
"""

import sys

import mitsuba as mi
import numpy as np

import aureole

mi.set_variant("scalar_rgb")
COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 64
REFERENCE = 4096

# A sky that is brightest in one direction, as an environment map: latitude and longitude about +y, turned to +z.
v, u = np.meshgrid((np.arange(64) + 0.5) / 64, (np.arange(128) + 0.5) / 128, indexing="ij")
sky = np.exp(2 * (np.sin(np.pi * v) * np.cos(2 * np.pi * u) * 0.6 + np.cos(np.pi * v) * 0.8 - 1))
transform = mi.ScalarTransform4f()
parts = {
    "type": "scene",
    "sky": {
        "type": "envmap",
        "bitmap": mi.Bitmap(np.repeat(sky[:, :, np.newaxis], 3, axis=2).astype(np.float32)),
        "to_world": transform.rotate([1, 0, 0], 90),
    },
    "floor": {"type": "rectangle", "to_world": transform.scale([10, 10, 1])},
}
scenes = {
    "open sky": mi.load_dict(parts),
    "below a ball": mi.load_dict({**parts, "ball": {"type": "sphere", "center": [0, 0, 2], "radius": 1}}),
}


def radiance(scene, point, directions):
    """The sky's radiance from each direction, 0 where the ball is in between."""
    origin = mi.Point3f(*(point + [0, 0, 1e-4]))
    values = np.zeros(len(directions))
    for index, direction in enumerate(directions):
        hit = scene.ray_intersect(mi.Ray3f(origin, mi.Vector3f(*direction)))
        if not hit.is_valid():
            values[index] = scene.environment().eval(hit)[0]
    return values


def rule(count):
    return aureole.points("spherical-fibonacci", count, domain="hemisphere", lobe="cosine")


x, y = np.meshgrid(np.linspace(-2, 2, 4), np.linspace(-2, 2, 4))
points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
even, reference = rule(COUNT), rule(REFERENCE)
optimal = aureole.weights(even, lobe="cosine")
for name, scene in scenes.items():
    errors = {"random": [], "even": [], "even, optimal weights": []}
    for index, point in enumerate(points):
        exact = radiance(scene, point, reference).mean()
        random = aureole.points("random", COUNT, domain="hemisphere", lobe="cosine", seed=index)
        seen = radiance(scene, point, aureole.rotate(even, index, about_z=True))  # weights turn with their directions
        errors["random"].append(radiance(scene, point, random).mean() / exact - 1)
        errors["even"].append(seen.mean() / exact - 1)
        errors["even, optimal weights"].append(optimal @ seen / exact - 1)
    print(f"{name}, {COUNT} directions at each of {len(points)} points: relative root mean square error of the irradiance")
    for kind, values in errors.items():
        print(f"  {kind:22} {np.sqrt(np.mean(np.square(values))):.5f}")

"""Where a model stands, how it is turned, and in which unit it is written."""

from pathlib import Path

import models
from relations import relation
from runs import nearly_equal, same_means

PLACES = {"1e3": (1000.0, -1000.0, 10.0), "1e5": (1e5, 1e5, 0.0), "LV95": (2600000.0, 1200000.0, 500.0),
          "UTM": (500000.0, 5400000.0, 100.0), "1e7": (1e7, -1e7, 1e7)}


def places(context):
    return PLACES if context.full else {k: PLACES[k] for k in ("1e5", "UTM", "1e7")}


def moved(context, answer, model):
    """`answer`(model, seeds) at each place against that at the origin, with other seeds."""
    here = answer(model, range(context.seeds))
    return worst(same_means(here, answer(model.moved(offset), range(100 + 100 * i, 100 + 100 * i + context.seeds)), CLOSED)
                 for i, offset in enumerate(places(context).values()))


def worst(texts):
    return max(texts, key=len)


def irradiances(context, model, seeds, writer=models.write_xml, name="place.xml"):
    writer(model, Path(name))
    sensors = models.write_sensors(model, Path("place.pts"))
    return [context.irradiance(name, sensors, seed) for seed in seeds]


def images(context, model, seeds, samples, *options, **keys):
    models.write_xml(model, Path("place.xml"), **keys)
    return [context.image("place.xml", seed, samples, *options) for seed in seeds]


def group_factors(context, model, seed, *options):
    """Those between the surfaces of the model in place.obj, and their sky factors."""
    found = context.factors("place.obj", seed, "--group", *options)
    rows = range(len(model.surfaces))
    return [found.get((i, j), (0.0, 0.0))[0] for i in rows for j in (-1, *rows)]


def closed_factors(context, model):
    models.write_obj(model, Path("place.obj"))
    return group_factors(context, model, 0)


def sampled_factors(context, model, seeds, *options):
    models.write_obj(model, Path("place.obj"))
    return [group_factors(context, model, seed, *options) for seed in seeds]


def radiosities(context, model, seeds, *options):
    models.write_obj(model, Path("place.obj"))
    return [[v for row in context.radiosity("place.obj", seed, "--group", "--rays", "512", "--radiosity", ".4", "--sky", "1", "--emission", "1", *options) for v in row]
            for seed in seeds]


MODELS = {"room": models.room, "street": models.street}
for _name, _make in MODELS.items():
    @relation("position", "irradiance", f"{_name} moved to map coordinates", "intervals")
    def _(context, make=_make):
        return moved(context, lambda m, seeds: irradiances(context, m, seeds), make())

    @relation("position", "irradiance", f"{_name} as .rad moved", "intervals")
    def _(context, make=_make):
        return moved(context, lambda m, seeds: irradiances(context, m, seeds, models.write_rad, "place.rad"), make())

    @relation("position", "render", f"{_name} moved, path", "intervals")
    def _(context, make=_make):
        return moved(context, lambda m, seeds: images(context, m, seeds, 64, "--integrator", "path"), make())

    @relation("position", "render", f"{_name} moved, camera and all, from another unit", "intervals")
    def _(context, make=_make):
        here = images(context, make(), range(context.seeds), 64, "--integrator", "path")
        there = images(context, make().scaled(1000.0).moved((3e7, 3e6, 0.0)), range(100, 100 + context.seeds), 64, "--integrator", "path",
                       far_clip=1e8, near_clip=1.0)
        return same_means(here, there)


@relation("position", "render", "room moved, finalgather", "intervals")
def _(context):
    gather = "finalgather:photons=20000,diffuse_samples=16,glossy_samples=8"
    return moved(context, lambda m, seeds: images(context, m, seeds, 16, "--integrator", gather), models.room())


@relation("position", "render", "room moved, radiosity", "intervals")
def _(context):
    return moved(context, lambda m, seeds: images(context, m, seeds, 8, "--integrator", "radiosity"), models.room())


# Rays are floats: those that begin nearer to a wall than their rounding, 2e-6 of a room's size, may begin behind it. A floor of
# 9.5 with walls of 15 and a size of 4 loses 15 / 9.5 * 2e-6 * 4 of its factors.
SLIPPED = 1.3e-5
CLOSED = 1e-8  # what the coordinates of UTM leave of a double for facets of a metre


@relation("position", "viewfactors", "plates moved: closed forms", "1e-8")
def _(context):
    here = closed_factors(context, models.plates())
    return worst(nearly_equal(here, closed_factors(context, models.plates().moved(offset)), 0.0, CLOSED) for offset in PLACES.values())


@relation("position", "viewfactors", "plates as glTF, moved by their nodes: closed forms", "1e-8")
def _(context):
    here = closed_factors(context, models.plates())

    def there(offset):
        models.write_gltf(models.plates(), Path("place.gltf"), offset)
        found = context.factors("place.gltf", 0, "--group")
        rows = range(len(models.plates().surfaces))
        return [found.get((i, j), (0.0, 0.0))[0] for i in rows for j in (-1, *rows)]

    return worst(nearly_equal(here, there(offset), 0.0, CLOSED) for offset in PLACES.values())


for _name, _make in MODELS.items():
    @relation("position", "viewfactors", f"{_name} moved: sampled factors and sky", "intervals")
    def _(context, make=_make):
        return moved(context, lambda m, seeds: sampled_factors(context, m, seeds, "--rays", "512"), make())

    @relation("position", "viewfactors --rays-only", f"{_name} moved", "intervals")
    def _(context, make=_make):
        return moved(context, lambda m, seeds: sampled_factors(context, m, seeds, "--rays", "512", "--rays-only"), make())

    for _free in ((), ("--matrix-free",)):
        @relation("position", " ".join(("viewfactors --radiosity", *_free)), f"{_name} moved", "intervals")
        def _(context, make=_make, free=_free):
            return moved(context, lambda m, seeds: radiosities(context, m, seeds, *free), make())

for _mode in ((), ("--rays-only",), ("--matrix-free",)):
    @relation("position", " ".join(("viewfactors --radiosity", *_mode)), "a rug's gap of 1e-5 of the floor made 1e-8 to 1e-6, turned and moved", "intervals")
    def _(context, mode=_mode):
        # Less than 6.5 of the gap goes by its edges; without a matrix reflections end at .02 / sqrt(512) of the light.
        here = radiosities(context, models.rug(1e-5).turned(), range(context.seeds), *mode)
        return worst(same_means(here, radiosities(context, models.rug(gap).turned().moved(offset), range(100, 100 + context.seeds), *mode),
                                1e-3 if mode == ("--matrix-free",) else 1e-4, 1e-4)
                     for gap, offset in ((1e-8, (0.0, 0.0, 0.0)), (1e-7, (0.0, 0.0, 0.0)), (1e-6, (0.0, 0.0, 0.0)), *((1e-6, o) for o in list(PLACES.values())[:-1])))

CHANGES = {"turned": lambda m: m.turned(), "mirrored": lambda m: m.mirrored(), "in millimetres": lambda m: m.scaled(1000.0),
           "in kilometres": lambda m: m.scaled(0.001)}
for _change, _map in CHANGES.items():
    @relation("position", "irradiance", f"room {_change}", "intervals")
    def _(context, change=_map):
        return same_means(irradiances(context, models.room(), range(context.seeds)),
                          irradiances(context, change(models.room()), range(100, 100 + context.seeds)))

    @relation("position", "viewfactors", f"plates {_change}: closed forms", "1e-8")
    def _(context, change=_map):
        return nearly_equal(closed_factors(context, models.plates()), closed_factors(context, change(models.plates())), 0.0, CLOSED)

    @relation("position", "viewfactors", f"room {_change}: sampled factors", "intervals")
    def _(context, change=_map):
        return same_means(sampled_factors(context, models.room(), range(context.seeds), "--rays", "512"),
                          sampled_factors(context, change(models.room()), range(100, 100 + context.seeds), "--rays", "512"), CLOSED, SLIPPED)


@relation("position", "irradiance", "a far speck is added to the room", "intervals")
def _(context):
    room = models.room()
    speck = models.Surface("speck", [[(3e3, 0.0, 0.0), (3e3, 1.0, 0.0), (3e3, 0.0, 1.0)]])
    return same_means(irradiances(context, room, range(context.seeds)),
                      irradiances(context, room.with_surfaces([*room.surfaces, speck]), range(100, 100 + context.seeds)))


FURNACE = """<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="80"/>
<float name="near_clip" value="0.001"/><transform name="to_world"><lookat origin="{x}, {x}, 0.5" target="{y}, {x}, 1" up="0, 0, 1"/></transform>
<film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/><rfilter type="box"/></film></sensor>
<shape type="{shape}">{geometry}<boolean name="flip_normals" value="true"/><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
<emitter type="area"><rgb name="radiance" value="0.5"/></emitter></shape></scene>
"""


@relation("position", "render", "a white furnace in a sphere or cube moved by up to 1e7", "mean > .999")
def _(context):
    least = 1.0
    for offset in (0.0, 1e3, 1e5, 1e6, 1e7):
        for shape in ("sphere", "cube"):
            geometry = f'<transform name="to_world"><scale value="5"/><translate x="{offset!r}" y="{offset!r}"/></transform>'
            Path("furnace.xml").write_text(FURNACE.format(x=repr(offset), y=repr(offset + 1), shape=shape, geometry=geometry))
            values = context.image("furnace.xml", 0, 64)
            mean = sum(values) / len(values)
            assert 0.999 < mean < 1.001, f"{shape} at {offset:g}: {mean:.5f}"
            least = min(least, mean)
    return f"{least:.5f} at least"

"""Scenes in XML with the settings that a comparison with Mitsuba 3 needs."""
import os
import re
import resource

PATH = '<integrator type="path"><integer name="max_depth" value="-1"/></integrator>'


def cpu_seconds(of=resource.RUSAGE_SELF):
    usage = resource.getrusage(of)
    return usage.ru_utime + usage.ru_stime


def split(argument, size="160x120"):
    """Path, width and height of SCENE.xml[:WIDTHxHEIGHT], and a short name."""
    path, _, given = argument.partition(".xml:")
    path, size = (path + ".xml", given) if given else (argument, size)
    name = os.path.join(os.path.basename(os.path.dirname(os.path.abspath(path))), os.path.basename(path))
    return path, *map(int, size.split("x")), name


def read(path, definitions=None):
    """The text of a scene: without comments and $names, with what it includes and absolute file names."""
    def without_comments(name):
        with open(name, encoding="utf-8") as file:
            return re.sub(r"<!--.*?-->", "", file.read(), flags=re.S)
    text, definitions, folder = without_comments(path), definitions or {}, os.path.dirname(os.path.abspath(path))

    def define():
        nonlocal text
        defaults = dict(re.findall(r'<default\s+name="([^"]*)"\s+value="([^"]*)"\s*/>', text)) | definitions
        for key in sorted(defaults, key=len, reverse=True):
            text = text.replace("$" + key, defaults[key])
    define()
    while included := re.search(r'<include\s+filename="([^"]*)"\s*/>', text):
        inner = re.search(r"<scene[^>]*>(.*)</scene>", without_comments(os.path.join(folder, included[1])), re.S)[1]
        text = text.replace(included[0], inner)
        define()
    return re.sub(r'(name="filename"\s+value=)"([^"]*)"', lambda m: f'{m[1]}"{os.path.join(folder, m[2])}"', text)


def change(text, integrator=PATH, sampler=None, rfilter=None, width=None, height=None, samples=None):
    """The text with another integrator, and whatever else is given."""
    for element, plugin in (("sampler", sampler), ("rfilter", rfilter)):
        if plugin is not None:
            text = re.sub(rf'<{element}\s+type="[^"]*"', f'<{element} type="{plugin}"', text)
    for name, value in (("width", width), ("height", height), ("sample_?[cC]ount", samples)):
        if value is not None:
            text = re.sub(rf'(name="{name}"\s+value=)"[^"]*"', rf'\1"{value}"', text)
    return re.sub(r"<integrator[^>]*/>|<integrator.*</integrator>", "", text, flags=re.S).replace("</scene>", integrator + "</scene>")


def load(text, width, height):
    """Mitsuba's scene and its sensor, whose film has this size: also in the text, because a sensor keeps the angle of its first film's shape."""
    import mitsuba as mi
    for name, value in (("width", width), ("height", height)):
        text = re.sub(rf"""(name=["']{name}["']\s+value=)["'][^"']*["']""", rf'\1"{value}"', text)
    try:
        scene = mi.load_string(text, parallel=False)
    except RuntimeError as error:
        unknown = re.search(r'[Pp]lugin "([^"]*)"', str(error))
        hint = "; bundled scenes with materials-rough.xml take -D materials=rough" if unknown and "phong" in unknown[1] else ""
        raise SystemExit(f"Mitsuba has no plugin '{unknown[1]}'{hint}" if unknown else str(error)) from error
    parameters = mi.traverse(scene.sensors()[0])
    parameters["film.size"] = parameters["film.crop_size"] = [width, height]
    parameters.update()
    return scene, scene.sensors()[0]

"""lab.py PROGRAM SOURCE_TREE: sets that are functions, experiments of the tree and of one's own; what goes through must come out."""

import math
import pathlib
import subprocess
import sys

import numpy as np

import aureole
from aureole import lab

PROGRAM = sys.argv[1]


def refuse(kind, function, *words):
    try:
        function()
    except kind as error:
        assert all(word in str(error) for word in words), error
    else:
        raise AssertionError(f"no {kind.__name__}")


# A function that returns the library's points is the library's set, in both copies of libaureole.
aureole.register_set("mine", lambda n: aureole.points("hammersley", n))
aureole.register_set("ball", lambda n: aureole.points("spherical-fibonacci", n, domain="sphere"), domain="sphere")
aureole.register_set("cube", lambda n, d: aureole.points("sobol", n, domain="cube", dimension=d), domain="cube")
for domain in "square", "disk", "hemisphere":
    assert np.array_equal(aureole.points("callback:mine", 50, domain=domain), aureole.points("hammersley", 50, domain=domain))
assert np.array_equal(aureole.points("callback:ball", 50, domain="sphere"), aureole.points("spherical-fibonacci", 50, domain="sphere"))
assert np.array_equal(
    aureole.points("callback:cube", 32, domain="cube", dimension=5), aureole.points("sobol", 32, domain="cube", dimension=5)
)
aureole.register_set("heavy", lambda n: (aureole.points("spherical-fibonacci", n, domain="sphere"), np.arange(n) / 6), domain="sphere", weighted=True)
assert np.array_equal(aureole.Directions("callback:heavy", 4, domain="sphere").rule()[1], np.arange(4) / 6)
integrators = [f"ao:pattern={name},samples=16" for name in ("spherical-fibonacci", "callback:ball")]
scene = aureole.Scene(f"{sys.argv[2]}/scenes/cornell-box/cornell-box.xml")
aureole.register_set("ball", lambda n: aureole.points("spherical-fibonacci", n, domain="hemisphere"), domain="hemisphere")
images = [aureole.render(scene, integrator=name, width=8, height=8, spp=1) for name in integrators]
assert np.array_equal(*images)

# What a function does wrong is told.
aureole.register_set("wrong", lambda n: np.zeros((n, 3)))
refuse(aureole.FormatError, lambda: aureole.points("callback:wrong", 4), "callback:wrong", "(4, 2)")
aureole.register_set("wrong", lambda n: 1 / 0)
refuse(aureole.FormatError, lambda: aureole.points("callback:wrong", 4), "ZeroDivisionError")
aureole.register_set("wrong", None)
refuse(aureole.UnknownNameError, lambda: aureole.points("callback:wrong", 4), "callback:wrong")

# An experiment of the tree: the files of the program, to the bit; and a set of one's own in it.
found = lab.run("marques-2019-discrepancy", quick=True, folder="tree")
subprocess.run([PROGRAM, "lab", "run", "marques-2019-discrepancy", "--quick", "-q", "-o", "program"], check=True, stdout=subprocess.DEVNULL)
name = "marques-2019-discrepancy/marques-2019-discrepancy.csv"
assert pathlib.Path("tree", name).read_bytes() == pathlib.Path("program", name).read_bytes()
assert found.claims == found.claims_held > 0 and any("claim" in note for note in found.notes)
column = lab.run("aureole-integrand", quick=True, set="callback:mine", folder="tree").table
mine, theirs = ([v for s, v in zip(column["set"], column["rmse"]) if s == name] for name in ("callback:mine", "hammersley"))
assert mine == theirs and len(mine) == 5
lab.integrand("plane", lambda u: u[:, 0], mean=0.5)
column = lab.run("aureole-integrand", quick=True, integrand="plane", folder="tree").table
# A shift of i/N modulo 1 moves the mean by at most 1/(2N).
assert all(v <= 0.5 / n + 1e-15 for s, n, v in zip(*(column[k] for k in ("set", "points", "rmse"))) if s == "hammersley")

calls = 0


@lab.experiment(
    columns="set value low high published", measured="value", low="low", high="high", published="published", factor=1.5,
    parameters={"size": 3, "word": "a"}, takes_no_set=None, plots=[lab.Plot("v", x="value", y="low", series="set")],
)  # fmt: skip
def own_test(run):
    """What it shows."""
    global calls
    further = run.table("further", "name x")

    def measure():
        global calls
        calls += 1
        return np.arange(run["size"])

    values = run.cached("some", run["size"], measure)
    assert values.tolist() == list(range(run["size"]))
    if run["word"] == "stop":
        raise KeyboardInterrupt
    run.row("one", 2.0, 1.0, 3.0, 2.5)
    run.row("two", 2.0, 1.9, 2.1, 2.5)
    run.row("three", 2.0, 1.9, 2.1, 5.0)
    run.row("four", 2.0, math.nan, None, None)
    further.row("a", 1.0)
    with run.forgive(run.set or ""):
        if run.set:
            run.row("five", aureole.measure(aureole.points(run.set, 5), "l2-star"), None, None, None)
    run.note("100 % of %s")
    run.claim(False, "nothing")
    run.image("noise", np.full((4, 4, 3), 0.25), view="v", reference=True)


assert (lab.Run.wants, lab.Run.keep, lab.Run.picture) == (lab.Run.requested, lab.Run.cached, lab.Run.image)  # names of version 0.1
found = own_test(folder="own", quick=True)
assert found.verdicts == {"agrees": 1, "within": 1, "differs": 1, "unpublished": 1} and (found.claims, found.claims_held) == (1, 0)
assert found.table["verdict"] == ["agrees", "within a factor of 1.5", "differs", "not published"]
assert found.table["low"] == [1.0, 1.9, 1.9, None] and "100 % of %s" in found.notes
assert pathlib.Path("own/own-test/own-test-further.csv").read_text() == "name,x\na,1\n"
assert np.allclose(aureole.read_image("own/own-test/own-test-v-noise.exr")[0], 0.25)
# An interruption: what was measured is kept under the same parameters.
refuse(KeyboardInterrupt, lambda: own_test(folder="own", word="stop"))
before = calls
refuse(KeyboardInterrupt, lambda: own_test(folder="own", word="stop"))
assert calls == before
refuse(aureole.UnknownNameError, lambda: own_test(folder="own", nonsense=1), "nonsense", "size, word")
# A set without a file of that size is a note.
assert "five" not in own_test(folder="own", set="file:none-%d.csv").table["set"]
assert any("left out" in note for note in own_test(folder="own", set="file:none-%d.csv").notes)
lab.main(own_test, argv=["--quick", "-o", "own", "-D", "size=4", "--report", "page"])
assert "own-test" in pathlib.Path("page/index.html").read_text()
interval = lab.root_mean([1.0, 1.0, 4.0])
assert abs(interval.value - 2**0.5) < 1e-15 and interval.low < interval.value < interval.high
assert abs(lab.slope([1, 2, 4, 8], [1, 4, 16, 64]).value - 2) < 1e-12

"""Integrals of functions from Python: constants, factors, rotations, permuted coordinates. Run where the package is built."""

import math

from relations import relation
from runs import same_means


def smooth(u):
    import numpy as np
    return np.exp(2.0 * u[:, 0]) * (1.5 + u[:, 1] * u[:, 2])


def turned(f):
    import numpy as np
    a, b = 0.7, 1.1
    turn = np.array([[math.cos(a), -math.sin(a), 0.0], [math.sin(a) * math.cos(b), math.cos(a) * math.cos(b), -math.sin(b)],
                     [math.sin(a) * math.sin(b), math.cos(a) * math.sin(b), math.cos(b)]])
    return lambda u: f(u @ turn)


@relation("integrals", "integrate, estimate", "the function times 4", "4 times, to the bit")
def _(context):
    import aureole
    for domain in ("sphere", "hemisphere"):
        once, more = (aureole.integrate(f, 1e-3, domain=domain) for f in (smooth, lambda u: 4.0 * smooth(u)))
        assert (4.0 * once.value, 4.0 * once.error, once.evaluations) == (more.value, more.error, more.evaluations), f"{domain}: {once}, {more}"
    once, more = (aureole.estimate(lambda u, w, k=k: float(k * (w * u[:, 0] ** 3).sum()), 2, tol=1e-3) for k in (1.0, 4.0))
    assert 4.0 * once.value == more.value, f"{once}, {more}"
    return "4 times, to the bit"


@relation("integrals", "integrate", "a constant is added", "1e-12")
def _(context):
    import aureole
    for domain, size in (("sphere", 4.0 * math.pi), ("hemisphere", 2.0 * math.pi)):
        options = dict(tol=0.0, absolute=1e-30, evaluations=2**13, domain=domain)
        once, more = aureole.integrate(smooth, **options), aureole.integrate(lambda u: smooth(u) + 3.0, **options)
        assert abs(more.value - once.value - 3.0 * size) < 1e-12 * abs(more.value), f"{domain}: {once}, {more}"
        assert abs(more.error - once.error) <= 1e-9 * abs(once.value), f"{domain}: the errors {once.error} and {more.error}"
    return "1e-12"


@relation("integrals", "integrate", "the function is rotated", "intervals")
def _(context):
    import aureole

    def kinked(u):
        return abs(u[:, 0] - 0.3) * (1.5 + u[:, 1] * u[:, 2])

    options = dict(tol=0.0, absolute=1e-30, evaluations=2**11)
    here = [[aureole.integrate(kinked, seed=s, **options).value] for s in range(context.seeds)]
    there = [[aureole.integrate(turned(kinked), seed=100 + s, **options).value] for s in range(context.seeds)]
    return same_means(here, there)


@relation("integrals", "estimate", "coordinates in another order", "intervals")
def _(context):
    import aureole

    def f(u, w):
        return float((w * u[:, 0] * (u[:, 1] > 0.4) * (1.0 + u[:, 2] ** 2)).sum())

    options = dict(dimension=3, tol=0.0, evaluations=2**11)
    here = [[float(aureole.estimate(f, seed=s, **options).value)] for s in range(context.seeds)]
    there = [[float(aureole.estimate(lambda u, w: f(u[:, ::-1], w), seed=100 + s, **options).value)] for s in range(context.seeds)]
    return same_means(here, there)


@relation("integrals", "weights_exact, points", "Python's numbers are the program's", "the same bits")
def _(context):
    import csv
    import io

    import aureole
    points = aureole.points("spherical-fibonacci", 60, domain="sphere")
    rows = [[float(v) for v in row] for row in csv.reader(io.StringIO(
        context.run("points", "spherical-fibonacci", "-n", "60", "--domain", "sphere", "--no-header").decode())) if not row[0].startswith("#")]
    assert rows == [[float(v) for v in p] for p in points], "other points"
    weights, _ = aureole.weights_exact(points, domain="sphere")
    text = context.run("weights", "spherical-fibonacci", "-n", "60", "--domain", "sphere", "--method", "exact").decode()
    printed = [float(row["w"]) for row in csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#"))]
    assert printed == [float(w) for w in weights], "other weights"
    return "the same bits"

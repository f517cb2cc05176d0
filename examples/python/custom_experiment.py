"""A custom experiment and a custom set in Python.

    python custom_experiment.py --quick --set r2 -o results --report report

The set is the golden ratio's lattice; the experiment integrates a bump by sets that are shifted at random, with intervals.
"""

import numpy as np

import aureole
from aureole import lab

SIZES = 16, 32, 64, 128, 256


def golden(n):
    """N points of the square for any N: the set callback:golden."""
    i = np.arange(n)
    return np.stack([(i + 0.5) / n, i * 0.6180339887498949 % 1], axis=1)


def bump(points):
    return np.exp(-((points - 0.4) ** 2).sum(axis=1) / 0.1)


@lab.experiment(
    columns="set points rmse low high",
    plots=[lab.Plot("rmse", x="points", y="rmse", low="low", high="high", series="set", log_x=True, log_y=True)],
    parameters={"seeds": 32},
)
def custom_bump(run):
    """Root mean square errors of the integral of a bump."""
    seeds = 8 if run.quick else run["seeds"]
    truth = bump(aureole.points("sobol", 2**18)).mean()
    ends = {}
    for name in run.sets("random", "sobol", "callback:golden"):
        errors = []
        for n in SIZES:
            with run.forgive(name):  # the set of --set may lack a size: a note says so

                def squares():
                    shifted = (aureole.points(name, n, scramble="shift", seed=1 + k) for k in range(seeds))
                    return [(bump(points).mean() - truth) ** 2 for points in shifted]

                rmse = lab.root_mean(run.cached(f"{name} {n}", seeds, squares))
                run.row(name, n, *rmse)
                errors.append(rmse.value)
        ends[name] = errors[-1]
        run.note(f"{name}: error falls as N^{lab.slope(SIZES[: len(errors)], errors).value:.2f}")
    run.claim(ends["callback:golden"] < ends["random"], "golden points beat random ones")


if __name__ == "__main__":
    aureole.register_set("golden", golden)
    lab.main(custom_bump)

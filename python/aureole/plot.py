"""Plots of points by matplotlib, where it is installed.

>>> import matplotlib; matplotlib.use("agg")
>>> import aureole.plot
>>> axes = aureole.plot.points(aureole.points("spherical-fibonacci", 200, domain="sphere"))
"""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from matplotlib import pyplot
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from ._bridge import ArgumentError
from ._points import Domain, View


def points(
    points: ArrayLike, weights: Optional[ArrayLike] = None, *, domain: Optional[Domain] = None,
    axes: Optional[Axes] = None, **style: Any,
) -> Axes:  # fmt: skip
    """Draws points of the square, the disk, the hemisphere, the sphere or axes, and returns the axes.

    Directions are drawn by Lambert's azimuthal equal-area map about +z, so that evenness is seen as it is: the hemisphere
    is the disk of radius 1, the sphere that of radius sqrt 2 whose rim is -z. Colours show `weights` times their number.
    `domain` as for `aureole.measure`; `style` goes to matplotlib's scatter.
    """
    view = View(points, weights, domain)
    array, where = view.array, view.domain
    if where in ("rotations", "cube"):
        raise ArgumentError(f"points of the domain {where!r} have no plot in the plane")
    drawn = axes if axes is not None else pyplot.subplots()[1]
    style = {"s": min(20.0, 2000.0 / max(1, len(array))), "linewidths": 0, **style}
    if weights is not None:
        style.setdefault("c", np.asarray(weights) * len(array))
    if where in ("square", "disk"):
        plane, low, high = array, -1.0 if where == "disk" else 0.0, 1.0
    else:
        x, y, z = array.T
        scale = np.sqrt(1.0 / np.maximum(1.0 + z, 1e-300)) * (z > -1.0)
        plane = np.stack([x * scale, y * scale], axis=1)
        high = float(np.sqrt(2.0)) if where == "sphere" else 1.0
        low = -high
    marks = drawn.scatter(plane[:, 0], plane[:, 1], **style)
    if weights is not None:
        drawn.figure.colorbar(marks, ax=drawn, label="weight times number of points")
    if where != "square":
        drawn.add_patch(pyplot.Circle((0.0, 0.0), high, fill=False, linewidth=0.5))
    margin = 0.02 * (high - low)
    drawn.set(xlim=(low - margin, high + margin), ylim=(low - margin, high + margin), aspect="equal")
    return drawn

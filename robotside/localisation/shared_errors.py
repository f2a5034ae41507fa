"""What a sweep tells, and what it adds to what is known, where its errors are shared.

Most of a sweep's error is the map's: its cells are coarse, and each wall is drawn where its cells are. All surfaces that face the same way are
drawn alike, up to half a cell off: a hundred ends on them tell no better than that how far they are. And a robot that stands sees the same
error in every sweep, so the tenth one tells it nothing that the first did not. Along each direction in which prior and sweep can be told apart
the better of the two is kept, and only the part of the sweep that is new is added; a Kalman filter adds all of it each time, and ends
with a deviation of millimetres that is true of nothing.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

__all__ = ["SHARED_DISTANCE", "freshness", "fused", "pooled"]

SHARED_DISTANCE = 2.0
"""The errors of two sweeps so far apart [m] are alike to a third."""

SIDES = 8
"""Directions into which surfaces are sorted by which way they face."""

_NOTHING = 1e-9


def pooled(
    jacobian: NDArray[np.float64],
    off: NDArray[np.float64],
    weight: NDArray[np.float64],
    facing: NDArray[np.float64],
    spread: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Gradient and information of a misfit: points lie `off` their surfaces [m], each with a `weight` of its own [1/m2].

    All surfaces that face the same way are besides drawn off by one length, `spread` being its standard deviation [m]; `facing` is
    the direction of each point's surface [rad].
    """
    side = np.round(facing * (SIDES / math.tau)).astype(np.intp) % SIDES
    among = np.equal.outer(np.arange(SIDES), side).astype(np.float64)
    weighted = jacobian * weight[:, None]
    whole, total, misfit = among @ weighted, among @ weight, among @ (weight * off)
    shared = whole * (1.0 / (1.0 / spread**2 + total))[:, None]
    return weighted.T @ off - shared.T @ misfit, weighted.T @ jacobian - shared.T @ whole


def freshness(travelled: float) -> float:
    """Which part of a sweep is new that was taken `travelled` [m] after the last, 0 to 1.

    Of a row of measurements whose errors are alike by r from one to the next, each tells (1 - r) / (1 + r) of what one with an
    error of its own would.
    """
    alike = math.exp(-travelled / SHARED_DISTANCE)
    return (1.0 - alike) / (1.0 + alike)


def fused(
    covariance: NDArray[np.float64], information: NDArray[np.float64], fresh: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The covariance after a sweep of that `information`, and the matrix by which the Kalman filter's own step is to be multiplied.

    `covariance` is what was known before, `fresh` the part of the sweep that is new.
    """
    root = np.linalg.cholesky(covariance)
    gains, axes = np.linalg.eigh(root.T @ information @ root)
    gains = np.maximum(gains, _NOTHING)
    kept = np.maximum(1.0, gains) + fresh * np.minimum(1.0, gains)
    part = (kept - 1.0) / kept * (1.0 + gains) / gains
    basis = root @ axes
    inverse = axes.T @ np.linalg.inv(root)
    return np.asarray(basis / kept @ basis.T), np.asarray(basis * part @ inverse)

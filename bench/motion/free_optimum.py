# SPDX-License-Identifier: Apache-2.0
"""The shortest time of a path within velocities, accelerations and feeds, without a limit of jerk, by toppra (H. Pham, Q.-C. Pham, A new
approach to time-optimal path parameterization based on reachability analysis, IEEE T-RO 34, 2018). The path is made of the program by
path_from_program.py with corners as parabolas within the tolerance."""
import logging

import numpy as np
import toppra

import reference

logging.getLogger("toppra").setLevel(logging.ERROR)
STEP_S = 0.001  # between the nodes
COARSE_MM = 0.25


class OnGrid(toppra.interpolator.AbstractGeometricPath):
    """The curve at the nodes of a grid, as a function of its length; toppra asks for it nowhere else. Where two pieces meet in a node the values
    are those of the second one."""

    def __init__(self, grid):
        self.grid = grid
        self.values = [np.vstack([left, right[-1:]]) for left, right in zip(grid.left[:3], grid.right[:3])]

    def __call__(self, places, order=0):
        return self.values[order][np.searchsorted(self.grid.s, places)]

    @property
    def dof(self):
        return self.values[0].shape[1]

    @property
    def path_interval(self):
        return np.array([self.grid.s[0], self.grid.s[-1]])


class SpeedLimit(toppra.constraint.LinearConstraint):
    """Feeds and velocities of the axes as a bound of the squared speed."""

    def __init__(self, grid, limits):
        super().__init__()
        self.most = np.minimum(grid.speed_limit(limits), 1e8)
        self.dof = len(limits.velocity)

    def compute_constraint_params(self, _path, _places):
        return None, None, None, None, None, None, np.stack([np.zeros(len(self.most)), self.most], axis=1)


def squared_speed(grid, limits):
    both = np.stack([-limits.acceleration, limits.acceleration], axis=1)
    problem = toppra.algorithm.TOPPRA([SpeedLimit(grid, limits), toppra.constraint.JointAccelerationConstraint(both)], OnGrid(grid),
                                      gridpoints=grid.s, solver_wrapper="seidel")
    _, speed, _, _ = problem.compute_parameterization(0, 0, return_data=True)
    if speed is None or not np.all(np.isfinite(speed)):
        raise RuntimeError("toppra finds no way")
    return speed ** 2


def seconds(path, limits):
    """The time of the whole path in s, with its rests."""
    curves, limits = path.tables(), reference.limits_of(path, limits)
    edges = sorted({0, len(path.pieces)} | {k for k in path.stops if k < len(path.pieces)})
    total = sum(path.stops.values())
    for first, last in zip(edges[:-1], edges[1:]):
        length = curves.length[first:last]
        joints, whole = np.concatenate([[0], np.cumsum(length)]), length.sum()
        parts = np.maximum(3, np.ceil(length / COARSE_MM)).astype(int)
        near_rest = 0.5 ** np.arange(2, 16)
        start = np.concatenate([joints[k] + length[k] * np.arange(parts[k]) / parts[k] for k in range(len(length))] + [whole * near_rest, whole * (1 - near_rest)])
        grid = reference.Grid(curves, first, last, start)
        times = reference.time_without_jerk(grid, squared_speed(grid, limits))
        grid = reference.Grid(curves, first, last, np.concatenate([reference.even_in_time(grid.s, times, STEP_S), whole * near_rest, whole * (1 - near_rest)]))
        total += float(reference.time_without_jerk(grid, squared_speed(grid, limits)).sum())
    return total

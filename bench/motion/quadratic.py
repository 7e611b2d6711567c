# SPDX-License-Identifier: Apache-2.0
"""Sparse quadratic programs."""
import clarabel
import numpy as np
from scipy import sparse


def solve_program(p, q, rows, upper, equal):
    """The x with the least x'Px/2 + q'x for which rows x <= upper; in the first `equal` rows it is = instead of <=."""
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_iter = 200
    settings.tol_infeas_abs = settings.tol_infeas_rel = 1e-13  # the solver must not report that there is no solution: to stand still is always one
    count = rows.shape[0]
    cones = [clarabel.ZeroConeT(equal)] if equal else []
    solver = clarabel.DefaultSolver(sparse.csc_matrix(p), q, sparse.csc_matrix(rows), upper, cones + [clarabel.NonnegativeConeT(count - equal)],
                                    settings)
    answer = solver.solve()
    if str(answer.status) not in ("Solved", "AlmostSolved", "InsufficientProgress"):
        raise RuntimeError(f"the solver gave up: {answer.status}")
    return np.array(answer.x)

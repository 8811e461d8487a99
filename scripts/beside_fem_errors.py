"""Errors of both programs at the same places, by the same measure."""

import numpy as np


def relative(found, exact):
    """(‖found − exact‖/‖exact‖, the largest difference over the largest exact value) over all places."""
    axes = tuple(range(1, np.ndim(exact)))
    difference, size = (np.sqrt((part**2).sum(axis=axes)) for part in (found - exact, exact))
    return float(np.linalg.norm(difference) / np.linalg.norm(size)), float(difference.max() / size.max())


def errors_of(case, x, u, raw, recovered):
    """x: the places; u (n, dim); raw, recovered: σ (n, 3, 3), that of the functions' gradient and that of the recovery."""
    exact_u, exact_stress = case.u(x), case.stress(x)
    errors = {"u_l2": relative(u, exact_u)[0]}
    errors["raw_l2"], errors["raw_max"] = relative(raw, exact_stress)
    errors["recovered_l2"], errors["recovered_max"] = relative(recovered, exact_stress)
    return errors

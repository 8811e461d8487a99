"""Von Mises' law in plane strain, elastic and perfectly plastic: the return of a trial stress to the yield surface.

    √J₂ ≤ c,   s = s_trial · min(1, c/√J₂(s_trial)),   J₂ = ½ s : s = xx² + yy² + xx yy + xy²   with zz = −(xx + yy)

[Simo and Hughes 1998, box 3.1, without hardening.] The changes of volume are elastic, and in plane flow c is the strength in
shear, as of Tresca's law. Deviators are (xx, yy, xy). The formulas are for numbers, for NumPy's arrays and for UFL's forms.
"""

import numpy as np


def deviator(xx, yy, xy):
    """Of a strain whose zz is 0."""
    mean = (xx + yy) / 3
    return xx - mean, yy - mean, xy


def contracted(s, e):
    """s : e of two deviators."""
    return s[0] * e[0] + s[1] * e[1] + (s[0] + s[1]) * (e[0] + e[1]) + 2 * s[2] * e[2]


def share_kept(xx, yy, xy, c, root=np.sqrt, larger=np.maximum):
    """min(1, c/√J₂), by which the return multiplies a trial stress; root and larger: those of the arguments' kind."""
    J2 = contracted((xx, yy, xy), (xx, yy, xy)) / 2
    return c / root(larger(J2, c**2))

"""How a quantity grows with the size of a problem."""

import numpy as np


def exponent(sizes, values):
    """Exponent p of `values = c sizes^p`, fitted to the logarithms; None for a single size."""
    if len(sizes) < 2:
        return None
    return float(np.polyfit(np.log(sizes), np.log(values), 1)[0])

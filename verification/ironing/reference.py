"""A die that is pressed into an elastic slab and dragged along it at a constant depth: what must hold whatever the forces are.

Without friction nothing dissipates, and after each cell of the slab everything is as before. So the work of the drag over whole cells is
zero, and with it the mean force along the way. With friction all of the sole slides under pressures p on a surface that is inclined by
the angle a: the force along is the sum of p (mu cos a + sin a), the one across that of p (cos a - mu sin a). If the pressures lie evenly
about the lowest line, the sines add up to nothing, and the ratio of the two is mu.
"""


def window(start, cell, cells):
    """Ways of whole cells [m]: where a mean over what repeats from cell to cell starts and ends.

    >>> window(1, 2, 3)
    (1, 7)
    """
    return start, start + cell * cells

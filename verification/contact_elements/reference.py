"""What the gradient B of the height of a contact element must be.

The height h of an apex over a facet, an edge or a vertex is a length. Moved or turned as a whole the element keeps it, so for every
displacement u and every turn w

    sum of B_I . u = 0        sum of B_I . (w x x_I) = w . (sum of x_I x B_I) = 0 :

no net force, no net moment. B turns with the element, and belongs to nodes and not to their order. All errors are zero, held against
round-off: with the sharpness s, the longest edge over the smallest length the height divides by, about s times 1e-16 for a sum. Central
differences of the fourth order at a step of 3e-4 of that length have a round-off of some 1e-12 of their own; theirs is the largest where
an apex stands far out almost on the line of a short edge.

The unit tetrahedron below has h = 1 and, with its apex over the centroid, B = -n/3 at each base node. Eq. 8a of Kulak & Fiala as
printed has another: a wrong sign of its middle term, and 1.5 V/A for 1.5 V/A^3.
"""


def difference(f, x, step):
    """Slope of a function by central differences of the fourth order.

    >>> abs(difference(lambda x: x**5, 1.0, 1e-3) - 5) < 1e-10
    True
    """
    return (8 * (f(x + step) - f(x - step)) - (f(x + 2 * step) - f(x - 2 * step))) / (12 * step)


def height(base, apex):
    """Three volumes over the area of the facet.

    >>> unit = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
    >>> height(unit, (1 / 3, 1 / 3, 1.0))
    1.0
    >>> def moved(I, i, by):
    ...     base = [list(x) for x in unit]
    ...     base[I][i] += by
    ...     return height(base, (1 / 3, 1 / 3, 1.0))
    >>> third = [0.0, 0.0, round(-1 / 3, 9)]
    >>> [[round(difference(lambda by: moved(I, i, by), 0.0, 1e-3), 9) + 0.0 for i in range(3)] for I in range(3)] == 3 * [third]
    True
    """
    a, b, p = ([x - y for x, y in zip(point, base[0])] for point in (base[1], base[2], apex))
    n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return sum(x * y for x, y in zip(n, p)) / sum(x * x for x in n)**0.5

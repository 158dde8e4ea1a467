"""Numberings of the scenes of this folder: permutations from a generator of random numbers that is the same everywhere."""


def permutation(count, seed):
    """The numbers 0 to count - 1 in another order (Fisher and Yates, with Park and Miller's generator of 1988).

    >>> permutation(8, 1)
    [1, 6, 4, 2, 3, 5, 0, 7]
    >>> sorted(permutation(1000, 7)) == list(range(1000))
    True
    """
    state, order = seed, list(range(count))
    for last in range(count - 1, 0, -1):
        state = 16807 * state % 2147483647
        other = state % (last + 1)
        order[last], order[other] = order[other], order[last]
    return order


def inverse(order):
    """Where each number has gone.

    >>> inverse([2, 0, 1])
    [1, 2, 0]
    """
    places = [0] * len(order)
    for place, one in enumerate(order):
        places[one] = place
    return places

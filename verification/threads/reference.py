"""Why threads may not change a bit, though sums of floating numbers depend on their order.

    >>> (0.1 + 0.2) + 0.3 == 0.1 + (0.2 + 0.3)
    False

Sums that are cut into parts of a fixed size, each summed by whoever comes first and added up in the order of the parts, are
the same whoever sums which part.
"""


def sum_in_parts(numbers, size, order):
    """The sum, its parts of `size` numbers summed in any order.

    >>> numbers = [1 / n for n in range(1, 1000)]
    >>> parts = range(-(-len(numbers) // 64))
    >>> sum_in_parts(numbers, 64, parts) == sum_in_parts(numbers, 64, reversed(parts))
    True
    >>> sum_in_parts(numbers, 64, parts) == sum_in_parts(numbers, 512, range(2))
    False
    """
    found = {}
    for part in order:
        found[part] = sum(numbers[part * size:(part + 1) * size])
    return sum(found[part] for part in sorted(found))

"""What a displacement may do: two scenes that are the same but for round-off have the same velocities but for round-off.

Positions that differ by d at the start differ by some d while bodies are in contact: a gap that is larger by d is closed in one step of
the length dt, by a velocity that is larger by d/dt. Here d is 1e-12 m and dt some 1e-5 s, so that is 1e-7 m/s.
"""

NUDGE = 1e-12   # [m]
LIMIT = 1e-6    # [m/s]


class Chance:
    """Random numbers that are the same everywhere (Park and Miller's generator of 1988).

    >>> Chance(1).state_after(10000)
    1043618065
    """

    def __init__(self, seed):
        self.state = 1 + seed * 7919 % 2147483646
        for _ in range(8):
            self.unit()

    def state_after(self, count):
        """The state that the generator has after 1 and so many numbers; 1043618065 after 10000 (the authors' own check)."""
        state = 1
        for _ in range(count):
            state = 16807 * state % 2147483647
        return state

    def unit(self):
        self.state = 16807 * self.state % 2147483647
        return self.state / 2147483647

    def between(self, low, high):
        return low + (high - low) * self.unit()

    def one_of(self, some):
        return some[int(self.unit() * len(some))]

    def direction(self):
        """A vector of the length 1."""
        while True:
            v = [self.between(-1, 1) for _ in range(3)]
            size = sum(x * x for x in v) ** 0.5
            if 0.1 < size < 1:
                return [x / size for x in v]

    def shuffled(self, count):
        order = list(range(count))
        for last in range(count - 1, 0, -1):
            other = int(self.unit() * (last + 1))
            order[last], order[other] = order[other], order[last]
        return order

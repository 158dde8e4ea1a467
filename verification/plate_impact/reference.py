"""Impact of two plates of one elastic-plastic metal in uniaxial strain: all waves, by tracking of fronts.

Sides are held. With the stretch l = dx/dX, bulk modulus K and shear modulus G, the stress s along the axis and the difference q of the
stresses along and across change with the logarithmic strain:

    elastic, |q| < Y:  ds = M d(ln l),   dq = 2 G d(ln l),                  M = K + 4 G/3
    in flow, |q| = Y:  ds = Mp d(ln l),  dq = 2 G H/(3 G + H) d(ln l),      Mp = K + (4/3) G H/(3 G + H)

Yielding begins at the Hugoniot elastic limit s = Y M/(2 G). With isotropic hardening Y becomes |q|, and reversed loading yields at -Y.
These are the rates of J2 plasticity in Cauchy stress, exact for finite strain: axes do not turn, and the section keeps its area, so that s
is the nominal stress as well.

Over a jump that moves at U through the material at rest, of density r, momentum and continuity give

    r U^2 = (s2 - s1)/(l2 - l1),   v2 - v1 = -(s2 - s1)/(r U),   U < 0 to the left

which is sqrt(M/r) or sqrt(Mp/r) for small strains. Loading steepens to shocks, for which the jump is exact. A release is a fan; one jump
replaces it here, or `parts` of them. It is 2 % of its time of travel wide, and its states are off by the third order of its strength.

Two states side by side send waves into both: an elastic one, and a plastic one beyond the elastic limit. Stress and velocity between them
are one. A free surface has no stress, and plates that would be pulled part. Where fronts meet, the same is asked again. So the solution
consists of constant states between straight fronts.

R. J. Clifton, Plastic waves: theory and experiment, Mechanics Today 1 (1974) 102. L. Davison, Fundamentals of Shock Wave Propagation in
Solids (Springer 2008), chapters 8 and 9.
"""
from collections import namedtuple
from math import exp, inf, sqrt

ALUMINIUM = {"density": 2703.0, "young": 69e9, "poisson": 0.33, "yield": 0.29e9, "tangent": 0.6e9}  # SI; near 6061-T6

State = namedtuple("State", "velocity stress stretch difference size")  # [m/s] [Pa] [-] [Pa] q [Pa] Y
Wave = namedtuple("Wave", "speed behind")                               # [m/s] in the reference, positive; State
Front = namedtuple("Front", "place velocity kind")                      # [m] [m/s] in the reference; WAVE, TRACE, TOUCH or FREE

WAVE, TRACE, TOUCH, FREE = "wave", "trace of a meeting", "touch", "free surface"
WEAK = 3e-3   # [-] waves below this share of the yield stress are left out
HERE = 1e-9   # [m] fronts that are as close meet, and plates touch


class Metal:
    """Moduli of a bilinear metal.

    >>> metal = Metal(**ALUMINIUM)
    >>> [round(x / 1e9, 3) for x in (metal.bulk, metal.shear, metal.elastic, metal.plastic, metal.limit())]
    [67.647, 25.94, 102.234, 67.914, 0.571]
    >>> perfect = Metal(**{**ALUMINIUM, "tangent": 0})
    >>> perfect.plastic == perfect.bulk
    True
    """

    def __init__(self, density, young, poisson, tangent, **more):
        self.density, self.size = density, more["yield"]
        self.bulk, self.shear = young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))
        hardening = young * tangent / (young - tangent)
        share = hardening / (3 * self.shear + hardening)
        self.elastic, self.plastic = self.bulk + 4 / 3 * self.shear, self.bulk + 4 / 3 * self.shear * share
        self.steep, self.flat = 2 * self.shear, 2 * self.shear * share  # dq over d(ln l)

    def at_rest(self, velocity=0.0):
        """Nothing has happened to it but that it moves at this velocity."""
        return State(velocity, 0.0, 1.0, 0.0, self.size)

    def limit(self):
        """Hugoniot elastic limit, positive. [Pa]"""
        return self.size * self.elastic / self.steep

    def waves(self, start, stress, way, parts=1):
        """The waves that bring a state to this stress, the first one first; way: 1 to the right, -1 to the left.

        >>> metal, speed = Metal(**ALUMINIUM), lambda modulus: sqrt(modulus / 2703)
        >>> first, second = metal.waves(metal.at_rest(), -1.5e9, 1)
        >>> round(first.behind.stress / metal.limit(), 12), round(first.speed / speed(metal.elastic), 4)   # sqrt(l) faster than sound
        (-1.0, 1.0014)
        >>> round(second.speed / speed(metal.plastic), 4), round(1 - second.behind.stretch, 4)
        (1.0062, 0.0191)
        >>> back, reverse = metal.waves(second.behind, 0.0, 1)   # twice the limit and more until it yields again
        >>> round((back.behind.stress + 1.5e9) / (second.behind.size * metal.elastic / metal.shear), 12)
        1.0
        """
        sign, found, now = 1 if stress > start.stress else -1, [], start
        room = max(0.0, now.size - sign * now.difference) * self.elastic / self.steep
        first = now.stress + sign * min(room, abs(stress - now.stress))
        for goal, modulus, of_difference in ((first, self.elastic, self.steep), (stress, self.plastic, self.flat)):
            begin = now.stress
            for part in range((parts if sign > 0 else 1) if abs(goal - begin) > 1e-9 * self.size else 0):
                aim = begin + (part + 1) / (parts if sign > 0 else 1) * (goal - begin)
                strain = (aim - now.stress) / modulus
                stretch, difference = now.stretch * exp(strain), now.difference + of_difference * strain
                speed = sqrt((aim - now.stress) / (stretch - now.stretch) / self.density)
                velocity = now.velocity - way * (aim - now.stress) / (self.density * speed)
                now = State(velocity, aim, stretch, difference, max(now.size, abs(difference)))
                found.append(Wave(speed, now))
        return found

    def reach(self, start, stress, way):
        """The state behind those waves."""
        found = self.waves(start, stress, way)
        return found[-1].behind if found else start


class Plates:
    """A flyer that hits a target at the place 0 and the time 0. Lengths, times and velocities in SI units.

    >>> metal = Metal(**ALUMINIUM)
    >>> plates = Plates(metal, 0.002, 0.005, 200.0)
    >>> plates.advance(0.3e-6)
    >>> [round(state.velocity, 2) for state in plates.states[1:-1]]   # flyer, hit, plastic, hit, target
    [200.0, 165.67, 100.0, 100.0, 34.33, 0.0]
    >>> soft = Plates(Metal(**{**ALUMINIUM, "yield": 10e9}), 0.002, 0.005, 200.0)   # elastic: the surface takes the flyer's velocity
    >>> soft.advance(1e-6)
    >>> round(soft.states[-2].velocity, 4)
    200.0
    """

    def __init__(self, metal, flyer, target, speed, parts=1):
        self.metal, self.parts, self.time, self.gap = metal, parts, 0.0, 0.0
        self.fronts = [Front(-flyer, 0.0, FREE), Front(0.0, 0.0, TOUCH), Front(target, 0.0, FREE)]
        self.states = [None, metal.at_rest(speed), metal.at_rest(), None]  # between the fronts, and outside
        self.surface = [(0.0, 0.0)]                                       # [(since when, velocity of the free surface)]
        self.meet(1, 1)

    def advance(self, end):
        """Goes on until this time."""
        while True:
            ways = [(b.place - a.place) / (a.velocity - b.velocity) if a.velocity > b.velocity else inf
                    for a, b in zip(self.fronts, self.fronts[1:])]
            touch = next(i for i, one in enumerate(self.fronts) if one.kind == TOUCH)
            parting = self.states[touch + 1].velocity - self.states[touch].velocity
            closing = self.gap / -parting if self.gap > HERE and parting < 0 else inf
            step = min(*ways, closing, end - self.time)
            self.time += step
            self.gap = max(0.0, self.gap + step * parting)
            self.fronts = [one._replace(place=one.place + step * one.velocity) for one in self.fronts]
            if self.time >= end - 1e-15:
                return
            if closing == step:
                self.gap = 0.0
                self.meet(touch, touch)
            else:
                first = last = ways.index(step)
                while last + 1 < len(self.fronts) and self.fronts[last + 1].place - self.fronts[first].place < HERE:
                    last += 1
                self.meet(first, last)

    def meet(self, first, last):
        """Puts what leaves a place in the place of the fronts that meet there."""
        left, right, here = self.states[first], self.states[last + 1], self.fronts[first:last + 1]
        place = next((one.place for one in here if one.kind != WAVE), here[0].place)
        kind = next((one.kind for one in here if one.kind in (FREE, TOUCH)), TRACE)
        opened = kind == FREE or (kind == TOUCH and self.gap > HERE)
        stress = 0.0 if opened else self.common(left, right)
        if kind == TOUCH and stress > 0:
            stress = 0.0
        left_fronts, left_states = self.leaving(left, place, stress, -1)
        right_fronts, right_states = self.leaving(right, place, stress, 1)
        middle = [Front(place, 0.0, kind)]
        if kind == TRACE and alike(left_states[-1], right_states[-1], self.metal.size):
            middle, right_states = [], right_states[:-1]
        self.fronts[first:last + 1] = left_fronts + middle + right_fronts[::-1]
        self.states[first:last + 2] = left_states + right_states[::-1]
        if kind == FREE and right is None:
            self.surface.append((self.time, self.states[-2].velocity))

    def common(self, left, right):
        """The stress that both take."""
        low, high = -1e3 * self.metal.size, 1e3 * self.metal.size
        while high - low > 1e-9 * self.metal.size:
            stress = 0.5 * (low + high)
            faster = self.metal.reach(left, stress, -1).velocity > self.metal.reach(right, stress, 1).velocity
            low, high = (low, stress) if faster else (stress, high)
        return 0.5 * (low + high)

    def leaving(self, state, place, stress, way):
        """(fronts, states) on one side, from the outside to the place itself."""
        if state is None:
            return [], [None]
        strong, before = [], state
        for one in self.metal.waves(state, stress, way, self.parts):
            if abs(one.behind.stress - before.stress) > WEAK * self.metal.size:
                strong.append(one)
            before = one.behind
        return [Front(place, way * one.speed, WAVE) for one in strong], [state, *(one.behind for one in strong)]

    def profile(self):
        """[(place in the reference, state)] at this time, both ends of each constant part. [m]"""
        places = [one.place for one in self.fronts]
        return [(place, state) for a, b, state in zip(places, places[1:], self.states[1:-1]) for place in (a, b)]


def alike(one, other, size):
    return max(abs(one.difference - other.difference), abs(one.size - other.size)) < WEAK * size


def surface_velocity(metal, flyer, target, speed, end, parts=1):
    """[(since when, velocity)] of the free surface of the target. [s] [m/s]"""
    plates = Plates(metal, flyer, target, speed, parts)
    plates.advance(end)
    return plates.surface


def value_at(steps, t):
    """Of a curve of steps.

    >>> value_at([(0.0, 1.0), (2.0, 5.0)], 1.9), value_at([(0.0, 1.0), (2.0, 5.0)], 2.0)
    (1.0, 5.0)
    """
    return max((one for one in steps if one[0] <= t), key=lambda one: one[0])[1]


def mean_of_steps(steps, begin, end):
    """The mean of a curve of steps between two times.

    >>> mean_of_steps([(0.0, 1.0), (2.0, 5.0)], 1.0, 3.0)
    3.0
    """
    ends = [begin, *(t for t, _ in steps if begin < t < end), end]
    return sum(value_at(steps, a) * (b - a) for a, b in zip(ends, ends[1:])) / (end - begin)


def mean_stress(profile, low, high):
    """The mean stress between two places. [Pa]

    >>> part = State(0.0, -4.0, 1.0, 0.0, 1.0)
    >>> mean_stress([(0.0, part), (1.0, part), (1.0, part._replace(stress=0.0)), (2.0, part._replace(stress=0.0))], 0.5, 1.5)
    -2.0
    """
    pieces = zip(profile[::2], profile[1::2])
    return sum(state.stress * max(0.0, min(high, end) - max(low, begin)) for (begin, state), (end, _) in pieces) / (high - low)

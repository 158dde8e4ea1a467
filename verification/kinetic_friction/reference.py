"""A rigid block under Coulomb's friction whose coefficient falls with the speed, mu(v) = kinetic + (static - kinetic) exp(-decay v).

Sliding to rest:  dv/dt = -g mu(v)  has a closed time,  ln((kinetic exp(decay v0) + static - kinetic) / static) / (g kinetic decay),
and the way is the integral of v dv / (g mu). Pulled by a growing force: it holds until the force is static times the weight, then
dv/dt = force / mass - g mu(v), by Runge and Kutta's fourth order.
"""
from math import exp, log


def coefficient(speed, static, kinetic, decay):
    """
    >>> coefficient(0, 0.4, 0.2, 1), round(coefficient(1, 0.4, 0.2, 1), 6)
    (0.4, 0.273576)
    """
    return kinetic + (static - kinetic) * exp(-decay * speed)


def stop(speed, static, kinetic, decay, gravity, parts=2000):
    """(time, way) of a block that slides to rest, the way by Simpson's rule over the speed.

    >>> time, way = stop(5, 0.3, 0.3 - 1e-12, 1, 9.81)
    >>> round(time, 5), round(way, 5)
    (1.69895, 4.24737)
    """
    time = log((kinetic * exp(decay * speed) + static - kinetic) / static) / (gravity * kinetic * decay)
    h = speed / parts
    values = [v / (gravity * coefficient(v, static, kinetic, decay)) for v in (h * i for i in range(parts + 1))]
    way = h / 3 * (values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2]))
    return time, way


def pulled(rate, end, static, kinetic, decay, gravity, parts=4000):
    """(time at which it slips, speed at the end, heat per mass) of a block at rest that is pulled by rate * t per mass. [m/s3]

    >>> slip, speed, heat = pulled(5, 1.2, 0.4, 0.4, 1, 9.81)   # constant friction: speed = (rate/2)(end - slip)^2
    >>> round(slip, 5), round(speed - 2.5 * (1.2 - slip)**2, 9)
    (0.7848, 0.0)
    """
    slip = static * gravity / rate
    h, v, heat = (end - slip) / parts, 0.0, 0.0

    def slope(t, v):
        return rate * t - gravity * coefficient(v, static, kinetic, decay)

    for i in range(parts):
        t = slip + i * h
        a = slope(t, v)
        b = slope(t + h / 2, v + h / 2 * a)
        c = slope(t + h / 2, v + h / 2 * b)
        d = slope(t + h, v + h * c)
        later = v + h / 6 * (a + 2 * b + 2 * c + d)
        middle = v + h / 8 * (a + b + b + c)
        heat += h / 6 * gravity * sum(w * coefficient(s, static, kinetic, decay) * s for w, s in ((1, v), (4, middle), (1, later)))
        v = later
    return slip, v, heat

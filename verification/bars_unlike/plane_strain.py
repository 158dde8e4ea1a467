"""Makes the table FORCE of reference.py: an elastic bar of finite width in plane strain hits a smooth rigid wall. Needs numpy; 2 minutes.

Two equal bars that meet face to face are, by symmetry, one bar on a wall. Small strains, finite differences of second order in space and
time on a staggered grid of velocities and stresses (Virieux, Geophysics 51 (1986) 889): normal stresses in the middle of a cell, velocities
on its sides, shear stresses at its corners. Corners on any border have no shear stress: it is free, smooth or a plane of symmetry. A
velocity on a free side has half a cell's mass and normal stress on one side only, so momentum balances exactly. The wall stops the sides
that would pass it and lets go those that tend to leave.

Without damping all is of second order until the release, and there single cells leave and return. A linear viscosity that falls with the
cell makes the release smooth and all of first order, so the table is extrapolated from cells of 1/8 and 1/16 mm.
"""
from math import sqrt

import numpy as np

LENGTH, HALF_WIDTH, DENSITY, YOUNG, POISSON, SPEED = 0.1, 0.005, 7850.0, 210e9, 0.3, 2.5  # SI
BIN, BINS = 0.5e-6, 80  # [s] the table has the mean force in each bin
COURANT = 0.6


def forces(cells, viscosity=0.1, poisson=POISSON):
    """(mean force in each bin over rho c_p V A, when the wall pushed last [s]) with this many cells in a millimetre."""
    nx, ny = round(1000 * LENGTH * cells), round(1000 * HALF_WIDTH * cells)
    h = LENGTH / nx
    shear, lame = YOUNG / 2 / (1 + poisson), YOUNG * poisson / (1 + poisson) / (1 - 2 * poisson)
    stiff = lame + 2 * shear
    impedance = sqrt(stiff * DENSITY)
    dt = COURANT * h * DENSITY / impedance
    k = dt / (DENSITY * h)
    vx, vy, gap = np.full((nx + 1, ny), -SPEED), np.zeros((nx, ny + 1)), np.zeros(ny)
    sx, sy, sxy, q = np.zeros((nx, ny)), np.zeros((nx, ny)), np.zeros((nx + 1, ny + 1)), np.zeros((nx, ny))
    times, impulse, last = [-dt / 2], [0.0], 0.0  # velocities are those of half steps
    while times[-1] < BIN * BINS + dt:
        tx, ty = sx + q, sy + q
        vx[1:-1] += k * (tx[1:] - tx[:-1] + sxy[1:-1, 1:] - sxy[1:-1, :-1])
        vx[-1] -= 2 * k * tx[-1]
        free = vx[0] + 2 * k * tx[0]
        vx[0] = np.maximum(free, -gap / dt)  # at the wall
        gap += dt * vx[0]
        push = DENSITY * h / 2 * np.mean(vx[0] - free) / (impedance * SPEED)
        vy[:, 1:-1] += k * (ty[:, 1:] - ty[:, :-1] + sxy[1:, 1:-1] - sxy[:-1, 1:-1])
        vy[:, -1] -= 2 * k * ty[:, -1]       # vy[:, 0] stays zero: the plane of symmetry
        ex, ey = dt / h * (vx[1:] - vx[:-1]), dt / h * (vy[:, 1:] - vy[:, :-1])
        sx += stiff * ex + lame * ey
        sy += stiff * ey + lame * ex
        q = viscosity * impedance * h / dt * (ex + ey)
        sxy[1:-1, 1:-1] += shear * dt / h * (vx[1:-1, 1:] - vx[1:-1, :-1] + vy[1:, 1:-1] - vy[:-1, 1:-1])
        times.append(times[-1] + dt)
        impulse.append(impulse[-1] + push)
        last = times[-1] if push > 0 else last
    at = np.interp(np.arange(BINS + 1) * BIN, times, impulse)
    at[0] = 0.0  # the half cells that stop at once belong to the first bin
    return np.diff(at) / BIN, last


def extrapolated(coarse, fine):
    """To cells of no size by the first order, from cells and from half their size."""
    return 2 * fine - coarse


def rms(difference):
    return sqrt(np.mean(difference**2))


def main():
    found = {cells: forces(cells) for cells in (4, 8, 16)}
    table = extrapolated(found[8][0], found[16][0])
    for start in range(0, BINS, 10):
        print("   ", " ".join(f"{force:.4f}," for force in table[start:start + 10]))
    pressed = slice(0, 76)
    print("last push [us]", *(f"{1e6 * last:.2f}" for _, last in found.values()))
    print("impulse over bin", *(f"{sum(force):.4f}" for force, _ in found.values()), f"{sum(table):.4f}")
    print("root mean squares: extrapolated from cells twice as large", rms((table - extrapolated(found[4][0], found[8][0]))[pressed]))
    print("without viscosity, until 33 us", rms((table - forces(8, 0.0)[0])[:66]), "all", rms((table - forces(8, 0.0)[0])[pressed]))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""The force on a rigid wedge that enters incompressible water at constant speed, from the similarity solution
(Dobrovol'skaya 1969, J. Fluid Mech. 36, 805). Prints f of F = f ρ V³ t per metre, twice, and the largest pressure
coefficient, for the deadrise angles given on the command line.

    python3 similarity.py 10 20 30

In coordinates z = (x + i y)/(V t) half of the flow is the image of the lower half plane of ζ: the line of symmetry
ζ < 0, the wedge 0 < ζ < 1, the free surface ζ > 1. With the complex velocity w (over V), on a free surface dw dz is
imaginary (Bernoulli), on straight walls real, so that with the corners at the keel, at the tip of the jet and at infinity

    dw/dζ dz/dζ = C ζ⁻¹ (ζ - 1)^(-3/2).

dz/dζ has the argument β on the wedge, π/2 on the line of symmetry and θ(ζ) on the free surface, which gives its modulus

    ln |dz/dζ| = ln K - ½ ln|ζ| - β/π ln|(ζ-1)/ζ| + θ(1)/π ln|ζ-1| + 1/π ∫ θ'(t) ln|t-ζ| dt.

On the free surface conj(w) - z is along it and, since particles keep their distance along it, the length s from the tip:

    θ'(ζ) = |dw/dζ| / s(ζ),    θ(1) = β - π + δ,    θ(∞) = 0,

δ being the angle of the tip. C/K² follows from the velocity at the keel being that of the wedge. The unknowns are θ' in
cells of ln(ζ - 1), C/K² and δ; Newton's method. The second value of f comes from F V = dE/dt with the energy of the
flow; both are extrapolated from two numbers of cells.
"""
import sys

import numpy as np


def dilogarithm(x):
    """Li2 on [0, 1]."""
    small, near_one = np.minimum(x, 0.5), np.clip(1 - x, 0, 0.5)
    series = lambda y: sum(y**k / k**2 for k in range(1, 60))
    with np.errstate(divide="ignore", invalid="ignore"):
        mixed = np.nan_to_num(np.log(x) * np.log(1 - x))
    return np.where(x <= 0.5, series(small), np.pi**2 / 6 - mixed - series(near_one))


def solve(beta, cells, low=-60.0, high=40.0):
    h = (high - low) / cells
    u = low + h * (np.arange(cells) + 0.5)  # ln(ζ - 1) on the free surface
    ln_zeta = np.log1p(np.exp(u))
    # ∫ over a cell of ln|e^u' - e^u| = max(u, u') + ln(1 - e^-|u-u'|), exactly.
    distance = h * np.arange(cells)
    part = lambda d: np.sign(d) * (dilogarithm(np.exp(-abs(d))) - dilogarithm(np.float64(1)))
    near = part(distance + h / 2) - part(distance - h / 2)
    larger = np.maximum.outer(u, u) + np.diag(np.full(cells, h / 8))
    index = np.arange(cells)
    to_surface = (larger * h + near[abs(index[:, None] - index[None, :])]) / np.pi
    # On the wedge ζ = 1/(1 + e^v).
    edges = np.linspace(-60, 60, cells + 1)
    v, k = 0.5 * (edges[1:] + edges[:-1]), edges[1] - edges[0]
    ln_1_minus, ln_z = -np.logaddexp(0, -v), -np.logaddexp(0, v)
    to_wedge = np.logaddexp(u[None, :], ln_1_minus[:, None]) * h / np.pi

    def flow(unknowns):
        turn, ratio, delta = np.exp(unknowns[:cells]), np.exp(unknowns[cells]), np.exp(unknowns[cells + 1])
        theta, exponent = delta - np.pi + beta, delta / np.pi
        g = -beta / np.pi * (u - ln_zeta) - 0.5 * ln_zeta + theta / np.pi * u + to_surface @ turn
        ds = np.exp(g + u)
        before = ds[0] * np.exp(-exponent * h / 2) / exponent  # of the tip, below the first cell
        s = before + np.cumsum(ds * h) - ds * h / 2
        a = -beta / np.pi * (ln_1_minus - ln_z) - 0.5 * ln_z + theta / np.pi * ln_1_minus + to_wedge @ turn
        dz = np.exp(a + ln_1_minus + ln_z)
        dw = ratio * np.exp(-ln_z - 1.5 * ln_1_minus - a + ln_1_minus + ln_z)
        length = np.sum(dz) * k + dz[0] * np.exp(-exponent * k / 2) / exponent
        residual = np.concatenate([
            np.log(ratio) - ln_zeta - 0.5 * u - g - np.log(s) - unknowns[:cells],
            [np.log(np.sum(dw) * k / length), np.log(np.sum(turn) * h / (np.pi - beta - delta))]])
        return residual, dict(turn=turn, ratio=ratio, delta=delta, ds=ds, before=before, s=s, dz=dz, dw=dw, length=length)

    # What turns the surface is found about ln(ζ - 1) = centre; not every guess leads there.
    for centre in (0, -1, 1, -2, 2, -3):
        start, tip = -np.logaddexp(-0.5 * (u - centre), 1.5 * (u - centre)), beta / 6
        start += np.log((np.pi - beta - tip) / np.sum(np.exp(start) * h))
        x = np.concatenate([start, [0.0, np.log(tip)]])
        x[cells] = -flow(x)[0][cells]
        if newton(lambda x: flow(x)[0], x):
            return force(beta, h, k, **flow(x)[1])
    raise RuntimeError("Newton's method does not converge")


def newton(function, x):
    """Changes x until function(x) = 0; False where it gets stuck."""
    residual = function(x)
    for _ in range(80):
        if np.linalg.norm(residual) < 1e-8:
            return True
        jacobian = np.empty((len(x), len(x)))
        for j in range(len(x)):
            moved = x.copy()
            moved[j] += 1e-6
            jacobian[:, j] = (function(moved) - residual) / 1e-6
        step = np.linalg.solve(jacobian, -residual)
        share = min(1.0, 2 / np.max(abs(step)))
        while np.linalg.norm(function(x + share * step)) >= np.linalg.norm(residual):
            share /= 2
            if share < 1e-4:
                return False
        x += share * step
        residual = function(x)
    return False


def force(beta, h, k, turn, ratio, delta, ds, before, s, dz, dw, length):
    """f from the pressure, f from the energy, largest pressure coefficient. Lengths and velocities are those of K = 1."""
    along = np.exp(1j * beta)
    theta = beta - np.pi + delta + np.cumsum(turn) * h - turn * h / 2
    tangent = np.exp(1j * theta)
    change = 1j * s * tangent * turn * h
    velocity = np.cumsum(change[::-1])[::-1] - change / 2  # conj(w) on the free surface: none at infinity
    tip_velocity = np.sum(change)  # and place of the tip
    keel = tip_velocity - length * along
    speed = abs(keel)
    if abs(keel / speed + 1j) > 0.01:
        raise RuntimeError("the keel is not where the wedge has brought it")
    # From the keel outwards: place and tangential velocity along the wedge, their difference, pressure.
    dz, dw = dz[::-1], dw[::-1]
    place, slip = np.cumsum(dz * k) - dz * k / 2, np.cumsum(dw * k) - dw * k / 2
    relative = slip - place
    pressure = np.sum(relative * dw) * k - np.cumsum(relative * dw) * k + 0.5 * relative * dw * k
    from_pressure = 2 * np.cos(beta) * np.sum(place * relative * dw) * k / speed**3
    # E = ½ ∮ φ ∂φ/∂n ds, the jet's tip by the values at its ends.
    tip_potential = 0.5 * abs(tip_velocity) ** 2
    dx = ds * h * tangent
    x = tip_velocity + before * np.exp(1j * (beta - np.pi + delta)) + np.cumsum(dx) - dx / 2
    potential = (x * np.conj(velocity)).real - 0.5 * abs(velocity) ** 2
    normal = (velocity * np.conj(1j * tangent)).real
    near = s < 1e6 * length  # beyond, x and velocity are known as differences of large numbers only
    energy = np.sum((potential * normal * ds * h)[near]) + 0.5 * (potential[0] + tip_potential) * normal[0] * before
    x, velocity = -1j * speed + place * along, -1j * speed + slip * along
    potential = -pressure + (x * np.conj(velocity)).real - 0.5 * abs(velocity) ** 2
    rest = length - place[-1] - 0.5 * dz[-1] * k
    energy -= speed * np.cos(beta) * (np.sum(potential * dz * k) + 0.5 * (potential[-1] + tip_potential) * rest)
    return np.array([from_pressure, 2 * energy / speed**4, 2 * np.max(pressure) / speed**2])


def main():
    for angle in sys.argv[1:]:
        coarse, fine = (solve(np.radians(float(angle)), cells) for cells in (300, 600))
        print("{}°: f = {:.2f}, by the energy {:.2f}; largest pressure {:.2f} ½ ρ V²".format(
            angle, *(fine + (fine - coarse) / 3)))


main()

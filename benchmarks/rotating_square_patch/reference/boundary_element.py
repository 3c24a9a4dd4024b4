#!/usr/bin/env python3
"""The rotating square patch of incompressible, inviscid water, by boundary elements. Writes boundary_element.csv.

The vorticity of a plane flow of such water stays what it is: 2ω everywhere. So the velocity is a rigid rotation and a
potential flow, u = ω ẑ×x + ∇φ, and Euler's equation becomes one for the potential,

    ∂φ/∂t = -p/ρ - |u|²/2 + ω²r² - 2ωψ,    ψ the stream function conjugate to φ, ∂ψ/∂s = ∂φ/∂n,

with p = 0 on the surface. Surface points move with u and carry φ (Dφ/Dt = ∂φ/∂t + u·∇φ); Laplace's equation inside gives
∂φ/∂n: straight panels of constant strength, collocated at their middles, potentials by Green's third identity. One side of
the square is computed; symmetry under quarter turns gives the rest. RK4 in time.

Columns: time [s], growth of the mean square radius [m²], largest radius [m], area / initial area and kinetic energy /
(ρ ω² (initial area)²), which should stay.
ω = 1 1/s, L = 1 m. Arguments: panels per side, time step [s], exponent of the rounded square.
"""
import sys
import numpy as np
from scipy.interpolate import CubicSpline

PER_SIDE = int(sys.argv[1]) if len(sys.argv) > 1 else 140
DT = float(sys.argv[2]) if len(sys.argv) > 2 else 0.0025
EXPONENT = float(sys.argv[3]) if len(sys.argv) > 3 else 50.0  # of the rounded square
CLUSTER = 0.7  # how much denser nodes are at the corners
SMOOTH = 4     # steps from one filtering to the next
END, OMEGA = 2.0, 1.0


def full(z):
    """All four sides from one (complex numbers)."""
    return np.concatenate([z * 1j**q for q in range(4)])


def panels(nodes):
    z = full(nodes)
    a, b = z, np.roll(z, -1)
    return a, b


def influence(a, b, x):
    """G and H of every panel a-b at every point x: ∫ ln r ds, ∫ ∂(ln r)/∂n ds (n out of the counter-clockwise body)."""
    length = np.abs(b - a)
    t = (b - a) / length
    w = (x[:, None] - a[None, :]) * np.conj(t)[None, :]  # along the panel and across, to the left
    s, d = w.real, w.imag
    s1, s2 = s, s - length[None, :]
    angle = np.arctan2(d * length[None, :], d * d + s1 * s2)
    r1, r2 = np.maximum(np.hypot(s1, d), 1e-300), np.maximum(np.hypot(s2, d), 1e-300)
    g = s1 * np.log(r1) - s2 * np.log(r2) - length[None, :] + d * angle
    return g, angle


def solve(nodes, phi):
    """∂φ/∂n on the panels of one side from φ at their nodes."""
    n = len(nodes)
    a, b = panels(nodes)
    middle = 0.5 * (a + b)
    g, angle = influence(a, b, middle[:n])
    np.fill_diagonal(angle[:, :n], 0.0)
    # Outward normal is to the right of the direction of travel: ∂ ln r/∂n integrates to minus the angle seen.
    phi_middle = 0.5 * (phi + np.roll(phi, -1))
    fold = lambda matrix: matrix.reshape(n, 4, n).sum(axis=1)
    h = fold(angle)
    # π φ = ∫ (φ ∂ln r/∂n - ∂φ/∂n ln r) ds; ∂ln r/∂n (source point varies) of a panel = angle.
    rhs = h @ phi_middle - np.pi * phi_middle
    matrix = fold(g)
    return np.linalg.solve(matrix, rhs), middle[:n], np.abs(b - a)[:n], ((b - a) / np.abs(b - a))[:n]


def rates(nodes, phi):
    q, middle, length, t = solve(nodes, phi)
    phi_next = np.roll(phi, -1)
    tangential = (phi_next - phi) / length
    gradient = tangential * t + q * (-1j * t)  # per panel
    # At a node: of the panels on both sides, each weighted with the other's length.
    before = np.roll(gradient, 1)
    before[0] = gradient[-1] * (-1j)  # the panel before the first node lies on the side before
    l_before = np.roll(length, 1)
    at_node = (before * length + gradient * l_before) / (length + l_before)
    # Stream function at nodes: ψ(s) = ∫ ∂φ/∂n ds; its constant only shifts φ by a function of time.
    psi = np.concatenate([[0.0], np.cumsum(q * length)[:-1]])
    u = OMEGA * 1j * nodes + at_node
    r2 = np.abs(nodes) ** 2
    dphi = -0.5 * np.abs(u) ** 2 + OMEGA**2 * r2 - 2 * OMEGA * psi + (u * np.conj(at_node)).real
    return u, dphi


def moments(nodes):
    z = full(nodes)
    x0, y0 = z.real, z.imag
    x1, y1 = np.roll(x0, -1), np.roll(y0, -1)
    cross = x0 * y1 - x1 * y0
    area = cross.sum() / 2
    polar = (cross * (x0**2 + x0 * x1 + x1**2 + y0**2 + y0 * y1 + y1**2)).sum() / 12
    return area, polar


def kinetic(nodes, phi):
    """½ ∫ |ω ẑ×x + ∇φ|² = ½ ω² ∫r² + ∮ φ (½ q + ω (ẑ×x)·n) ds."""
    q, middle, length, t = solve(nodes, phi)
    phi_middle = 0.5 * (phi + np.roll(phi, -1))
    normal = -1j * t
    swirl = ((OMEGA * 1j * middle) * np.conj(normal)).real
    return 0.5 * OMEGA**2 * moments(nodes)[1] + 4 * np.sum(phi_middle * (0.5 * q + swirl) * length)


def rounded(s):
    """A side of |x|^n + |y|^n = 2^-n, from the diagonal in the third quadrant to that in the fourth, at arc lengths s."""
    angle = -0.75 * np.pi + 0.5 * np.pi * np.linspace(0, 1, 20001)
    z = np.exp(1j * angle)
    z *= 0.5 / (np.abs(z.real) ** EXPONENT + np.abs(z.imag) ** EXPONENT) ** (1 / EXPONENT)
    arc = np.concatenate([[0], np.cumsum(np.abs(np.diff(z)))])
    return np.interp(s * arc[-1], arc, z.real) + 1j * np.interp(s * arc[-1], arc, z.imag)


def smooth(nodes, phi):
    """Longuet-Higgins and Cokelet's five-point filter against the saw tooth that grows along a free surface."""
    n = len(nodes)
    z = np.concatenate([nodes[-2:] / 1j, nodes, nodes[:2] * 1j])
    f = np.concatenate([phi[-2:], phi, phi[:2]])
    five = lambda v: (-v[:-4] + 4 * v[1:-3] + 10 * v[2:-2] + 4 * v[3:-1] - v[4:]) / 16
    return five(z), five(f)


def redistribute(nodes, phi):
    """Nodes along the side, denser near its two corners, by splines over the arc length."""
    z = np.concatenate([nodes / 1j, nodes, nodes * 1j])
    f = np.concatenate([phi, phi, phi])
    s = np.concatenate([[0], np.cumsum(np.abs(np.diff(z)))])
    n = len(nodes)
    s -= s[n]
    length = s[2 * n]
    u = np.linspace(0, 1, n + 1)[:-1]
    wanted = length * (u - CLUSTER * np.sin(2 * np.pi * u) / (2 * np.pi))
    return CubicSpline(s, z)(wanted), CubicSpline(s, f)(wanted)


def main():
    # The lower side, from its left corner; the corner is rounded, or the first step would be singular there.
    u = np.linspace(0, 1, PER_SIDE + 1)[:-1]
    s = u - CLUSTER * np.sin(2 * np.pi * u) / (2 * np.pi)
    nodes = rounded(s)
    phi = np.zeros(PER_SIDE)
    area0, polar0 = moments(nodes)
    spread0 = polar0 / area0
    rows = []
    for step in range(int(round(END / DT)) + 1):
        time = step * DT
        area, polar = moments(nodes)
        if step % int(round(0.02 / DT)) == 0:
            rows.append((time, polar / area - spread0, np.abs(nodes).max(), area / area0, kinetic(nodes, phi) / area0**2))
        k1 = rates(nodes, phi)
        k2 = rates(nodes + 0.5 * DT * k1[0], phi + 0.5 * DT * k1[1])
        k3 = rates(nodes + 0.5 * DT * k2[0], phi + 0.5 * DT * k2[1])
        k4 = rates(nodes + DT * k3[0], phi + DT * k3[1])
        nodes = nodes + DT / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        phi = phi + DT / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
        if step % SMOOTH == SMOOTH - 1:
            nodes, phi = smooth(nodes, phi)
        nodes, phi = redistribute(nodes, phi)
    out = "boundary_element.csv"
    with open(out, "w") as file:
        file.write("time[s],growth_of_mean_square_radius[m2],largest_radius[m],area[-],kinetic_energy[-]\n")
        for row in rows:
            file.write(",".join(f"{value:.7g}" for value in row) + "\n")


main()

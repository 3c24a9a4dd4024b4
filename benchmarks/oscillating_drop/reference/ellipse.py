#!/usr/bin/env python3
"""The oscillating drop: an ellipse of incompressible, inviscid water in a central force, u = (A x, -A y). Writes ellipse.csv.

Semi-axes a, b and the rate A follow (Monaghan & Rafiee 2013, Int. J. Numer. Meth. Fluids 71, 537)

    A' = (A² + B²) (b² - a²)/(a² + b²),    a' = A a,    b' = -A b,

with a = b = 1 m, A = 1 1/s at t = 0 and B = 1 1/s: a period of 4.827 s and a largest half axis of 1.932 m.

Columns: time [s], mean of x² = a²/4 [m²], mean of y² = b²/4 [m²], a [m], A [1/s].
"""
import numpy as np

B, DT, END = 1.0, 1e-3, 4.83


def rate(s):
    a, b, A = s
    return np.array([A * a, -A * b, (A * A + B * B) * (b * b - a * a) / (a * a + b * b)])


def main():
    state, out = np.array([1.0, 1.0, 1.0]), open("ellipse.csv", "w")
    out.write("time[s],mean_square_x[m2],mean_square_y[m2],a[m],A[1/s]\n")
    for step in range(int(round(END / DT)) + 1):
        if step % 10 == 0:
            a, b, A = state
            out.write(f"{step * DT:.3f},{a * a / 4:.8f},{b * b / 4:.8f},{a:.8f},{A:.8f}\n")
        k1 = rate(state)
        k2 = rate(state + 0.5 * DT * k1)
        k3 = rate(state + 0.5 * DT * k2)
        k4 = rate(state + DT * k3)
        state = state + DT / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


main()

#!/usr/bin/python3
"""Remakes the pictures in the folders of the fluid's cases: runs their scenes and draws what has come out.

    python3 benchmarks/pictures.py                   all of them: some minutes on two cores
    python3 benchmarks/pictures.py still_tank        one
    python3 benchmarks/pictures.py --keep            draws runs that are there already again

Needs numpy, h5py and matplotlib (Debian: python3-h5py, python3-matplotlib). Runs go to results/pictures.
"""
import argparse
import csv
import json
import pathlib
import subprocess

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import EllipseCollection

ROOT = pathlib.Path(__file__).resolve().parent.parent
BENCHMARKS = ROOT / "benchmarks"
plt.rcParams.update({"font.size": 8, "axes.titlesize": 9, "savefig.dpi": 120, "lines.linewidth": 1})
LOW_DISSIPATION = "fluid.scheme.riemann_solver=low_dissipation"


class Run:
    """A scene that has been computed; `changes`: as for --set."""

    options = None

    def __init__(self, case, name, *changes):
        self.folder = ROOT / "results" / "pictures" / case / name
        if not (self.options.keep and (self.folder / "summary.json").exists()):
            command = [self.options.program, "run", BENCHMARKS / case / "scene.toml", "--out", self.folder, "--quiet"]
            for change in changes:
                command += ["--set", change]
            subprocess.run([str(part) for part in command], check=True)
        self.spacing = json.loads((self.folder / "summary.json").read_text())["scene"]["fluid"]["spacing"]

    def history(self):
        """Columns of history.csv by name, without units."""
        with open(self.folder / "history.csv", newline="") as file:
            rows = list(csv.reader(file))
        values = np.array(rows[1:], dtype=float)
        return {name.split("[")[0]: values[:, k] for k, name in enumerate(rows[0])}

    def frame(self, time):
        """The frame nearest to `time`: its time and what it holds."""
        series = json.loads((self.folder / "fluid.hdf.series").read_text())["files"]
        found = min(series, key=lambda entry: abs(entry["time"] - time))
        with h5py.File(self.folder / found["name"]) as file:
            data = file["VTKHDF"]
            fields = {name: values[:] for name, values in data["PointData"].items()}
            return found["time"], data["Points"][:, :2], fields


def water(axes, run, time, values, limits, title=None):
    """Particles as discs of the size of their cell, coloured by values(fields)."""
    t, points, fields = run.frame(time)
    diameter = np.full(len(points), 1.05 * run.spacing)
    discs = EllipseCollection(diameter, diameter, np.zeros(len(points)), units="xy", offsets=points,
                              transOffset=axes.transData, linewidths=0, cmap="viridis")
    discs.set_array(values(fields))
    discs.set_clim(*limits)
    axes.add_collection(discs)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_title(title or f"t = {t:.3g} s")
    axes.set_xlabel("x [m]")
    return discs


def pressure(unit):
    return lambda fields: fields["pressure"] / unit


def speed(fields):
    return np.linalg.norm(fields["velocity"], axis=1)


def colours(figure, discs, axes, label):
    figure.colorbar(discs, ax=axes, label=label, extend="both", shrink=0.85)


def save(figure, case, name="flow"):
    file = BENCHMARKS / case / f"{name}.png"
    figure.savefig(file)
    plt.close(figure)
    print(file.relative_to(ROOT))


def row(count, width, height, **options):
    figure, axes = plt.subplots(1, count, figsize=(width, height), layout="constrained", **options)
    axes[0].set_ylabel("y [m]")
    return figure, axes


def oscillating_drop():
    run = Run("oscillating_drop", "muscl")
    figure, axes = row(4, 9.6, 2.8, sharex=True, sharey=True)
    for k, one in enumerate(axes):
        discs = water(one, run, k * 4.827 / 4, pressure(1), (0, 1000))
        one.set(xlim=(-2.1, 2.1), ylim=(-2.1, 2.1))
    colours(figure, discs, axes, "pressure [Pa]")
    save(figure, "oscillating_drop")


def rotating_square_patch():
    run = Run("rotating_square_patch", "muscl")
    figure, axes = row(4, 9.6, 2.6, sharex=True, sharey=True)
    for one, t in zip(axes, (0, 0.5, 1, 2)):
        discs = water(one, run, t, pressure(1), (-140, 0), f"tω = {t:g}")
        one.set(xlim=(-1.4, 1.4), ylim=(-1.4, 1.4))
    colours(figure, discs, axes, "pressure [Pa]")
    save(figure, "rotating_square_patch")


def still_tank():
    run = Run("still_tank", "muscl")
    figure, axes = row(3, 8, 2.5, sharex=True, sharey=True)
    for one, t in zip(axes, (0, 5, 10)):
        discs = water(one, run, t, pressure(1000), (0, 9.81))
        one.plot([0, 0, 0.5, 0.5, 1, 1], [1.1, 0, 0, 0.5, 0.5, 1.1], "k")
    colours(figure, discs, axes, "pressure [kPa]")
    save(figure, "still_tank")


def taylor_green():
    run = Run("taylor_green", "muscl")
    figure, axes = row(3, 8, 3, sharex=True, sharey=True)
    for one, t in zip(axes, (0, 1, 2)):
        exact = np.exp(-8 * np.pi**2 * 0.01 * t)
        discs = water(one, run, t, lambda fields: speed(fields) / exact, (0, 1))
    colours(figure, discs, axes, "speed / exact decay")
    save(figure, "taylor_green")


def poiseuille():
    run = Run("poiseuille", "muscl")
    y = np.linspace(0, 1, 200)
    figure, axes = plt.subplots(figsize=(4.6, 2.7), layout="constrained")
    for k, t in enumerate((0.5, 1, 3)):
        t, points, fields = run.frame(t)
        axes.plot(fields["velocity"][:, 0], points[:, 1], ".", color=f"C{k}", markersize=3, label=f"t = {t:.3g} s")
        axes.plot(poiseuille_series(y, t), y, "k", linewidth=0.8, label="series" if k == 2 else None)
    axes.set(xlabel="velocity along the plates [m/s]", ylabel="y [m]", xlim=(0, None))
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    save(figure, "poiseuille", "profiles")


def poiseuille_series(y, t, force=0.8, viscosity=0.1, height=1.0):
    """Morris, Fox & Zhu (1997), eq. (21), as in the scene."""
    u = force / (2 * viscosity) * y * (height - y)
    for n in range(1, 21, 2):
        rate = viscosity * (n * np.pi / height) ** 2
        u -= 4 * force * height**2 / (viscosity * (n * np.pi) ** 3) * np.sin(n * np.pi * y / height) * np.exp(-rate * t)
    return u


def standing_wave():
    figure, axes = plt.subplots(figsize=(6.6, 2.6), layout="constrained")
    k, amplitude = 2 * np.pi, 0.01
    omega = np.sqrt(9.81 * k * np.tanh(k * 0.5))
    t = np.linspace(0, 4, 800)
    axes.plot(t, amplitude * omega * np.cos(omega * t), "k--", label="linear theory")
    for label, name, changes in (("Riemann, MUSCL", "muscl", ()),
                                 ("low dissipation", "low_dissipation", (LOW_DISSIPATION,)),
                                 ("δ-SPH", "delta_sph", ("fluid.scheme.name=delta_sph",))):
        history = Run("standing_wave", name, *changes).history()
        axes.plot(history["time"], history["wave_velocity"], label=label)
    axes.set(xlabel="time [s]", ylabel="velocity of the mode [m/s]", xlim=(0, 4))
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 1.18), ncols=4, frameon=False)
    save(figure, "standing_wave", "decay")


def wedge_entry():
    fine = Run("wedge_entry", "1cm")
    figure, (flow, force) = plt.subplots(1, 2, figsize=(9, 2.7), layout="constrained", width_ratios=(1.3, 1))
    discs = water(flow, fine, 0.1, pressure(1000), (0, 3))
    flow.plot([-0.6, 0, 0.6], np.array([0.6, 0, 0.6]) * np.tan(np.pi / 6) - 0.1, "k")
    flow.set(xlim=(-0.6, 0.6), ylim=(-0.4, 0.2), ylabel="y [m]")
    colours(figure, discs, flow, "pressure [kPa]")
    for label, run in (("Δx 2 cm", Run("wedge_entry", "2cm", "fluid.spacing=0.02")), ("Δx 1 cm", fine)):
        history = run.history()
        force.plot(history["time"], history["wedge_force_y"] / 1000, label=label)
    force.plot([0, 0.1], [0, 1.402], "k--", label="14.02 ρ V³ t")
    force.set(xlabel="time [s]", ylabel="force on the wedge [kN/m]", xlim=(0, 0.1), ylim=(0, None))
    force.legend()
    save(figure, "wedge_entry")


def jet_impact():
    pointed = Run("jet_impact", "low_dissipation", "fluid.spacing=0.005", LOW_DISSIPATION)
    flat = Run("jet_impact", "flat", "fluid.spacing=0.005", LOW_DISSIPATION,
               "fluid.polygon=[{points = [[-1.6, -0.1], [-0.02, -0.1], [-0.02, 0.1], [-1.6, 0.1]], "
               "velocity = [10.0, 0.0]}]")
    figure, axes = plt.subplots(1, 3, figsize=(9.4, 3), layout="constrained", width_ratios=(1, 1, 2.2))
    for one, t in zip(axes, (0.016, 0.06)):
        discs = water(one, pointed, t, pressure(1000), (0, 50))
        one.plot([0, 0], [-0.9, 0.9], "k", linewidth=2)
        one.set(xlim=(-0.9, 0.05), ylim=(-0.9, 0.9))
    axes[0].set_ylabel("y [m]")
    colours(figure, discs, axes[1], "pressure [kPa]")
    for label, run, style in (("flat face, low dissipation, Δx 0.5 cm", flat, "0.8"),
                              ("pointed, low dissipation, Δx 0.5 cm", pointed, "C0"),
                              ("pointed, MUSCL, Δx 1 cm", Run("jet_impact", "muscl"), "C1")):
        history = run.history()
        axes[2].plot(history["time"], history["plate_force_x"] / 1000, color=style, label=label)
    axes[2].axhline(20, color="k", linestyle="--", label="ρ U² b")
    axes[2].set(xlabel="time [s]", ylabel="force on the plate [kN/m]", xlim=(0, 0.1), ylim=(0, 60))
    axes[2].legend(loc="upper right")
    save(figure, "jet_impact")


def dam_break():
    runs = {"Riemann, MUSCL": Run("dam_break", "muscl", "fluid.spacing=0.005"),
            "low dissipation": Run("dam_break", "low_dissipation", "fluid.spacing=0.005", LOW_DISSIPATION)}
    figure, axes = plt.subplots(2, 2, figsize=(8.8, 4.4), layout="constrained", height_ratios=(1, 1.1))
    for one, t in zip(axes[0], (0.36, 0.72)):
        discs = water(one, runs["low dissipation"], t, pressure(1000), (0, 3))
        one.plot([0, 0, 1.61, 1.61], [0.6, 0, 0, 0.6], "k")
        one.set(xlim=(-0.02, 1.63), ylim=(-0.02, 0.6))
    axes[0, 0].set_ylabel("y [m]")
    colours(figure, discs, axes[0], "pressure [kPa]")
    for one, sensor in zip(axes[1], ("p1", "p3")):
        for label, run in runs.items():
            history = run.history()
            one.plot(history["time"], history[f"{sensor}_pressure"] / 1000, label=label, linewidth=0.8)
        measured = np.loadtxt(BENCHMARKS / "dam_break" / "reference" / f"lobovsky_exp_data_{sensor}.txt")
        one.plot(measured[:, 0] * np.sqrt(0.3 / 9.81), measured[:, 1] * 9.81 * 0.3, "k.", markersize=3,
                 label="Lobovský et al. 2014")
        one.set(title=sensor, xlabel="time [s]", xlim=(0.35, 0.9), ylim=(0, 12))
        one.legend()
    axes[1, 0].set_ylabel("pressure [kPa]")
    save(figure, "dam_break")


CASES = (dam_break, jet_impact, oscillating_drop, poiseuille, rotating_square_patch, standing_wave, still_tank,
         taylor_green, wedge_entry)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", nargs="*", choices=[[], *(case.__name__ for case in CASES)], help="default: all")
    parser.add_argument("--keep", action="store_true", help="draw runs that are there already again")
    parser.add_argument("--program", default=ROOT / "aquagraph", help="what computes the scenes")
    Run.options = parser.parse_args()
    for case in CASES:
        if not Run.options.case or case.__name__ in Run.options.case:
            case()


if __name__ == "__main__":
    main()

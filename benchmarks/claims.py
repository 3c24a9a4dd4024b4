#!/usr/bin/python3
"""Measures tables of CLAIMS.md again: runs scenes with other settings and prints what came out as Markdown.

    python3 benchmarks/claims.py                     all of them: about twenty minutes on two cores
    python3 benchmarks/claims.py gate iterated       some
    python3 benchmarks/claims.py --keep              only runs that are not there yet

Roughness is the total variation of a column of history.csv, sum of |x_k+1 - x_k| over its rows, divided by that of the
run it is compared with. Needs nothing but Python. Runs go to results/claims.
"""
import argparse
import bisect
import csv
import json
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
BENCHMARKS = ROOT / "benchmarks"
RATIOS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24)


class Run:
    """A scene that has been computed, or has failed; `changes`: as for --set."""

    options = None

    def __init__(self, scene, name, *changes):
        self.folder = ROOT / "results" / "claims" / name
        summary = self.folder / "summary.json"
        if not (self.options.keep and summary.exists()):
            summary.unlink(missing_ok=True)
            self.command("run", scene, ("output.frame_interval=1000", *changes), "--out", self.folder, "--quiet",
                         "--threads", self.options.threads)
        self.summary = json.loads(summary.read_text())
        self.finished = self.summary["outcome"] == "finished"
        with open(self.folder / "history.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.columns = {name.split("[")[0]: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}

    @classmethod
    def command(cls, what, scene, changes, *arguments):
        words = [cls.options.program, what, BENCHMARKS / scene, *arguments]
        for change in changes:
            words += ["--set", change]
        return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False).stdout

    def roughness(self, column):
        values = self.columns[column]
        return sum(abs(b - a) for a, b in zip(values, values[1:]))

    def end(self):
        return self.columns["time"][-1]

    def difference(self, other, column):
        """Root mean square of the difference over the other's largest value."""
        time, values = self.columns["time"], self.columns[column]
        squares = 0
        for t, value in zip(other.columns["time"], other.columns[column]):
            k = min(max(bisect.bisect(time, t), 1), len(time) - 1)
            part = (t - time[k - 1]) / (time[k] - time[k - 1])
            squares += (values[k - 1] + part * (values[k] - values[k - 1]) - value) ** 2
        return (squares / len(other.columns["time"])) ** 0.5 / max(abs(x) for x in other.columns[column])


def table(head, rows):
    print("\n| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |", flush=True)


def largest(run, column):
    return max(abs(x) for x in run.columns[column])


def beam():
    """6.1: the beam impact with p = 16 and 20, with and without extrapolation."""
    def run(p, extrapolation):
        return Run("beam_impact/scene.toml", f"beam_p{p}_{extrapolation}", "fluid.spacing=0.008",
                   f"coupling.ratio={p}", f"coupling.extrapolation={extrapolation}")

    first = run(1, "linear")
    rows = []
    for p, extrapolation in ((1, "linear"), (16, "linear"), (20, "linear"), (16, "none")):
        one = run(p, extrapolation)
        force, middle = (largest(one, column) / largest(first, column) for column in ("plate_force_y", "mid_y"))
        rough = one.roughness("plate_force_y") / first.roughness("plate_force_y")
        rows.append((p, extrapolation, f"{rough:.2f}", f"{100 * force - 100:+.1f} %", f"{100 * middle - 100:+.1f} %",
                     "" if one.finished else f"fails at {1000 * one.end():.3g} ms"))
    table(("p", "extrapolation", "roughness of the force", "largest force", "largest deflection", ""), rows)


def scan(scene, name, force, tip, case, algorithm, changes, ratios=RATIOS):
    """One row: from which p on force and tip are rough and the run fails. Compared with CSS, p = 1, likewise."""
    def run(algorithm, p):
        return Run(scene, f"{name}_{algorithm}_p{p}", *changes, f"coupling.algorithm={algorithm}",
                   f"coupling.ratio={p}")

    reference = run("css", 1)
    text = Run.command("check", scene, (*changes, f"coupling.algorithm={algorithm}"))
    forecast = re.search(r"(no p|any p|p up to about (\d+))", text)
    stable = "–" if not forecast else forecast[2] or {"no p": "0", "any p": "any"}[forecast[1]]
    seen = []
    for p in ratios:
        one = run(algorithm, p)
        seen.append((p, one.finished, *(one.roughness(c) / reference.roughness(c) for c in (force, tip))))
        if not one.finished:
            break

    def from_on(part, limit):
        rough = [one for one in seen if one[1] and one[part] >= limit]
        smooth = [str(one[0]) for one in seen if one[1] and rough and one[0] > rough[0][0] and one[part] < limit]
        return "–" if not rough else f"{rough[0][0]} ({rough[0][part]:.3g} times" + (
            f", not {', '.join(smooth)})" if smooth else ")")

    failed = [str(p) for p, finished, *_ in seen if not finished]
    row = (case, algorithm.upper(), stable, from_on(2, 3), from_on(3, 1.4), failed[0] if failed else
           f"none to {seen[-1][0]}")
    print("  ".join(f"p {p}: " + (f"{f:.3g}, {t:.3g}" if finished else "fails") for p, finished, f, t in seen),
          flush=True)
    return row


HEAD = ("case", "", "forecast: stable up to", "p measured: force rough from", "tip rough from", "run fails from")


def gate():
    """How large a p the gate bears, over its density: Δx 2.5 mm, c0 25 m/s, 0.1 s."""
    common = ("fluid.spacing=0.0025", "fluid.sound_speed=25", "time.end=0.1")
    rows = []
    for density, scheme in ((4400, "newmark"), (2200, "newmark"), (1100, "newmark"), (1100, "hht"), (550, "newmark"),
                            (275, "newmark")):
        for algorithm in ("css", "cps"):
            rows.append(scan("gate_2d/scene.toml", f"gate_{density}_{scheme}", "gate_force_x", "tip_x",
                             f"gate, {density} kg/m³, {scheme}", algorithm,
                             (*common, f"solid.material.density={density}", f"solid.scheme.name={scheme}")))
    table(HEAD, rows)


def plate():
    """How large a p the plate bears: 40 × 4 elements, c0 50 m/s, CFL 0.2, 0.1 s."""
    rows = []
    for spacing, scheme, algorithm in ((0.04, "hht", "cps"), (0.02, "hht", "cps"), (0.04, "newmark", "cps"),
                                       (0.04, "newmark", "css"), (0.02, "newmark", "cps"), (0.02, "newmark", "css")):
        rows.append(scan("hydrostatic_plate/scene.toml", f"plate_{spacing}_{scheme}", "plate_force_y", "mid_y",
                         f"plate, Δx {100 * spacing:g} cm, {scheme}", algorithm,
                         (f"fluid.spacing={spacing}", "time.end=0.1", f"solid.scheme.name={scheme}")))
    table(HEAD, rows)


def gate_1mm():
    """Claim 6 at the thesis's 1 mm: c0 25 m/s, 0.1 s."""
    def run(algorithm, p):
        return Run("gate_2d/scene_1mm.toml", f"gate_1mm_{algorithm}_p{p}", "fluid.sound_speed=25", "time.end=0.1",
                   f"coupling.algorithm={algorithm}", f"coupling.ratio={p}")

    first = run("css", 1)
    rows = []
    for algorithm, p in (("cps", 1), ("cps", 2), ("cps", 4), ("cps", 8), ("css", 4), ("css", 8), ("css", 16)):
        one = run(algorithm, p)
        rows.append((algorithm.upper(), p) + (
            (f"{100 * one.difference(first, 'tip_x'):.2g} %",
             f"{one.roughness('gate_force_x') / first.roughness('gate_force_x'):.3g}") if one.finished else
            (f"fails at {1000 * one.end():.3g} ms", "")))
    table(("", "p", "tip against CSS, p = 1", "roughness of the force"), rows)


def iterated():
    """The iterated algorithm on gate (Δx 2.5 mm, c0 25 m/s, 0.1 s) and plate (Δx 4 cm, 0.1 s, CFL 0.2)."""
    def runs(scene, name, tip, force, changes):
        def run(algorithm, p):
            return Run(scene, f"{name}_{algorithm}_p{p}", *changes, f"coupling.algorithm={algorithm}",
                       f"coupling.ratio={p}")

        first = run("iterated", 1)
        rows = []
        for algorithm, p in (("cps", 1), ("iterated", 1), ("iterated", 4), ("iterated", 8), ("iterated", 16),
                             ("iterated", 24)):
            one = run(algorithm, p)
            counted = one.summary.get("iterations")
            steps, tasks = one.summary["steps"], one.summary["tasks"]
            rows.append((algorithm, p, f"{counted['total'] / counted['cycles']:.1f}" if counted else "–",
                         tasks["clock"]["calls"] if "clock" in tasks else steps, tasks["FE Newton solve"]["calls"],
                         f"{counted['unconverged_cycles']} of {counted['cycles']}" if counted else "",
                         counted["failed_trials"] if counted else "",
                         f"{100 * one.difference(first, tip):.2g} %" if one.finished else
                         f"fails at {1000 * one.end():.3g} ms", f"{one.roughness(force):.4g}"))
        table((name, "p", "iterations of a cycle", "fluid steps", "solves", "not converged", "failed trials",
               "tip against p = 1", "force, total variation [N/m]"), rows)

    runs("gate_2d/scene.toml", "gate", "tip_x", "gate_force_x",
         ("fluid.spacing=0.0025", "fluid.sound_speed=25", "time.end=0.1"))
    runs("hydrostatic_plate/scene.toml", "plate", "mid_y", "plate_force_y", ("fluid.spacing=0.04", "time.end=0.1"))


TABLES = (gate, plate, iterated, gate_1mm, beam)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", nargs="*", choices=[[], *(one.__name__ for one in TABLES)], help="default: all")
    parser.add_argument("--keep", action="store_true", help="computes only what is not there yet")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--program", default=ROOT / "aquagraph", help="what computes the scenes")
    Run.options = parser.parse_args()
    for one in TABLES:
        if not Run.options.table or one.__name__ in Run.options.table:
            print(f"\n{one.__doc__}")
            one()


if __name__ == "__main__":
    main()

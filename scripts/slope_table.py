#!/usr/bin/env python3
"""slope_table.py [--jobs N] [--fine]: the angle of the slope of problems/slope.toml against everything that it might
depend on, as the table of problems/slope.md. Each run takes one thread; --jobs of them go side by side. --fine adds the
mesh twice as fine, which takes minutes. Needs build/release/stillpoint (scripts/build_preset release)."""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PLANE_STRAIN = ["material.soil.cone=plane-strain"]
MOHR_COULOMB = [
    "body.material=soil_without_cone",
    'material.soil_without_cone={law="mohr-coulomb", E=20e6, nu=0.3, rho=1800.0, phi=35.0, psi=0.0, c=0.0}',
]
FINE = ["grid.cells=[240, 132]"]

# name, overrides
RUNS = [("mean cone, the scene as it is", [])]
RUNS += [(f"cone {cone}", [f"material.soil.cone={cone}"]) for cone in ("plane-strain", "compression", "extension")]
RUNS += [("Mohr–Coulomb", MOHR_COULOMB)]
for name, law in (("mean", []), ("plane-strain", PLANE_STRAIN), ("Mohr–Coulomb", MOHR_COULOMB)):
    RUNS += [(f"{name}, alpha {alpha}", law + [f"damping.alpha={alpha}"]) for alpha in (0.0, 0.7)]
    RUNS += [(f"{name}, mass scaling {scaling}", law + [f"mass.scaling={scaling}"]) for scaling in (1, 5)]
    RUNS += [(f"{name}, 9 points a cell", law + ["body.points_per_cell=9"])]
    RUNS += [(f"{name}, max_motion {share}", law + [f"phase.max_motion={share}"]) for share in (0.0, 0.02, 0.3)]
FINE_RUNS = [
    ("mean, h/2", FINE),
    ("plane-strain, h/2", PLANE_STRAIN + FINE),
    ("Mohr–Coulomb, h/2", MOHR_COULOMB + FINE),
]


def eta(strength, phi=35.0):
    """Friction coefficient of the cone or of Mohr-Coulomb in plane strain, and with it Davis' angle atan(eta) for
    psi = 0."""
    s = math.sin(math.radians(phi))
    return {
        "mohr-coulomb": s,
        "plane-strain": s,
        "mean": 18 * s / (math.sqrt(3) * (9 - s * s)),
        "compression": 6 * s / (math.sqrt(3) * (3 - s)),
        "extension": 6 * s / (math.sqrt(3) * (3 + s)),
    }[strength]


def run(case):
    name, overrides = case
    with tempfile.TemporaryDirectory() as out:
        command = [ROOT / "build/release/stillpoint", "run", ROOT / "problems/slope.toml", "--quiet", "--out", out]
        command += ["--threads", "1", "--set", "output.stages=[]"]
        for override in overrides:
            command += ["--set", override]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        summary = Path(out) / "summary.json"
        if not summary.exists():
            return name, overrides, None, result.stderr.strip()
        return name, overrides, json.loads(summary.read_text()), result.stderr.strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--fine", action="store_true")
    arguments = parser.parse_args()
    failed = 0
    print("| run | slope angle | atan η | phases | steps | ns a point and step | mass error |")
    print("|---|---|---|---|---|---|---|")
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for name, overrides, summary, message in pool.map(run, RUNS + (FINE_RUNS if arguments.fine else [])):
            if summary is None or summary["exit_status"] != 0:
                failed += 1
                print(f"| {name} | failed: {message} | | | | | |", flush=True)
                continue
            strength = next((o.split("=")[1] for o in overrides if o.startswith("material.soil.cone=")), "mean")
            if MOHR_COULOMB[0] in overrides:
                strength = "mohr-coulomb"
            print(
                f"| {name} | {summary['slope_angle']:.2f}° | {math.degrees(math.atan(eta(strength))):.1f}° | "
                f"{summary['phases']} | {summary['steps']} | {summary['ns_per_point_step']:.1f} | "
                f"{summary['mass_error']:.0e} |",
                flush=True,
            )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

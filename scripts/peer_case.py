#!/usr/bin/env python3
"""Flies `flapping-rectangles` with wingbeat and with PteraSoftware, prints times and loads side by side.

    cargo build --release
    python3 -m pip install pterasoftware==5.1.0
    python3 scripts/peer_case.py [target/release/wingbeat]

Times are CPU seconds of the user on one thread, one program after the other. Ptera places its vortex
rings at the panels' quarter chords, wingbeat's benchmark scheme at their edges: loads agree to the
discretisation.
"""

import csv
import os
import resource
import subprocess
import sys
import tempfile
from math import cos, radians, sin

os.environ |= {name: "1" for name in ("OMP_NUM_THREADS", "NUMBA_NUM_THREADS", "RAYON_NUM_THREADS")}
STEPS, BEATS, PERIOD, ALPHA = 40, 3, 0.25, 5.0


def last_beat_mean(history):
    """Mean over the last beat by the trapezoidal rule."""
    beat = history[-STEPS - 1 :]
    return (sum(beat) - 0.5 * (beat[0] + beat[-1])) / STEPS


def cpu(who):
    return resource.getrusage(who).ru_utime


def wingbeat(program, *settings):
    """CPU seconds, lift [N] step by step (normal to the stream, in the plane of symmetry)."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "result")
        sets = [x for s in settings for x in ("--set", s)]
        before = cpu(resource.RUSAGE_CHILDREN)
        subprocess.run([program, "run", "flapping-rectangles", "--quiet", "--out", out, *sets], check=True,
                       stdout=subprocess.DEVNULL)
        seconds = cpu(resource.RUSAGE_CHILDREN) - before
        with open(os.path.join(out, "history.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
    force = [[sum(float(row[f"air_wing_{side}_force_n{axis}_newton"]) for side in ("left", "right"))
              for axis in (1, 3)] for row in rows]
    s, c = sin(radians(ALPHA)), cos(radians(ALPHA))
    return seconds, [s * x - c * z for x, z in force]


def ptera():
    """The same of PteraSoftware, free wake; compiling and setting up are not counted."""
    import pterasoftware as ps

    def flyer():
        section = lambda place, panels: ps.geometry.wing_cross_section.WingCrossSection(
            airfoil=ps.geometry.airfoil.Airfoil(name="naca0001"), num_spanwise_panels=panels, chord=0.1,
            Lp_Wcsp_Lpp=place, spanwise_spacing="uniform" if panels else None)
        wing = lambda mirrored: ps.geometry.wing.Wing(
            wing_cross_sections=[section((0, 0, 0), 20), section((0, 0.4, 0), None)],
            Ler_Gs_Cgs=(0, 0.01, 0), num_chordwise_panels=8, chordwise_spacing="uniform",
            mirror_only=mirrored, symmetryNormal_G=(0, 1, 0) if mirrored else None,
            symmetryPoint_G_Cg=(0, 0, 0) if mirrored else None)
        return ps.geometry.airplane.Airplane(wings=[wing(False), wing(True)], s_ref=0.08, c_ref=0.1, b_ref=0.8)

    def problem(steps):
        airplane = flyer()
        flap = [ps.movements.wing_movement.WingMovement(
            base_wing=wing,
            wing_cross_section_movements=[
                ps.movements.wing_cross_section_movement.WingCrossSectionMovement(base_wing_cross_section=s)
                for s in wing.wing_cross_sections],
            ampAngles_Gs_to_Wn_ixyz=(25.0, 0, 0), periodAngles_Gs_to_Wn_ixyz=(PERIOD, 0, 0),
            phaseAngles_Gs_to_Wn_ixyz=(90.0, 0, 0)) for wing in airplane.wings]
        stream = ps.operating_point.OperatingPoint(rho=1.225, vCg__E=4.0, alpha=ALPHA)
        movement = ps.movements.movement.Movement(
            airplane_movements=[ps.movements.airplane_movement.AirplaneMovement(
                base_airplane=airplane, wing_movements=flap)],
            operating_point_movement=ps.movements.operating_point_movement.OperatingPointMovement(
                base_operating_point=stream),
            delta_time=PERIOD / STEPS, num_steps=steps)
        return ps.problems.UnsteadyProblem(movement=movement)

    def run(steps):
        task = problem(steps)
        solver = ps.unsteady_ring_vortex_lattice_method.UnsteadyRingVortexLatticeMethodSolver(task)
        before = cpu(resource.RUSAGE_SELF)
        solver.run(prescribed_wake=False, calculate_streamlines=False, show_progress=False)
        return cpu(resource.RUSAGE_SELF) - before, task

    run(3)  # compiles
    seconds, task = run(STEPS * BEATS + 1)
    return seconds, [-step.airplanes[0].forces_W[2] for step in task.steady_problems]


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "target/release/wingbeat"
    runs = {
        "wingbeat": wingbeat(program, "air.summation=direct"),
        "wingbeat, as it is": wingbeat(program),
        "wingbeat, one half": wingbeat(program, "air.mirror=true", "air.summation=direct"),
    }
    try:
        runs["PteraSoftware"] = ptera()
    except ImportError:
        print("PteraSoftware is not installed: python3 -m pip install pterasoftware==5.1.0")
    ours = runs["wingbeat"][0]
    print(f"{'':<22}{'CPU [s]':>10}{'ratio':>8}{'mean lift of the last beat [N]':>34}")
    for name, (seconds, lift) in runs.items():
        print(f"{name:<22}{seconds:>10.2f}{seconds / ours:>8.2f}{last_beat_mean(lift):>34.4f}")


if __name__ == "__main__":
    main()

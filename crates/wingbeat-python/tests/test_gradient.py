"""Derivatives of flights and trims by keys."""

from __future__ import annotations

import numpy as np
import pytest

from wingbeat import CaseError, Flight, Problem, _gradient
from wingbeat.campaign import Serial

VARIABLES = {
    "motion.frequency_hz": (150.0, 260.0),
    "motion.adjust.stroke_amplitude": (-0.4, 0.2),
    "motion.adjust.feathering_lead": (-0.08, 0.08),
    "body.mass_kg": (8e-7, 1e-6),
}
X = np.array([200.0, 0.0, 0.01, 9.3e-7])


def central(problem: Problem, x: np.ndarray) -> np.ndarray:
    """Five-point central differences over a fixed step: another way, with errors of fourth order in it."""
    step = 3e-4 * (problem.upper - problem.lower)
    columns = []
    for e in np.diag(step):
        a, b, c, d = problem.evaluate([x + e, x - e, x + 2 * e, x - 2 * e])
        columns.append((8 * (a - b) - (c - d)) / (12 * e.sum()))
    return np.column_stack(columns)


def test_exact_lift_of_a_held_fly_grows_with_the_square_of_the_frequency():
    base = Flight.preset("fruit-fly-blade").set({"flight.mode": "tethered", "time.beats": 1})
    problem = Problem(base, VARIABLES, ["lift_newton", "lift_over_weight"], executor=Serial())
    derivatives, (lift, ratio) = problem.gradient(X), problem.evaluate(X)
    assert derivatives.shape == problem.errors.shape == (2, 4)
    assert derivatives[0, 0] == pytest.approx(2 * lift / X[0], rel=1e-12)
    assert derivatives[0, 3] == 0.0
    mass = Flight.preset("fruit-fly-blade").set("body.mass_kg", X[3]).mass_kg  # wings included
    assert derivatives[1, 3] == pytest.approx(-ratio / mass, rel=1e-9)


def test_agrees_with_central_differences_in_free_flight():
    base = Flight.preset("fruit-fly-blade").set("time.beats", 1)
    problem = Problem(base, VARIABLES, ["lift_newton", "power_watt", "thrust_newton"], executor=Serial())
    derivatives = problem.gradient(X)
    assert np.allclose(derivatives, central(problem, X), rtol=1e-6, atol=0)
    assert (problem.errors <= 1e-6 * abs(derivatives)).all()


def test_agrees_with_central_differences_of_trims():
    keep = ["perfect_storage_watt", "stroke_amplitude", "body_pitch_rad"]
    variables = {"body.mass_kg": (8e-7, 1e-6), "trim.forward_m_per_s": (-0.3, 0.3)}
    problem = Problem("fruit-fly-blade", variables, keep, do="trim", executor=Serial())
    x = np.array([9.3e-7, 0.05])
    assert np.allclose(problem.gradient(x), central(problem, x), rtol=1e-6, atol=0)


def test_exact_to_one_side_next_to_bounds():
    seen = []

    def evaluate(points):
        seen.extend(points)
        return np.stack([np.exp(points[:, 0]) * np.cos(points[:, 1]), points[:, 1] ** 2], axis=1)

    lower, upper = np.array([0.0, -1.0]), np.array([1.0, 2.0])
    for x in ([0.0, 2.0], [1.0, -1.0], [0.5, 0.5]):
        found, errors = _gradient.jacobian(evaluate, np.array(x), lower, upper, 0.02, 1e-10)
        exact = [[np.exp(x[0]) * np.cos(x[1]), -np.exp(x[0]) * np.sin(x[1])], [0.0, 2 * x[1]]]
        assert np.allclose(found, exact, rtol=1e-8, atol=1e-8) and (errors < 1e-7).all()
        assert (abs(found - exact) <= 10 * errors + 1e-12).all()  # an estimate, no bound
    assert ((lower <= seen) & (seen <= upper)).all()


def test_behaves_gradients_of_several_points_and_of_failures():
    base = Flight.preset("fruit-fly-blade").set({"flight.mode": "tethered", "time.beats": 1})
    problem = Problem(base, {"motion.frequency_hz": (-100.0, 260.0)}, ["lift_newton"], executor=Serial())
    found = problem.gradient([[200.0], [-50.0]])
    assert found.shape == problem.errors.shape == (2, 1, 1) and np.isnan(found[1]).all()
    assert found[0].tolist() == problem.gradient([200.0]).tolist()


def test_refuses_points_outside_and_steps_that_are_none():
    problem = Problem("fruit-fly-blade", VARIABLES, ["lift_newton"], executor=Serial())
    for x, settings in ((X + 100, {}), (X[:2], {}), (X, {"first_step": 0.0}), (X, {"first_step": 0.5})):
        with pytest.raises(CaseError) as caught:
            problem.gradient(x, **settings)
        assert caught.value.remedy and caught.value.key

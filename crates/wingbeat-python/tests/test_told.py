"""What users are told of values that are no numbers, of copies and pickles, and of environments that two threads share."""

from __future__ import annotations

import copy
import pickle
import threading

import numpy as np
import pytest

import wingbeat
import wingbeat.gym
from wingbeat import Adjustment, Flight, campaign
from wingbeat.gym import Environment, VectorEnvironment


class Remembering:
    is_steady_and_uniform = True

    def __call__(self, _: wingbeat.Motions) -> np.ndarray:
        return np.zeros((3, 6))

    def accept(self, step: int) -> None: ...


LONG = np.full(3000, np.nan)
MASK = "reset_mask"
BAD = {
    "a task that is a number": ("task", lambda _: Environment(3)),
    "options that are a list": ("options", lambda _: Environment().reset(options=[])),
    "options of many that are a text": ("options", lambda _: VectorEnvironment(2).reset(options="reset_mask")),
    "a mask of numbers": (MASK, lambda _: VectorEnvironment(2).reset(options={MASK: np.array([np.nan, 0.0])})),
    "a mask of ones": (MASK, lambda _: VectorEnvironment(2).reset(options={MASK: [0, 1]})),
    "a truth value as amplitude": ("stroke_amplitude", lambda _: Adjustment(True)),
    "one of numpy": ("stroke_offset_rad", lambda _: Adjustment(stroke_offset_rad=np.True_)),
    "a speed of many numbers": ("forward_m_per_s", lambda f: f.trim(forward_m_per_s=LONG)),
    "bounds of many": ("bounds", lambda f: f.trim(bounds=[LONG] * 3)),
    "a list of many": ("air.stream_m_s", lambda f: f.set("air.stream_m_s", LONG)),
    "a trim in air with a memory": ("air", lambda f: f.with_air(Remembering()).trim()),
    "a pickled trim": ("trim", lambda f: pickle.dumps(f.trim())),
    "a pickled frame": ("frame", lambda f: pickle.dumps(f.start().frame)),
}


@pytest.mark.parametrize("name", BAD)
def test_refuses_in_few_words_with_key_and_remedy(blade, name):
    key, ask = BAD[name]
    with pytest.raises(wingbeat.CaseError) as caught:
        ask(blade)
    error = caught.value
    assert error.key.startswith(key) and error.remedy and str(error).count(error.remedy) == 1
    assert len(str(error)) < 700


def test_behaves_trims_and_frames_are_their_own_copies(blade):
    for kept in (blade.trim(), blade.start().frame):
        assert copy.copy(kept) is kept and copy.deepcopy([kept])[0] is kept


def test_behaves_a_trim_outside_its_bounds_says_so(blade):
    trim = blade.trim(bounds={"stroke_amplitude": (-0.01, 0.01)})
    assert trim.converged and "OUTSIDE its bounds (stroke_amplitude)" in repr(trim)
    assert "OUTSIDE" not in repr(blade.trim())


@pytest.mark.parametrize("given", [None, 1.5, [1.0]])
def test_behaves_a_function_without_numbers_by_name_is_the_reason_of_its_point(given):
    found = campaign.map(
        {"motion.frequency_hz": [200]}, campaign.Serial(), base="fruit-fly-blade", do=lambda _: given, keep={"a": "1"}
    )
    assert "do: the function gave" in found.reasons[0] and "a dict" in found.reasons[0]


def test_refuses_an_environment_that_another_thread_steps():
    envs, errors = VectorEnvironment(64), []
    envs.reset(seed=1)

    def step() -> None:
        try:
            for _ in range(40):
                envs.step(np.zeros((64, 4)))
        except wingbeat.CaseError as error:
            errors.append(error)

    threads = [threading.Thread(target=step) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert errors and errors[0].key == "environment" and "another thread" in str(errors[0]) and "Lock" in errors[0].remedy
    envs.step(np.zeros((64, 4)))


def test_refuses_an_environment_that_its_own_air_asks():
    """It would wait for itself."""
    envs: list[VectorEnvironment] = []
    told: list[str] = []

    def air(motions: wingbeat.Motions) -> np.ndarray:
        """Each wing is pushed along its normal by the square of the velocity across it at one point."""
        for env in envs:
            try:
                env.distances_m()
            except wingbeat.CaseError as error:
                told.append(str(error))
        loads = np.zeros((3, 6))
        loads[0, :3] = -1e-7 * motions.velocity_m_per_s[0]
        for wing, side in ((1, -1.0), (2, 1.0)):
            r_nw, w = motions.rotation[wing], motions.angular_velocity_rad_per_s[wing]
            velocity = motions.velocity_m_per_s[wing] + r_nw @ np.cross(w, [0.0, side * 1.6e-3, 0.0])
            normal = r_nw[:, 2]
            across = velocity @ normal
            force = -2.5e-6 * across * abs(across) * normal
            loads[wing] = [*force, *np.cross(r_nw @ [-1.75e-4, side * 1.6e-3, 0.0], force)]
        return loads

    air.is_steady_and_uniform = True
    envs.append(VectorEnvironment(2, flight=Flight.preset("fruit-fly-blade").with_air(air), steps_per_beat=20))
    envs[0].reset(seed=1)
    envs[0].step(np.zeros((2, 4)))
    assert told and "within their own step" in told[0]

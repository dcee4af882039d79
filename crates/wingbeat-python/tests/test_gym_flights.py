"""Environments that fly several flights in turn."""

from __future__ import annotations

import gc
import os
import pickle
import subprocess
import sys
import weakref

import gymnasium
import numpy as np
import pytest

import wingbeat
from wingbeat import Flight
from wingbeat.gym import Environment, SavedState, VectorEnvironment

FLY = Flight.preset("fruit-fly-blade")
LIGHT, HEAVY = (FLY.set({"body.mass_kg": m, "motion.frequency_hz": f}) for m, f in ((0.8e-6, 190.0), (1.1e-6, 215.0)))
LOCUST = Flight.preset("locust-blade")
FLIGHTS = [LIGHT, HEAVY, LOCUST]
"""Of other masses and wingbeats; one with four wings, whose episodes remember more."""
COUNT, SEED = 7, 30
KINDS = {
    "hover": {},
    "recover, noise and delay": {"task": "recover", "controls_per_beat": 2, "delay": 2, "tilt_noise_rad": 0.01, "beats": 4},
    "path": {"task": "path", "beats": 4, "autoreset_mode": "NextStep"},
    "gust": {"task": "gust", "beats": 4, "autoreset_mode": "SameStep", "amplitude_limit": 0.1, "copy": False},
}


def actions(step: int, count: int = COUNT) -> np.ndarray:
    return 0.4 * np.sin(step + np.arange(4.0 * count)).reshape(count, 4)


def followed(envs: VectorEnvironment, steps: range, given: slice = slice(None)) -> list[list[np.ndarray]]:
    """Observations, rewards, ends and distances, and what the regulator would do where there is one."""
    rows = []
    for k in steps:
        *seen, info = envs.step(actions(k)[given])
        seen.append(envs.distances_m())
        if envs._fleet._settings["controls_per_beat"] == 1 and not envs._fleet._settings["delay"]:
            seen.append(envs.regulated())
        if "final_obs" in info:
            seen += [row for row in info["final_obs"] if row is not None]
        rows.append([np.array(x) for x in seen])
    return rows


def same(one: list[list[np.ndarray]], other: list[list[np.ndarray]]) -> bool:
    return [[x.tobytes() for x in row] for row in one] == [[x.tobytes() for x in row] for row in other]


@pytest.mark.parametrize("name", KINDS)
def test_agrees_environments_with_those_of_each_flight_alone(name):
    """Environment k has the bits of an environment of flight k modulo 3 with the same seed."""
    envs = VectorEnvironment(COUNT, flight=FLIGHTS, **KINDS[name])
    first = np.array(envs.reset(seed=SEED)[0])
    rows = followed(envs, range(10))
    for k, flight in enumerate(FLIGHTS):
        every = slice(k, None, 3)
        of_one = VectorEnvironment(len(range(COUNT)[every]), flight=flight, **KINDS[name])
        np.testing.assert_array_equal(of_one.reset(seed=list(range(SEED, SEED + COUNT)[every]))[0], first[every])
        for several, alone in zip(rows, followed(of_one, range(10), every), strict=True):
            for x, y in zip(several[:5], alone[:5], strict=True):
                np.testing.assert_array_equal(x[every], y)
            if name in ("hover", "path"):
                np.testing.assert_array_equal(several[5][every], alone[5])
        assert set(envs.periods_s[every]) == {flight.period_s}
        np.testing.assert_array_equal(envs.wing_lengths_m[every], of_one.wing_lengths_m)
    assert len({row.tobytes() for row in rows[-1][0]}) == COUNT
    if name == "hover":
        single = Environment(flight=HEAVY)
        np.testing.assert_array_equal(single.reset(seed=SEED + 4)[0], first[4])
        for k in range(3):
            np.testing.assert_array_equal(single.step(actions(k)[4].astype(np.float32))[0], rows[k][0][4])


def test_exact_wingbeats_and_starts_are_of_each_flight():
    """Angular velocities at the start are parts of 1 / T of the flyer, the speed of the target one of R / T."""
    envs = VectorEnvironment(300, "path", flight=tuple(FLIGHTS))
    seen, _ = envs.reset(seed=1)
    np.testing.assert_allclose(seen[:, 12], 0.25132741, rtol=1e-6)  # 4 R at 2 pi in 100 T
    for k in range(3):
        assert 0.9 * 0.02 < abs(seen[k::3, 6:9]).max() < 1.01 * 0.02
    assert envs.periods_s[:3].tolist() == [f.period_s for f in FLIGHTS] and envs.periods_s[0] == 1 / 190.0
    assert envs.wing_lengths_m.shape == (300,) and envs.wing_lengths_m[2] > 10 * envs.wing_lengths_m[0]


def test_agrees_a_sequence_of_one_with_its_flight():
    one, other = (VectorEnvironment(3, flight=given, beats=3) for given in (HEAVY, [HEAVY]))
    one.reset(seed=SEED)
    other.reset(seed=SEED)
    assert same(followed(one, range(6), slice(3)), followed(other, range(6), slice(3)))
    assert other.restore(one.save()).shape == (3, 17)
    twice = VectorEnvironment(4, flight=[HEAVY, LIGHT, HEAVY])  # one flight more often than others
    assert twice.periods_s.tolist() == [f.period_s for f in (HEAVY, LIGHT, HEAVY, HEAVY)]


def test_behaves_any_number_of_threads_gives_the_same_bits():
    code = (
        "import hashlib, numpy, wingbeat.gym as g; from wingbeat import Flight; b = Flight.preset('fruit-fly-blade')\n"
        "flights = [b.set({'body.mass_kg': m, 'motion.frequency_hz': 1e8 * m + 110}) for m in (8e-7, 9e-7, 1e-6)]\n"
        "e = g.VectorEnvironment(13, 'gust', flight=[*flights, Flight.preset('locust-blade')], controls_per_beat=4)\n"
        "e.reset(seed=1); h = hashlib.sha256()\n"
        "for k in range(20): [h.update(x.tobytes()) for x in e.step(numpy.full((13, 4), 0.1 * numpy.sin(k)))[:4]]\n"
        "print(h.hexdigest())"
    )

    def bits(threads: str) -> str:
        environment = os.environ | {"RAYON_NUM_THREADS": threads}
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert bits("1") == bits("2") == bits("3")


def test_behaves_those_that_a_mask_chooses_begin_again():
    envs = VectorEnvironment(COUNT, flight=FLIGHTS, autoreset_mode="Disabled")
    envs.reset(seed=SEED)
    before = envs.step(actions(0))[0]
    mask = np.arange(COUNT) % 2 == 1
    after, _ = envs.reset(seed=SEED, options={"reset_mask": mask})
    fresh, _ = VectorEnvironment(COUNT, flight=FLIGHTS).reset(seed=SEED)
    np.testing.assert_array_equal(after[mask], fresh[mask])
    np.testing.assert_array_equal(after[~mask], before[~mask])


@pytest.mark.parametrize("name", KINDS)
def test_agrees_what_goes_on_from_a_state_with_what_was_saved(name):
    """In the same environments and in others, by a copy that was pickled, through ends of episodes."""
    envs = VectorEnvironment(COUNT, flight=FLIGHTS, **KINDS[name])
    envs.reset(seed=SEED)
    observed = np.array(followed(envs, range(3))[-1][0])
    state = pickle.loads(pickle.dumps(envs.save()))
    once = followed(envs, range(3, 12))
    for other in (envs, VectorEnvironment(COUNT, flight=FLIGHTS, **KINDS[name])):
        np.testing.assert_array_equal(other.restore(state), observed)
        assert same(followed(other, range(3, 12)), once)


def test_agrees_what_goes_on_where_one_regulator_remembers_more():
    """That of a fly whose abdomen is on a spring has the joint's states besides."""
    spring = Flight.preset("fruit-fly-abdomen-spring").set("air.model", "blade_element")
    envs = VectorEnvironment(COUNT, flight=[FLY, spring])
    envs.reset(seed=SEED)
    followed(envs, range(2))
    state = envs.save()
    assert not state.regulators[::2, -1].any() and state.regulators[1::2, -1].all()
    once = followed(envs, range(2, 6))
    envs.restore(state)
    assert same(followed(envs, range(2, 6)), once)


def test_refuses_states_of_other_flights():
    state = VectorEnvironment(3, flight=FLIGHTS).save()
    others = {
        r"another flight\[0\]": [HEAVY, LIGHT, LOCUST],
        r"another flight\[2\]": [LIGHT, HEAVY, FLY],
        "another number of flights, 3: here there are 2": [LIGHT, HEAVY],
        "another number of flights, 3: here there are 1": LIGHT,
    }
    for told, flights in others.items():
        with pytest.raises(wingbeat.CaseError, match=told) as caught:
            VectorEnvironment(3, flight=flights).restore(state)
        assert caught.value.key == "state" and caught.value.remedy
    for numbers in (state.numbers[:, :-1], np.hstack([state.numbers, state.numbers[:, :1]])):
        damaged = SavedState(state.settings, state.counts, numbers, state.regulators, state.generator)
        with pytest.raises(wingbeat.CaseError, match="other environments"):
            VectorEnvironment(3, flight=FLIGHTS).restore(damaged)


STEERED = FLY.with_controller(lambda _: wingbeat.Adjustment())
STILL = FLY.set("motion.frequency_hz", 20.0)
"""Too slow a wingbeat to carry its weight."""


@pytest.mark.parametrize(
    ("flights", "told", "key"),
    [
        ([], "without any", "flight"),
        ((), "without any", "flight"),
        ([FLY, "fruit-fly-blade"], r"flight\[1\] = 'fruit-fly-blade': no Flight", "flight"),
        ([FLY, [FLY]], r"flight\[1\]", "flight"),
        ({"a": FLY}, "no Flight", "flight"),
        ((f for f in FLIGHTS), "no Flight", "flight"),
        ([FLY, STEERED], r"flight\[1\] \(fruit-fly-blade\): it has a controller", "control.controller"),
        ([FLY, LIGHT, LOCUST.set("flight.mode", "tethered")], r"flight\[2\] \(locust-blade\): it is tethered", "flight.mode"),
        ([FLY.set("flight.held_beats", 3), FLY], r"flight\[0\] \(fruit-fly-blade\): its body is held", "flight.held_beats"),
        ([FLY, LIGHT, STILL, LOCUST, STILL], r"flight\[2\] \(fruit-fly-blade\): ", ""),
        ([LOCUST, FLY.set("air.model", "vortex_lattice")], r"flight\[1\] \(fruit-fly-blade\): air.model: the lattice has wakes", "air.model"),
    ],
)
def test_refuses_flights_by_number_and_name(flights, told, key):
    with pytest.raises(wingbeat.Error, match=told) as caught:
        VectorEnvironment(2, flight=flights)
    assert caught.value.key == key and caught.value.remedy


def test_refuses_several_flights_of_one_environment():
    for flights in (FLIGHTS, tuple(FLIGHTS), [FLY]):
        with pytest.raises(wingbeat.CaseError, match="this environment flies one") as caught:
            Environment(flight=flights)
        assert caught.value.key == "flight" and "VectorEnvironment" in caught.value.remedy


def test_behaves_gymnasium_hands_them_on():
    envs = gymnasium.make_vec("wingbeat/Hover-v0", 4, vectorization_mode="vector_entry_point", flight=FLIGHTS)
    assert envs.unwrapped.periods_s[:3].tolist() == [f.period_s for f in FLIGHTS]
    own = VectorEnvironment(4, flight=FLIGHTS)
    np.testing.assert_array_equal(envs.reset(seed=3)[0], own.reset(seed=3)[0])
    assert own.core_seconds(2) > 0.0


def test_refuses_regulators_that_one_flight_has_none_of():
    envs = VectorEnvironment(3, flight=FLIGHTS)
    envs._fleet._unregulated = 1
    with pytest.raises(wingbeat.AnalysisError, match=r"flight\[1\] \(fruit-fly-blade\): no regulator"):
        envs.regulated()
    for settings in ({"delay": 1}, {"controls_per_beat": 2}):
        with pytest.raises(wingbeat.AnalysisError, match="once per wingbeat"):
            VectorEnvironment(3, flight=FLIGHTS, **settings).regulated()


class Keeper:
    """An air that keeps the environments whose flyers fly in it: lift of the wings along b3, and damping."""

    is_steady_and_uniform = True

    def __init__(self, *others: Flight) -> None:
        own = FLY.set("flight.pitch_deg", 0.0).with_air(self)
        self.kept = VectorEnvironment(4, flight=[*others, own, *others])

    def __call__(self, motions: wingbeat.Motions) -> np.ndarray:
        loads = np.hstack([-1e-6 * motions.velocity_m_per_s, -1e-12 * motions.angular_velocity_rad_per_s])
        for k, side in ((1, 1.0), (2, -1.0)):
            rate = motions.angular_velocity_rad_per_s[k]
            lift = -2e-12 * (rate @ rate) * motions.rotation[0][:, 2]
            loads[k] += np.concatenate([lift, np.cross(motions.rotation[k] @ [0.0, 0.0015 * side, 0.0], lift)])
        return loads


@pytest.mark.parametrize("others", [[], [HEAVY], [LIGHT, LOCUST]], ids=len)
def test_behaves_an_object_is_freed_with_the_environments_that_it_keeps(others):
    keeper = Keeper(*others)
    keeper.kept.reset(seed=1)
    gc.collect()
    for k in range(3):
        assert np.isfinite(keeper.kept.step(0.1 * actions(k, 4))[0]).all()
    told = weakref.ref(keeper)
    gc.collect()
    assert told() is not None
    del keeper
    gc.collect()
    assert told() is None

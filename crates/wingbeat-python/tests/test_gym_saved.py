"""Environments that go on from a state that was saved."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import wingbeat
from wingbeat import Flight
from wingbeat.gym import Environment, SavedState, VectorEnvironment

NOISY = {"beats": 6, "delay": 2, "controls_per_beat": 2, "position_noise_m": 1e-5, "tilt_noise_rad": 0.01}
MADE = {
    "hover": lambda: VectorEnvironment(3),
    "noise and delay": lambda: VectorEnvironment(3, "recover", **NOISY),
    "gusts that begin again": lambda: VectorEnvironment(3, "gust", beats=5, autoreset_mode="SameStep"),
    "no copies": lambda: VectorEnvironment(3, "path", copy=False, autoreset_mode="Disabled"),
}


def followed(envs: VectorEnvironment, steps: range) -> list[bytes]:
    """Observations, rewards, ends, and what the regulator would do where there is one."""
    seen = []
    for k in steps:
        actions = 0.4 * np.sin(k + np.arange(12.0)).reshape(3, 4)
        seen += [np.asarray(x).tobytes() for x in envs.step(actions)[:4]]
        if envs._fleet._settings["controls_per_beat"] == 1:
            seen.append(envs.regulated().tobytes())
    return seen


@pytest.mark.parametrize("name", MADE)
@pytest.mark.parametrize("made", [0, 5])
def test_agrees_what_goes_on_from_a_state_with_what_was_saved(name, made):
    """In the same environments, in others, and in a copy that was pickled; through ends of episodes."""
    envs = MADE[name]()
    observed, _ = envs.reset(seed=4)
    for k in range(made):
        observed = envs.step(np.full((3, 4), 0.1 * k))[0]
    observed, draws = observed.copy(), envs.np_random.random
    state = envs.save()
    once, drawn = followed(envs, range(16)), draws()
    for other in (envs, MADE[name]()):
        for saved in (state, pickle.loads(pickle.dumps(state))):
            np.testing.assert_array_equal(other.restore(saved), observed)
            assert followed(other, range(16)) == once and other.np_random.random() == drawn
            assert other.np_random_seed == 4
    assert repr(state).startswith("<wingbeat.gym.SavedState of 3")


def test_behaves_actions_are_tried_from_one_state():
    env = Environment("recover")
    env.reset(seed=2)
    env.step(np.zeros(4))
    state, rewards = env.save(), []
    for action in (np.zeros(4), np.ones(4), np.zeros(4)):
        observed = env.restore(state)
        assert observed.shape == (17,)
        rewards.append(env.step(action)[1])
    assert rewards[0] == rewards[2] != rewards[1]
    fresh = Environment("recover")
    begun = fresh.save()  # before any seed
    first, seed = fresh.reset()[0], fresh.np_random_seed
    fresh.restore(begun)
    assert not np.array_equal(fresh.reset()[0], first) and fresh.np_random_seed != seed


def test_refuses_states_of_other_environments():
    state = VectorEnvironment(2).save()
    others = {
        "num_envs": VectorEnvironment(3),
        "task": VectorEnvironment(2, "gust"),
        "beats": VectorEnvironment(2, beats=7),
        "another flight": VectorEnvironment(2, flight=Flight.preset("fruit-fly-blade").set("motion.frequency_hz", 205)),
        "autoreset_mode": Environment(),
    }
    for told, envs in others.items():
        with pytest.raises(wingbeat.CaseError, match=told) as caught:
            envs.restore(state)
        assert caught.value.key == "state" and caught.value.remedy
    with pytest.raises(wingbeat.CaseError, match="what save"):
        Environment().restore(3)
    damaged = SavedState(state.settings, state.counts, state.numbers[:, :-1], state.regulators, state.generator)
    with pytest.raises(wingbeat.Error):
        VectorEnvironment(2).restore(damaged)

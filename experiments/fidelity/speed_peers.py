"""Measures the speed of the simulators and trainers that speed.py compares Treadmill with, in control steps per second.

Every function measures in the calling thread, whose cores the caller chooses.
"""

import time

import gymnasium
import mujoco
import mujoco.rollout
import numpy as np

from experiments.fidelity import body

RESET_NOISE = 0.01
FULL_PHYSICS = mujoco.mjtState.mjSTATE_FULLPHYSICS


def gymnasium_environment(seconds, seed):
    """Returns the speed of Gymnasium's Humanoid-v5 with random actions and resets, in its usual loop."""
    environment = gymnasium.make("Humanoid-v5", disable_env_checker=True)
    environment.reset(seed=seed)
    limit = body.CONTROL_LIMIT
    actions = np.random.default_rng(seed).uniform(-limit, limit, (4096, 17)).astype(np.float32)
    steps, begun = 0, time.perf_counter()
    while time.perf_counter() - begun < seconds:
        for action in actions[steps % 4096 : steps % 4096 + 64]:
            _, _, terminated, truncated, _ = environment.step(action)
            if terminated or truncated:
                environment.reset()
        steps += 64
    return steps / (time.perf_counter() - begun)


class EnvPool:
    """EnvPool's Humanoid-v5 with its C++ threads: 64 environments, all of them per call."""

    def __init__(self, environments=64, threads=2):
        import envpool

        self.pool = envpool.make("Humanoid-v5", env_type="gymnasium", num_envs=environments, num_threads=threads)
        limit = body.CONTROL_LIMIT
        self.actions = np.random.default_rng(1).uniform(-limit, limit, (256, environments, 17))
        self.pool.reset()

    def speed(self, seconds):
        """Returns the speed. A call that resets an environment is not a step of it."""
        steps, calls, ended = 0, 0, np.zeros(self.actions.shape[1], bool)
        begun = time.perf_counter()
        while time.perf_counter() - begun < seconds:
            _, _, terminated, truncated, _ = self.pool.step(self.actions[calls % 256])
            steps += np.count_nonzero(~ended)
            ended = terminated | truncated
            calls += 1
        return steps / (time.perf_counter() - begun)


class Rollouts:
    """Episodes with random controls, each until its fall, played by MuJoCo's own C++ loop `mujoco.rollout`.

    The lengths are found beforehand. Episodes of the same length are one call, which runs in the calling thread: 0 threads
    in mujoco.rollout's terms. So the simulated steps are those of a loop with resets, and Python takes part only once per
    call. Observation, reward and the reset itself are left out.
    """

    def __init__(self, model, integrator, substeps, healthy_m, episodes=256, steps_max=100):
        self.model, self.data = model, mujoco.MjData(model)
        model.opt.integrator = body.INTEGRATORS[integrator]
        model.opt.timestep = body.CONTROL_STEP_S / substeps
        self.pool = mujoco.rollout.Rollout(nthread=0)
        rng = np.random.default_rng(1)
        starts = np.array([self.start(rng) for _ in range(episodes)])
        low, high = model.actuator_ctrlrange.T
        controls = np.repeat(rng.uniform(low, high, (episodes, steps_max, model.nu)), substeps, axis=1)
        # The state begins with the time; the root's height is the third number of qpos.
        heights_m = self.play(starts, controls)[:, substeps - 1 :: substeps, 3]
        fallen = (heights_m <= healthy_m[0]) | (heights_m >= healthy_m[1])
        self.lengths = np.where(fallen.any(axis=1), fallen.argmax(axis=1) + 1, steps_max)
        self.batches = []
        for length in np.unique(self.lengths):
            those = self.lengths == length
            self.batches.append((starts[those], np.ascontiguousarray(controls[those, : length * substeps])))

    def start(self, rng):
        """Returns the state at the start of an episode: first keyframe or nominal pose, with the task's noise."""
        if self.model.nkey:
            mujoco.mj_resetDataKeyframe(self.model, self.data, 0)
        else:
            mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:] += rng.uniform(-RESET_NOISE, RESET_NOISE, self.model.nq)
        self.data.qvel[:] = rng.uniform(-RESET_NOISE, RESET_NOISE, self.model.nv)
        mujoco.mj_normalizeQuat(self.model, self.data.qpos)
        state = np.empty(mujoco.mj_stateSize(self.model, FULL_PHYSICS))
        mujoco.mj_getState(self.model, self.data, state, FULL_PHYSICS)
        return state

    def play(self, starts, controls):
        return self.pool.rollout(self.model, self.data, starts, controls)[0]

    def speed(self, seconds):
        """Returns the speed."""
        steps, begun = 0, time.perf_counter()
        while time.perf_counter() - begun < seconds:
            for starts, controls in self.batches:
                self.play(starts, controls)
            steps += int(self.lengths.sum())
        return steps / (time.perf_counter() - begun)


def stable_baselines(steps, cores):
    """Returns trained environment steps per second of Stable-Baselines3's PPO in its tutorial's form.

    PyTorch's default is one thread per core, which can be slower for networks this small, so the faster one counts.
    """
    import stable_baselines3
    import torch

    rates = []
    for threads in {1, cores}:
        torch.set_num_threads(threads)
        environment = gymnasium.make("Humanoid-v5")
        model = stable_baselines3.PPO("MlpPolicy", environment, device="cpu")
        begun = time.perf_counter()
        model.learn(total_timesteps=steps)
        rates.append(model.num_timesteps / (time.perf_counter() - begun))
        environment.close()
    return max(rates)

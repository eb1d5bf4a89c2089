"""Reads and evaluates a policy of `treadmill export --safetensors` with numpy only.

Needs: pip install numpy
"""

import json
import struct
import tomllib

import numpy as np

# First body and first degree of freedom in an observation kind; 0 is the world and the root.
FIRST_ROWS = {"compact": None, "gymnasium-v5": (1, 6), "gymnasium-v4": (0, 0)}


def read_safetensors(path):
    """Returns tensors by name and the metadata. Format: header length (8 bytes), JSON header, numbers."""
    with open(path, "rb") as file:
        content = file.read()
    (length,) = struct.unpack_from("<Q", content)
    if 8 + length > len(content):
        raise ValueError("not a complete safetensors file")
    header, data = json.loads(content[8 : 8 + length]), content[8 + length :]
    metadata = header.pop("__metadata__", {})
    kinds = {"F32": "<f4", "F64": "<f8"}
    tensors = {}
    for name, place in header.items():
        begin, end = place["data_offsets"]
        tensors[name] = np.frombuffer(data[begin:end], kinds[place["dtype"]]).reshape(place["shape"])
    return tensors, metadata


class Policy:
    """Deterministic policy: actions are the means."""

    def __init__(self, path):
        tensors, metadata = read_safetensors(path)
        self.facts = json.loads(metadata["treadmill"])
        if self.facts["format"] != 1 or self.facts["network"]["activation"] != "elu":
            raise ValueError(f"{path} has format {self.facts['format']}; this script reads only format 1 with ELU")
        self.kind = self.facts["observation"]["kind"]
        self.env = tomllib.loads(self.facts["settings"]).get("env", {})
        self.clip = np.float32(self.facts["observation"]["clip"])
        spread = np.sqrt(tensors["observation.variance"] + self.facts["observation"]["variance_epsilon"])
        self.mean, self.scale = tensors["observation.mean"].astype(np.float32), (1 / spread).astype(np.float32)
        count = len(self.facts["network"]["hidden"]) + 1
        self.layers = [(tensors[f"actor.{i}.weight"], tensors[f"actor.{i}.bias"]) for i in range(count)]
        self.low, self.high = (np.array(self.facts["action"][end], np.float32) for end in ("low", "high"))

    def means(self, observation):
        """Returns the network's output for one raw observation, in units of the action range."""
        x = np.clip((np.asarray(observation, np.float32) - self.mean) * self.scale, -self.clip, self.clip)
        for index, (weight, bias) in enumerate(self.layers):
            x = weight @ x + bias
            if index + 1 < len(self.layers):
                x = np.where(x > 0, x, np.expm1(np.minimum(x, 0)))
        return x

    def observe(self, data):
        """Returns the policy's observation of MuJoCo's state."""
        observation = observe(self.kind, data, self.env)
        if len(observation) != len(self.mean):
            raise ValueError(f"the policy observes {len(self.mean)} numbers, but this body has {len(observation)}")
        return observation

    def controls(self, observation):
        """Returns motor controls: means clipped to ±1 and scaled to [low, high]."""
        share = (np.clip(self.means(observation), -1, 1) + 1) / 2
        return self.low + share * (self.high - self.low)


def observe(kind, data, env=None):
    """Returns Treadmill's observation `kind` of MuJoCo's state, in single precision.

    `env` is the table of that name in an exported file. It says which parts are left out; missing keys have Gymnasium's
    defaults."""
    env = env or {}
    hidden = 2 if env.get("exclude_current_positions_from_observation", True) else 0
    parts = [data.qpos[hidden:], data.qvel]
    if kind not in FIRST_ROWS:
        raise ValueError(f"unknown observation kind {kind!r}; known: {', '.join(FIRST_ROWS)}")
    if kind != "compact":
        first_body, first_dof = FIRST_ROWS[kind]
        derived = {
            "cinert": data.cinert[first_body:],
            "cvel": data.cvel[first_body:],
            "qfrc_actuator": data.qfrc_actuator[first_dof:],
            "cfrc_ext": data.cfrc_ext[first_body:],
        }
        parts += [part for name, part in derived.items() if env.get(f"include_{name}_in_observation", True)]
    return np.concatenate([np.ravel(part) for part in parts]).astype(np.float32)

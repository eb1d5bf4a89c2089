"""Evaluates a policy bundle or an exported policy in numpy, as the Rust crate common/policy does."""

import hashlib
import json

import numpy as np

LOG_STD_MIN, LOG_STD_MAX = -5.0, 2.0
HALF_LN_TAU = np.float32(0.9189385)
_DTYPES = {"F32": np.dtype("<f4"), "F64": np.dtype("<f8")}


class PolicyError(Exception):
    """A policy bundle or file is unusable."""


def read_safetensors(data):
    """Returns tensors by name and the metadata. Format: header length (8 bytes), JSON header, numbers."""
    try:
        length = int.from_bytes(data[:8], "little")
        header = json.loads(bytes(data[8 : 8 + length]))
        numbers = memoryview(data)[8 + length :]
        metadata = header.pop("__metadata__", {})
        tensors = {}
        for name, entry in header.items():
            start, end = entry["data_offsets"]
            tensors[name] = np.frombuffer(numbers[start:end], _DTYPES[entry["dtype"]]).reshape(entry["shape"])
    except (ValueError, KeyError, TypeError) as why:
        raise PolicyError(f"the weights are not safetensors data: {why}") from why
    return tensors, metadata


def checksum(data):
    """Returns the checksum of weights in a bundle: the first eight bytes of SHA-256 over length and data."""
    return int.from_bytes(hashlib.sha256(len(data).to_bytes(8, "little") + data).digest()[:8], "little")


class Policy:
    """Diagonal Gaussian over actions; the actor network computes the means."""

    def __init__(self, tensors, mean, inverse_std, clip):
        count = sum(1 for name in tensors if name.startswith("actor.") and name.endswith(".weight"))
        if count == 0 or "log_std" not in tensors:
            raise PolicyError("the weights have no tensors actor.N.weight and log_std")
        # Transposed once: observations are rows.
        self.layers = [
            (np.ascontiguousarray(tensors[f"actor.{index}.weight"].T), tensors[f"actor.{index}.bias"])
            for index in range(count)
        ]
        self.log_std = np.clip(tensors["log_std"], LOG_STD_MIN, LOG_STD_MAX).astype(np.float32)
        self.std = np.exp(self.log_std)
        self.mean, self.inverse_std = np.asarray(mean, np.float32), np.asarray(inverse_std, np.float32)
        self.clip = np.float32(clip)
        self.observation_size, self.action_size = self.layers[0][0].shape[0], self.layers[-1][0].shape[1]
        if self.mean.shape != (self.observation_size,) or self.log_std.shape != (self.action_size,):
            raise PolicyError(
                f"statistics of {self.mean.shape} and log_std of {self.log_std.shape} do not fit a network for "
                f"{self.observation_size} observations and {self.action_size} actions"
            )

    @classmethod
    def from_bundle(cls, bundle):
        """Reads a PolicyBundle. Raises PolicyError if the checksum differs."""
        if checksum(bundle.weights) != bundle.checksum:
            raise PolicyError("checksum of the weights differs from the bundle's")
        tensors, _ = read_safetensors(bundle.weights)
        mean = np.frombuffer(bundle.observation_mean, "<f4")
        inverse_std = np.frombuffer(bundle.observation_inverse_std, "<f4")
        return cls(tensors, mean, inverse_std, bundle.observation_clip)

    @classmethod
    def from_export(cls, data):
        """Reads a file of `treadmill export --safetensors`. Returns the policy and its metadata (task, action ranges, …)."""
        tensors, metadata = read_safetensors(data)
        if "treadmill" not in metadata:
            raise PolicyError("the file has no `treadmill` metadata; make it with `treadmill export --safetensors`")
        facts = json.loads(metadata["treadmill"])
        observation = facts["observation"]
        deviation = np.sqrt(tensors["observation.variance"] + observation["variance_epsilon"])
        return cls(tensors, tensors["observation.mean"], 1.0 / deviation, observation["clip"]), facts

    def means(self, observations):
        """Returns action means [rows, action] of raw observations [rows, observation]."""
        x = np.clip((observations - self.mean) * self.inverse_std, -self.clip, self.clip)
        for index, (weight, bias) in enumerate(self.layers):
            x = x @ weight + bias
            if index + 1 < len(self.layers):
                # ELU; np.where evaluates both branches, so minimum() prevents overflow.
                x = np.where(x > 0, x, np.expm1(np.minimum(x, 0)))
        return x

    def log_prob(self, actions, means):
        """Returns log-probability densities [rows] of unclipped actions."""
        z = (actions - means) / self.std
        return np.sum(-0.5 * z * z - self.log_std - HALF_LN_TAU, axis=1, dtype=np.float32)

    def sample(self, observations, normals):
        """Returns actions and their log-probabilities; `normals` are standard normal, [rows, action]."""
        means = self.means(observations)
        actions = (means + self.std * normals).astype(np.float32)
        return actions, self.log_prob(actions, means)

"""Configuration keys that an actor needs, from the TOML in a policy bundle."""

import tomllib
from dataclasses import dataclass

from .task import TaskError


@dataclass(frozen=True)
class Settings:
    """Settings of one run."""

    fragment_steps: int
    fragments_in_flight: int
    receipt_timeout_s: float
    policy_poll_s: float
    stats_every_s: float
    task: str

    @classmethod
    def of(cls, bundle):
        """Reads a PolicyBundle. Raises TaskError for a retired key that has an effect."""
        config = tomllib.loads(bundle.config_toml)
        rollout, bus = config["rollout"], config["bus"]
        in_flight = rollout["max_in_flight"] or (1 if config["learner"]["mode"] == "sync" else 2)
        correlation = rollout.get("noise_correlation", 0.0)
        if correlation != 0.0:
            raise TaskError(
                f"config key `rollout.noise_correlation` is {correlation}, but the key no longer exists; start a run "
                "without it, or use the learner's version of treadmill_actor"
            )
        return cls(
            fragment_steps=rollout["fragment_steps"],
            fragments_in_flight=in_flight,
            receipt_timeout_s=bus["receipt_timeout_ms"] / 1e3,
            policy_poll_s=bus["policy_poll_ms"] / 1e3,
            stats_every_s=bus["stats_every_ms"] / 1e3,
            task=config.get("task", {}).get("name", ""),
        )

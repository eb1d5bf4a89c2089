"""The part of a run's configuration that an actor needs, out of the bundle's TOML."""

import tomllib
from dataclasses import dataclass

from .task import TaskError


@dataclass(frozen=True)
class Settings:
    """Settings with the learner's names."""

    fragment_steps: int
    fragments_in_flight: int
    receipt_timeout_s: float
    policy_poll_s: float
    stats_every_s: float
    task: str

    @classmethod
    def of(cls, bundle):
        """Of a PolicyBundle."""
        config = tomllib.loads(bundle.config_toml)
        rollout, bus = config["rollout"], config["bus"]
        in_flight = rollout["max_in_flight"] or (1 if config["learner"]["mode"] == "sync" else 2)
        correlation = rollout.get("noise_correlation", 0.0)
        if correlation != 0.0:
            raise TaskError(
                f"config key `rollout.noise_correlation` is {correlation}, but the key no longer exists; begin a run "
                "without it, or use the treadmill_actor of the learner's version"
            )
        return cls(
            fragment_steps=rollout["fragment_steps"],
            fragments_in_flight=in_flight,
            receipt_timeout_s=bus["receipt_timeout_ms"] / 1e3,
            policy_poll_s=bus["policy_poll_ms"] / 1e3,
            stats_every_s=bus["stats_every_ms"] / 1e3,
            task=config.get("task", {}).get("name", ""),
        )

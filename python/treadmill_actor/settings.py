"""The part of a run's configuration that an actor needs, out of the bundle's TOML."""

import tomllib
from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """Settings with the learner's names."""

    fragment_steps: int
    fragments_in_flight: int
    noise_correlation: float
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
        return cls(
            fragment_steps=rollout["fragment_steps"],
            fragments_in_flight=in_flight,
            noise_correlation=rollout.get("noise_correlation", 0.0),
            receipt_timeout_s=bus["receipt_timeout_ms"] / 1e3,
            policy_poll_s=bus["policy_poll_ms"] / 1e3,
            stats_every_s=bus["stats_every_ms"] / 1e3,
            task=config.get("task", {}).get("name", ""),
        )

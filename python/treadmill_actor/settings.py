"""Configuration keys that an actor needs, from the TOML in a policy bundle. Other keys and sections are ignored."""

import tomllib
from dataclasses import dataclass

from .schema import WIRE_VERSION
from .task import TaskError

#: Steps of a fragment if neither the learner nor the configuration says.
FRAGMENT_STEPS = 128
FRAGMENT_STEPS_MAX = 4096


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
        """Reads a PolicyBundle. Raises TaskError for a value or a wire version that this actor does not know."""
        if bundle.wire_version_min > WIRE_VERSION:
            raise TaskError(
                f"run `{bundle.run}` needs actors of wire version {bundle.wire_version_min}, this actor has "
                f"{WIRE_VERSION}; use the learner's version of treadmill_actor"
            )
        config = tomllib.loads(bundle.config_toml)
        mode = _choice(config, "learner.mode", ("sync", "async"))
        in_flight = _choice(config, "rollout.max_in_flight", (0, 1, 2))
        steps = _choice(config, "rollout.fragment_steps", range(FRAGMENT_STEPS_MAX + 1))
        milliseconds = range(1, 3_600_001)
        return cls(
            fragment_steps=steps or FRAGMENT_STEPS,
            fragments_in_flight=in_flight or (1 if mode == "sync" else 2),
            receipt_timeout_s=_choice(config, "bus.receipt_timeout_ms", milliseconds) / 1e3,
            policy_poll_s=_choice(config, "bus.policy_poll_ms", milliseconds) / 1e3,
            stats_every_s=_choice(config, "bus.stats_every_ms", milliseconds) / 1e3,
            task=config.get("task", {}).get("name", ""),
        )

    def next_fragment_steps(self, receipt_steps, bundle_steps):
        """Returns the steps of the next fragment: as the last receipt says, else the bundle, else the configuration."""
        return min(receipt_steps or bundle_steps or self.fragment_steps, FRAGMENT_STEPS_MAX)


def _choice(config, key, allowed):
    section, name = key.split(".")
    value = config.get(section, {}).get(name)
    # In Python, True equals 1 and 1.0 does too.
    if type(value) is not type(allowed[0]) or value not in allowed:
        shown = f"{allowed.start} to {allowed.stop - 1}" if isinstance(allowed, range) else ", ".join(map(repr, allowed))
        raise TaskError(f"config key `{key}` is {value!r}; allowed: {shown}; use the learner's version of treadmill_actor")
    return value

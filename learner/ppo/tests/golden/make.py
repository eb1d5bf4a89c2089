#!/usr/bin/env python3
"""Writes the JSON files in this folder: the results of PyTorch and numpy for the learner's mathematics.

    pip install torch numpy
    python3 learner/ppo/tests/golden/make.py

Plain PyTorch computes everything in double precision from inputs that are exact in single precision: modules,
torch.distributions, torch.optim.Adam, torch.nn.utils.clip_grad_norm_. Advantages follow the definition by n-step
returns, not a recursion. The script reads `order.json`, the order in which the learner's seeded shuffle takes the rows
of a batch. If that order changes, a test fails and prints the new one.

| file | content |
|---|---|
| advantages.json | generalised advantage estimation over episodes with every kind of end |
| loss.json | the PPO loss, its parts and its gradient |
| adam.json | gradient clipping and Adam, step by step |
| moments.json | running mean and variance, and normalisation by them |
| update.json | whole PPO updates: one gradient step, and several epochs of minibatches |
"""

import json
import pathlib

import numpy as np
import torch

HERE = pathlib.Path(__file__).resolve().parent
SEED = 20250311

torch.set_default_dtype(torch.float64)


def single(numbers):
    """Rounds to single precision; returns double precision."""
    return np.asarray(numbers).astype(np.float32).astype(np.float64)


def plain(value):
    """Converts to types that JSON has; numbers keep eleven digits, more than single precision has."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, torch.Tensor):
        value = value.detach().numpy()
    if isinstance(value, np.ndarray):
        value = value.ravel().tolist() if value.ndim else value.item()
    if isinstance(value, (list, tuple)):
        return [plain(entry) for entry in value]
    return float(f"{value:.11g}") if isinstance(value, float) else value


def write(name, content):
    path = HERE / name
    path.write_text(json.dumps(plain(content), separators=(",", ":")).replace('],"', '],\n"') + "\n", encoding="utf-8")
    print(f"{name}: {path.stat().st_size} bytes")


def lambda_return(rewards, values_after, gamma, lam):
    """The λ-return of the first of these steps: n-step returns weighted by (1 − λ) λⁿ⁻¹, the longest by the rest."""
    total, weight_left = 0.0, 1.0
    for n in range(1, len(rewards) + 1):
        n_step = sum(gamma**k * rewards[k] for k in range(n)) + gamma**n * values_after[n - 1]
        weight = weight_left if n == len(rewards) else weight_left * (1 - lam)
        total += weight * n_step
        weight_left -= weight
    return total


def advantages(random):
    steps, envs, gamma, lam = 24, 4, 0.99, 0.95
    rewards, values = single(random.normal(size=(steps, envs))), single(3 * random.normal(size=(steps, envs)))
    last = single(3 * random.normal(size=envs))
    terminated, truncated = np.zeros((steps, envs), bool), np.zeros((steps, envs), bool)
    # Ends in the middle, in sequence, on the same step, in the first and last row; one environment never ends.
    terminated[[5, 6, 17], 0] = True
    truncated[[3, 11, 23], 1] = True
    terminated[[0, 9, 23], 2] = True
    truncated[[4, 9, 16], 2] = True
    reached = single(3 * random.normal(size=(steps, envs)))
    only_truncated = truncated & ~terminated
    after = np.vstack([values[1:], last])
    after[only_truncated] = reached[only_truncated]
    after[terminated] = 0
    found = np.zeros((steps, envs))
    for env in range(envs):
        for first in range(steps):
            end = next((t for t in range(first, steps) if terminated[t, env] or truncated[t, env]), steps - 1)
            part = slice(first, end + 1)
            found[first, env] = lambda_return(rewards[part, env], after[part, env], gamma, lam)
    write("advantages.json", {
        "envs": envs, "gamma": gamma, "lambda": lam, "rewards": rewards, "values": values,
        "terminated": terminated, "truncated": truncated, "truncated_values": reached[only_truncated],
        "final_values": last, "next_values": after, "advantages": found - values, "returns": found,
    })


LOSS = {
    "clip_range": 0.2, "value_coefficient": 0.7, "entropy_coefficient": 0.01, "bounds_coefficient": 0.05,
    "bounds_limit": 1.1,
}


def loss_parts(means, values, log_std, actions, old_log_probs, normalised, returns, config):
    """The loss of one minibatch by torch.distributions."""
    policy = torch.distributions.Normal(means, log_std.exp().expand_as(means))
    log_ratio = policy.log_prob(actions).sum(1) - old_log_probs
    ratio = log_ratio.exp()
    clipped = torch.clamp(ratio, 1 - config["clip_range"], 1 + config["clip_range"])
    parts = {
        "policy": torch.max(-normalised * ratio, -normalised * clipped).mean(),
        "value": 0.5 * torch.nn.functional.mse_loss(values, returns),
        "entropy": policy.entropy().sum(1).mean(),
        "bounds": torch.relu(means.abs() - config["bounds_limit"]).square().sum(1).mean(),
    }
    parts["total"] = (
        parts["policy"] + config["value_coefficient"] * parts["value"]
        - config["entropy_coefficient"] * parts["entropy"] + config["bounds_coefficient"] * parts["bounds"]
    )
    return parts, log_ratio.detach()


def loss(random):
    rows, count = 20, 3
    output = torch.tensor(single(random.normal(size=(rows, count + 1))), requires_grad=True)
    log_std = torch.tensor(single(random.normal(-0.5, 0.3, size=count)), requires_grad=True)
    with torch.no_grad():
        spread = torch.tensor(random.normal(size=(rows, count)))
        actions = torch.tensor(single(output[:, :count] + log_std.exp() * spread))
        exact = torch.distributions.Normal(output[:, :count], log_std.exp()).log_prob(actions).sum(1)
    given = {
        "actions": actions,
        "log_probs": torch.tensor(single(exact.numpy() + 0.3 * random.normal(size=rows))),
        "advantages": torch.tensor(single(random.normal(size=rows))),
        "returns": torch.tensor(single(random.normal(size=rows))),
    }
    parts, log_ratio = loss_parts(output[:, :count], output[:, count], log_std, *given.values(), LOSS)
    parts["total"].backward()
    write("loss.json", {
        "config": LOSS, "output": output, "log_std": log_std, **given, "parts": parts, "log_ratio": log_ratio,
        "output_gradient": output.grad, "log_std_gradient": log_std.grad,
    })


def adam(random):
    count, max_norm = 37, 1.0
    parameter = torch.nn.Parameter(torch.tensor(single(random.normal(size=count))))
    optimiser = torch.optim.Adam([parameter], lr=1.0)
    start, steps = parameter.detach().clone(), []
    # Norms from far below to far above the limit.
    for number, size in enumerate([0.05, 1.0, 0.1, 30.0, 0.16, 1e-4, 0.3, 1.0]):
        gradient, rate = single(size * random.normal(size=count)), 0.01 * 1.5 ** (number % 3)
        parameter.grad = torch.tensor(gradient)
        norm = torch.nn.utils.clip_grad_norm_([parameter], max_norm)
        optimiser.param_groups[0]["lr"] = rate
        optimiser.step()
        steps.append({
            "gradient": gradient, "learning_rate": rate, "norm": norm.item(), "parameters": parameter.detach().clone(),
        })
    state = optimiser.state[parameter]
    write("adam.json", {
        "max_norm": max_norm, "start": start, "steps": steps,
        "first_moment": state["exp_avg"], "second_moment": state["exp_avg_sq"],
    })


def moments(random):
    columns, clip, epsilon = 5, 3.0, 1e-5
    centre, width = np.array([0.0, -3.0, 1000.0, 8.9, 1e-3]), np.array([1.0, 0.1, 50.0, 0.0, 2e-3])
    parts = [single(centre + width * random.normal(size=(rows, columns))) for rows in (7, 64, 1, 30)]
    whole = np.vstack(parts)
    rows = single(centre + np.maximum(width, 1e-3) * 2 * random.normal(size=(12, columns)))
    normalised = np.clip((rows - whole.mean(0)) / np.sqrt(whole.var(0) + epsilon), -clip, clip)
    scalars = single(random.normal(40, 12, size=50))
    write("moments.json", {
        "columns": columns, "parts": parts, "mean": whole.mean(0), "variance": whole.var(0),
        "clip": clip, "rows": rows, "normalised": normalised,
        "scalars": scalars, "scalars_normalised": (scalars - scalars.mean()) / np.sqrt(scalars.var() + (1e-4 * scalars.mean()) ** 2),
    })


OBSERVATION, ACTION, HIDDEN = 6, 2, (16, 8)


def network(outputs):
    widths, layers = (OBSERVATION, *HIDDEN), []
    for before, after in zip(widths, widths[1:]):
        layers += [torch.nn.Linear(before, after), torch.nn.ELU()]
    return torch.nn.Sequential(*layers, torch.nn.Linear(widths[-1], outputs))


class Agent:
    """Actor, log std and critic, as separate modules; `flat` is the learner's order of parameters."""

    def __init__(self, numbers):
        self.actor, self.critic = network(ACTION), network(1)
        self.log_std = torch.nn.Parameter(torch.zeros(ACTION))
        self.parameters = [*self.actor.parameters(), self.log_std, *self.critic.parameters()]
        place = 0
        with torch.no_grad():
            for parameter in self.parameters:
                parameter.copy_(torch.tensor(numbers[place : place + parameter.numel()]).view_as(parameter))
                place += parameter.numel()
        assert place == len(numbers)

    def flat(self, of=lambda parameter: parameter):
        return torch.cat([of(parameter).detach().ravel() for parameter in self.parameters])


def start_parameters(random):
    """Larger than initial parameters, so that some means are out of bounds and every gradient is well above rounding."""
    sizes = []
    for outputs in (ACTION, 1):
        widths = (OBSERVATION, *HIDDEN, outputs)
        for before, after in zip(widths, widths[1:]):
            sizes += [(before * after, 1 / before**0.5), (after, 0.1)]
        if outputs == ACTION:
            sizes.append((ACTION, 0.3))
    return single(np.concatenate([spread * random.normal(size=count) for count, spread in sizes]))


def synthetic_batch(agent, rows, random):
    """A batch acted by a policy slightly older than the agent's, as from an actor that lags."""
    observations = torch.tensor(single(random.normal(size=(rows, OBSERVATION))))
    with torch.no_grad():
        policy = torch.distributions.Normal(agent.actor(observations), agent.log_std.exp())
        actions = torch.tensor(single(policy.mean + policy.stddev * torch.tensor(random.normal(size=(rows, ACTION)))))
        log_probs = policy.log_prob(actions).sum(1) + 0.05 * torch.tensor(random.normal(size=rows))
        values = agent.critic(observations).squeeze(1)
    returns = 0.5 * values.numpy() + 0.4 * observations[:, 0].numpy() + 0.1 * random.normal(size=rows)
    return {
        "observations": observations, "actions": actions, "means": torch.tensor(single(policy.mean)),
        "log_probs": torch.tensor(single(log_probs)),
        "advantages": torch.tensor(single(5 * random.normal(size=rows) + 2)), "returns": torch.tensor(single(returns)),
        "values": torch.tensor(single(values)),
    }


def update(agent, batch, orders, config):
    """One PPO update in plain PyTorch; returns its statistics."""
    optimiser = torch.optim.Adam(agent.parameters, lr=config["learning_rate"], eps=1e-8)
    given, rate = batch["advantages"], config["learning_rate"]
    normalised = (given - given.mean()) / (given.std(correction=0) + 1e-8)
    rows, steps, rates, clip_fractions = len(given), [], [], []

    def policy():
        with torch.no_grad():
            return torch.distributions.Normal(agent.actor(batch["observations"]), agent.log_std.exp())

    before = policy()
    for order in orders:
        clipped = 0
        # The number of minibatches whose size is nearest to the configured one; sizes differ by at most one row.
        count = max(1, int(rows / config["minibatch"] + 0.5))
        for i in range(count):
            some = torch.tensor(order[rows * i // count : rows * (i + 1) // count])
            seen = batch["observations"][some]
            parts, log_ratio = loss_parts(
                agent.actor(seen), agent.critic(seen).squeeze(1), agent.log_std,
                batch["actions"][some], batch["log_probs"][some], normalised[some], batch["returns"][some], config,
            )
            optimiser.zero_grad()
            parts["total"].backward()
            parts["norm"] = torch.nn.utils.clip_grad_norm_(agent.parameters, config["max_grad_norm"])
            for group in optimiser.param_groups:
                group["lr"] = rate
            optimiser.step()
            steps.append({"rows": len(some)} | {name: part.item() for name, part in parts.items()})
            ratio = log_ratio.exp()
            clipped += ((ratio - 1).abs() > config["clip_range"]).sum().item()
        kl = torch.distributions.kl_divergence(before, policy()).sum(1).mean().item()
        clip_fractions.append(clipped / rows)
        if config["target_kl"] > 0 and kl > 2 * config["target_kl"]:
            rate = max(rate / 1.5, config["learning_rate_min"])
        elif config["target_kl"] > 0 and kl < config["target_kl"] / 2:
            rate = min(rate * 1.5, config["learning_rate_max"])
        rates.append((kl, rate))
    residual = batch["returns"] - batch["values"]

    def mean(name):
        return np.average([step[name] for step in steps], weights=[step["rows"] for step in steps])

    stats = {
        "policy_loss": mean("policy"), "value_loss": mean("value"), "entropy": mean("entropy"),
        "bounds_loss": mean("bounds"), "grad_norm": mean("norm"), "approx_kl": kl,
        "clip_fraction": np.mean(clip_fractions), "learning_rate": rate,
        "explained_variance": 1 - (residual.var() / batch["returns"].var()).item(),
        "std": agent.log_std.exp().mean().item(),
    }
    state = optimiser.state
    return {
        "gradient_steps": len(steps), "stats": stats, "parameters": agent.flat(),
        "first_moment": agent.flat(lambda parameter: state[parameter]["exp_avg"]),
        "second_moment": agent.flat(lambda parameter: state[parameter]["exp_avg_sq"]),
    }, rates


def updates(random):
    given = json.loads((HERE / "order.json").read_text(encoding="utf-8"))
    start = start_parameters(random)
    batch = synthetic_batch(Agent(start), given["rows"], random)
    common = {
        **LOSS, "max_grad_norm": 0.5, "learning_rate": 1.4e-3, "learning_rate_min": 1e-5, "learning_rate_max": 1.5e-3,
    }
    whole = {**common, "minibatch": 22, "epochs": len(given["orders"]), "target_kl": 0.004}
    rising = {**whole, "learning_rate": 3e-4, "learning_rate_max": 8e-4, "target_kl": 0.008}
    one = {**common, "minibatch": given["rows"], "epochs": 1, "target_kl": 0.0}
    cases = []
    for config in (one, whole, rising):
        found, rates = update(Agent(start), batch, given["orders"][: config["epochs"]], config)
        print("KL and learning rate after each epoch:", ", ".join(f"{kl:.4f} {rate:.2e}" for kl, rate in rates))
        print(" ", {name: float(f"{value:.3g}") for name, value in found["stats"].items()})
        cases.append({"config": config, "seed": given["seed"], **found})
    write("update.json", {
        "observation": OBSERVATION, "action": ACTION, "hidden": HIDDEN, "parameters": start, "batch": batch,
        "one_step": cases[0], "whole": cases[1],
        "rising": cases[2],
    })


def main():
    for number, make in enumerate((advantages, loss, adam, moments, updates)):
        make(np.random.default_rng([SEED, number]))


if __name__ == "__main__":
    main()

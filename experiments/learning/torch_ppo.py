"""PPO update and policy in PyTorch, optimised for CPUs; speed.py compares Treadmill with them.

Needs: pip install torch
"""

import itertools
import math
import time

import torch
from torch import nn

ACTIONS = 17
EPOCHS = 5
CLIP_RANGE, BOUNDS_LIMIT = 0.2, 1.1
BOUNDS_COEFFICIENT, MAX_GRAD_NORM, LEARNING_RATE = 5e-4, 1.0, 3e-4


class ExpElu(torch.autograd.Function):
    """ELU by exp, which PyTorch vectorises better than expm1: faster, but less exact near 0."""

    @staticmethod
    def forward(context, x):
        y = torch.exp(x.clamp(max=0)).sub_(1)
        torch.maximum(x, y, out=y)
        context.save_for_backward(y)
        return y

    @staticmethod
    def backward(context, gradient):
        (y,) = context.saved_tensors
        return gradient * y.clamp(max=0).add_(1)


class HandMadeElu(nn.Module):
    """Module of ExpElu."""

    def forward(self, x):
        return ExpElu.apply(x)


def mlp(widths, outputs, elu):
    """Returns an MLP; `widths` holds the input and hidden sizes."""
    layers = [[nn.Linear(before, after), elu()] for before, after in itertools.pairwise(widths)]
    return nn.Sequential(*itertools.chain(*layers), nn.Linear(widths[-1], outputs))


def random_batch(observation, rows):
    """Returns a batch of random numbers, like the one of `treadmill bench update`."""
    actions, log_std = torch.randn(rows, ACTIONS), torch.full((ACTIONS,), -0.5)
    return {
        "observations": torch.randn(rows, observation),
        "actions": actions,
        "log_probs": torch.distributions.Normal(torch.zeros(ACTIONS), log_std.exp()).log_prob(actions).sum(1),
        "advantages": torch.randn(rows),
        "returns": torch.randn(rows),
    }


class Learner:
    """Separate actor and critic with fused Adam."""

    def __init__(self, widths, elu):
        self.actor, self.critic = mlp(widths, ACTIONS, elu), mlp(widths, 1, elu)
        self.log_std = nn.Parameter(torch.full((ACTIONS,), -0.5))
        self.parameters = [*self.actor.parameters(), self.log_std, *self.critic.parameters()]
        self.optimiser = torch.optim.Adam(self.parameters, lr=LEARNING_RATE, fused=True)

    def loss(self, observations, actions, log_probs, advantages, returns):
        """Returns the total loss, and the KL estimate summed over rows."""
        means, values = self.actor(observations), self.critic(observations).squeeze(1)
        # torch.distributions would be slower.
        distance = (actions - means) * torch.exp(-self.log_std)
        constant = self.log_std.sum() + 0.5 * math.log(2 * math.pi) * ACTIONS
        log_ratio = -0.5 * distance.square().sum(1) - constant - log_probs
        ratio = log_ratio.exp()
        clipped = ratio.clamp(1 - CLIP_RANGE, 1 + CLIP_RANGE)
        policy = -torch.minimum(ratio * advantages, clipped * advantages).mean()
        value = 0.5 * nn.functional.mse_loss(values, returns)
        bounds = torch.relu(means.abs() - BOUNDS_LIMIT).square().sum(1).mean()
        with torch.no_grad():
            kl = (ratio - 1 - log_ratio).sum()
        return policy + value + BOUNDS_COEFFICIENT * bounds, kl

    def update(self, batch, minibatch):
        """Makes EPOCHS passes over the batch in random order. Returns the number of processed rows."""
        rows = len(batch["returns"])
        given = batch["advantages"]
        planes = {**batch, "advantages": (given - given.mean()) / (given.std() + 1e-8)}
        for _ in range(EPOCHS):
            kl = torch.zeros(())
            for some in torch.randperm(rows).split(minibatch):
                loss, part = self.loss(*(plane[some] for plane in planes.values()))
                kl += part
                self.optimiser.zero_grad(set_to_none=True)
                loss.backward()
                nn.utils.clip_grad_norm_(self.parameters, MAX_GRAD_NORM, foreach=True)
                self.optimiser.step()
            # An adaptive learning rate would read the KL divergence here.
            kl.item()
        return rows * EPOCHS


def samples_per_s(widths, minibatch, updates, elu=nn.ELU):
    """Returns samples per second of the update, after one warm-up update."""
    learner, batch = Learner(widths, elu), random_batch(widths[0], 4 * minibatch)
    learner.update(batch, minibatch)
    begun = time.perf_counter()
    samples = sum(learner.update(batch, minibatch) for _ in range(updates))
    return samples / (time.perf_counter() - begun)


@torch.inference_mode()
def call_us(widths, rows, calls, elu=nn.ELU):
    """Returns microseconds per actor call with `rows` rows, without conversions from and to numpy."""
    actor, observations = mlp(widths, ACTIONS, elu), torch.randn(rows, widths[0])
    for _ in range(100):
        actor(observations)
    begun = time.perf_counter()
    for _ in range(calls):
        actor(observations)
    return (time.perf_counter() - begun) * 1e6 / calls

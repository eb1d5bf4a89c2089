"""Prints samples per second of PyTorch's PPO update on a GPU; measure.py compares Treadmill with it.

Needs: pip install torch
Usage: python3 -m experiments.accelerator.torch_update 45-256-128 2048 [eager | graph]
"""

import json
import sys
import time

import torch

from experiments.learning import torch_ppo

UPDATES = 10
WARM_UP_STEPS = 5


def graphed(learner, batch, minibatch):
    """Returns an update whose gradient step is one CUDA graph, as PyTorch's notes on whole-network capture have it."""
    learner.optimiser = torch.optim.Adam(learner.parameters, lr=torch_ppo.LEARNING_RATE, fused=True, capturable=True)
    rows = torch.zeros(minibatch, dtype=torch.long)

    def step():
        loss, _ = learner.loss(*(plane[rows] for plane in batch.values()))
        loss.backward()
        torch.nn.utils.clip_grad_norm_(learner.parameters, torch_ppo.MAX_GRAD_NORM, foreach=True)
        learner.optimiser.step()

    side = torch.cuda.Stream()
    side.wait_stream(torch.cuda.current_stream())
    with torch.cuda.stream(side):
        for _ in range(WARM_UP_STEPS):
            learner.optimiser.zero_grad(set_to_none=True)
            step()
    torch.cuda.current_stream().wait_stream(side)
    graph = torch.cuda.CUDAGraph()
    learner.optimiser.zero_grad(set_to_none=True)
    with torch.cuda.graph(graph):
        step()

    def update():
        count = len(batch["returns"])
        for _ in range(torch_ppo.EPOCHS):
            for some in torch.randperm(count).split(minibatch):
                rows.copy_(some)
                graph.replay()
        return count * torch_ppo.EPOCHS

    return update


def main():
    """Measures one network, minibatch and mode."""
    widths, minibatch = [int(width) for width in sys.argv[1].split("-")], int(sys.argv[2])
    mode = sys.argv[3] if len(sys.argv) > 3 else "eager"
    torch.set_default_device("cuda")
    learner, batch = torch_ppo.Learner(widths, torch.nn.ELU), torch_ppo.random_batch(widths[0], 4 * minibatch)
    if mode == "graph":
        update = graphed(learner, batch, minibatch)
    else:
        def update():
            return learner.update(batch, minibatch)
    update()
    torch.cuda.synchronize()
    begun = time.perf_counter()
    samples = sum(update() for _ in range(UPDATES))
    torch.cuda.synchronize()
    print(json.dumps({
        "samples_per_s": round(samples / (time.perf_counter() - begun), 1), "minibatch": minibatch, "network": sys.argv[1],
        "mode": mode, "torch": torch.__version__, "gpu": torch.cuda.get_device_name(),
    }))


if __name__ == "__main__":
    main()

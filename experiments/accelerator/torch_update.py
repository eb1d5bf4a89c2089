"""Prints samples per second of PyTorch's PPO update on a GPU; cuda.sh compares Treadmill with it.

Needs: pip install torch
Usage: torch_update.py 45-256-128 2048
"""

import json
import sys
import time

import torch

from experiments.learning import torch_ppo

UPDATES = 10

widths, minibatch = [int(width) for width in sys.argv[1].split("-")], int(sys.argv[2])
torch.set_default_device("cuda")
learner, batch = torch_ppo.Learner(widths, torch.nn.ELU), torch_ppo.random_batch(widths[0], 4 * minibatch)
learner.update(batch, minibatch)
torch.cuda.synchronize()
begun = time.perf_counter()
samples = sum(learner.update(batch, minibatch) for _ in range(UPDATES))
torch.cuda.synchronize()
print(json.dumps({
    "samples_per_s": round(samples / (time.perf_counter() - begun), 1), "minibatch": minibatch, "network": sys.argv[1],
    "torch": torch.__version__, "gpu": torch.cuda.get_device_name(),
}))

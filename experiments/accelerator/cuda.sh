#!/bin/sh
# Builds Treadmill for an NVIDIA GPU, tests it, and compares its update with PyTorch's on the same GPU. Then it trains briefly.
#
# Needs: a GPU with its driver, CUDA's toolkit with nvcc, cargo, and `pip install torch`
# Usage: experiments/accelerator/cuda.sh [FOLDER FOR THE RUN, default runs/cuda]
set -eu
cd "$(dirname "$0")/../.."
run=${1:-runs/cuda}

nvidia-smi --query-gpu=name,driver_version --format=csv,noheader
cargo build --release --features cuda
cargo test --release --features cuda --test training cuda

for network in 45-256-128 45-512-512 348-512-256; do
    for minibatch in 2048 16384; do
        target/release/treadmill bench update --device cuda --network "$network" --minibatch "$minibatch" --json
        python3 -m experiments.accelerator.torch_update "$network" "$minibatch"
    done
done

target/release/treadmill train --device cuda --steps 500000 --run-dir "$run" --no-progress --json

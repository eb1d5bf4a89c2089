#!/usr/bin/env bash
# Trains a robot to follow velocity commands and measures its policy here and in MuJoCo: the rows of robots.csv.
#
#   measure.sh PRESET MODEL STEPS SEED FOLDER
#
# PRESET is g1, g1-rough (measured on its hardest ground), g1-29, h1 or t1; MODEL the robot's stock MJCF file. A run in FOLDER
# that has begun is resumed; one that is finished is only measured.
#
# TREADMILL   the program; by default target/release/treadmill
# PYTHON      Python with mujoco and onnxruntime, and python/ of this repository installed; by default python3
set -euo pipefail
[ $# = 5 ] || { sed -n '2,10p' "$0"; exit 2; }
preset=$1 model=$2 steps=$3 seed=$4 folder=$5
treadmill=${TREADMILL:-target/release/treadmill}
python=${PYTHON:-python3}
# Pushes as in training, everything else exact.
settings=(--set 'randomisation.push_mps=[0.0,0.5]' --set 'randomisation.push_interval_s=[5.0,10.0]')
ground=()
if [ "$preset" = g1-rough ]; then
    settings+=(--set ground.curriculum=false --set ground.start_level=9)
    ground=(--ground "$folder/ground.json")
fi

"$treadmill" train --preset "$preset" --model "$model" --steps "$steps" --seed "$seed" --run-dir "$folder" --resume-or-start \
    --json --no-progress
"$treadmill" eval "$folder" --checkpoint latest --episodes 100 "${settings[@]}" --json
"$treadmill" export "$folder" --checkpoint latest --onnx "$folder/policy.onnx" --safetensors "$folder/policy.safetensors" "${ground[@]}"
"$python" -m treadmill_transfer "$folder/policy.onnx" --model "$model" --episodes 100 "${ground[@]}" --json

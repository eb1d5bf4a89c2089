#!/usr/bin/env bash
# Compares trained steps per second with UniLab's PPO on MuJoCo, in turn on this machine: G1 with 29 hinges on flat ground.
#
#   unilab.sh MODEL TURNS FOLDER
#
# MODEL is Menagerie's unitree_g1/scene_mjx.xml; FOLDER is made. Both train with their own settings. A rate leaves out what a
# program does before its first update.
#
# TREADMILL   the program; by default target/release/treadmill
# UNILAB      folder of a virtual environment with unilab[mujoco]==1.5.2. Its wheel lacks the robot's meshes: copy
#             Menagerie's unitree_g1/assets/*.STL to unilab/assets/robots/g1 in it
set -euo pipefail
[ $# = 3 ] || { sed -n '2,13p' "$0"; exit 2; }
model=$(realpath "$1") turns=$2 folder=$3
treadmill=$(realpath "${TREADMILL:-target/release/treadmill}")
unilab=$(realpath "${UNILAB:?names a virtual environment with UniLab}")

mkdir -p "$folder/src"
cd "$folder"
ln -sfn "$("$unilab/bin/python" -c 'import importlib.util; print(importlib.util.find_spec("unilab").submodule_search_locations[0])')" src/unilab
for turn in $(seq "$turns"); do
    "$treadmill" train --preset g1-29 --model "$model" --steps 500000 --run-dir "treadmill-$turn" --no-progress > /dev/null
    "$unilab/bin/python" - "treadmill-$turn/metrics.jsonl" <<'PYTHON'
import json, sys
points = [m for m in map(json.loads, open(sys.argv[1])) if m["tag"] == "time/total_timesteps"]
first, last = points[0], points[-1]
print("treadmill", round((last["step"] - first["step"]) / (last["time_unix_s"] - first["time_unix_s"])), "steps/s", flush=True)
PYTHON
    "$unilab/bin/train" --algo ppo --task g1_walk_flat --sim mujoco --render-mode none \
        algo.num_envs=2048 algo.max_iterations=4 training.device=cpu training.no_play=true > "unilab-$turn.log" 2>&1
    grep -E "Steps per second|steps/s" "unilab-$turn.log" | sed 's/^/unilab /'
done

"""Writes a motion of Treadmill's built-in humanoid as CSV: it squats, stands up and waves.

Each line has the root's position (m), its quaternion x, y, z, w and 17 angles (rad), 50 lines per second.
"""

import math
import sys

RATE_HZ = 50
DURATION_S = 6.0
# Hinges in the order of the model, see `treadmill robot`.
HINGES = (
    "abdomen_z abdomen_y abdomen_x right_hip_x right_hip_z right_hip_y right_knee left_hip_x left_hip_z left_hip_y left_knee "
    "right_shoulder1 right_shoulder2 right_elbow left_shoulder1 left_shoulder2 left_elbow"
).split()
# Height of the root when the legs are straight, and lengths of thigh and shin (m).
STANDING_M, THIGH_M, SHIN_M = 1.292, 0.403, 0.35
# Legs that stand are a little bent.
STANDING_RAD, SQUATTING_RAD = 0.15, 0.6


def bump(time_s, begin_s, end_s):
    """Returns a smooth rise from 0 to 1 and back."""
    share = min(1.0, max(0.0, (time_s - begin_s) / (end_s - begin_s)))
    return 0.5 - 0.5 * math.cos(2.0 * math.pi * share)


def frame(time_s):
    """Returns the numbers of one line."""
    bent = STANDING_RAD + (SQUATTING_RAD - STANDING_RAD) * bump(time_s, 0.5, 3.0)
    raised = bump(time_s, 3.0, 6.0)
    angles = dict.fromkeys(HINGES, 0.0)
    for side in ("right", "left"):
        # Thigh and shin turn against each other, so that the feet stay below the hips.
        angles[f"{side}_hip_y"], angles[f"{side}_knee"] = -bent, -2.0 * bent
        angles[f"{side}_elbow"] = -0.6
    angles["right_shoulder1"], angles["right_shoulder2"] = -0.9 * raised, 0.6 * raised
    angles["right_elbow"] += raised * 0.4 * math.sin(2.0 * math.pi * 1.5 * time_s)
    height_m = STANDING_M - (THIGH_M + SHIN_M) * (1.0 - math.cos(bent))
    return [0.0, 0.0, height_m, 0.0, 0.0, 0.0, 1.0, *(angles[hinge] for hinge in HINGES)]


def main():
    """Writes the lines to standard output."""
    for step in range(round(DURATION_S * RATE_HZ) + 1):
        sys.stdout.write(",".join(f"{number:.6f}" for number in frame(step / RATE_HZ)) + "\n")


if __name__ == "__main__":
    main()

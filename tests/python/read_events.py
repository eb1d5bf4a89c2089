#!/usr/bin/env python3
"""Reads a folder's event files as TensorBoard does and prints JSON: {tag: [[step, value], ...]}.

Usage: read_events.py FOLDER    (needs the PyPI package `tensorboard`)

Scalars have numbers as values, texts have strings. Exit code 2 means wrong usage.
"""

import json
import sys
from pathlib import Path

from tensorboard.backend.event_processing import event_accumulator

EVERYTHING = 0
SIZES = {event_accumulator.SCALARS: EVERYTHING, event_accumulator.TENSORS: EVERYTHING}


def is_text(accumulator, tag):
    return accumulator.SummaryMetadata(tag).plugin_data.plugin_name == "text"


def read(folder):
    """Every scalar and text in a folder; several event files count as one run, as in TensorBoard."""
    accumulator = event_accumulator.EventAccumulator(str(folder), size_guidance=SIZES)
    accumulator.Reload()
    tags = accumulator.Tags()
    points = {}
    for tag in tags[event_accumulator.SCALARS]:
        points[tag] = [[event.step, event.value] for event in accumulator.Scalars(tag)]
    for tag in tags[event_accumulator.TENSORS]:
        if is_text(accumulator, tag):
            points[tag] = [[event.step, event.tensor_proto.string_val[0].decode()] for event in accumulator.Tensors(tag)]
    return points


def main():
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    print(json.dumps(read(Path(sys.argv[1]))))


if __name__ == "__main__":
    main()

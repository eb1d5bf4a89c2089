#!/usr/bin/env python3
"""Reads the event files of a folder with TensorBoard's code and prints JSON.

Usage: read_events.py FOLDER    (needs the PyPI package `tensorboard`)

{"points": {tag: [[step, value], ...]}, "histograms": {tag: [[step, rows], ...]}, "pictures": {tag: [[step, width, height,
begin], ...]}, "charts": {title: {title: tags}}, "hparams": {...}}: scalars have numbers as values, texts have strings,
histograms have rows of left edge, right edge and count, pictures the first six bytes of their file. "charts" are those of the
CUSTOM SCALARS tab. "hparams" is the content of the HPARAMS tab for the parent folder: columns, and for each session its
values, status and metrics.
Exit code 2 means wrong usage.
"""

import json
import sys
from pathlib import Path

from tensorboard.backend.event_processing import data_provider, event_accumulator, plugin_event_multiplexer
from tensorboard.context import RequestContext
from tensorboard.plugins import base_plugin
from tensorboard.plugins.custom_scalar import layout_pb2
from tensorboard.plugins.custom_scalar import metadata as custom_metadata
from tensorboard.plugins.histogram import metadata as histogram_metadata
from tensorboard.plugins.hparams import api_pb2, backend_context, get_experiment, list_session_groups
from tensorboard.plugins.image import metadata as image_metadata
from tensorboard.plugins.text import metadata as text_metadata
from tensorboard.util import tensor_util

EVERYTHING = 0
SIZES = {event_accumulator.SCALARS: EVERYTHING, event_accumulator.TENSORS: EVERYTHING}


def read(folder):
    """Returns scalars and texts, histograms, pictures and charts. Several event files are one run, as in TensorBoard."""
    accumulator = event_accumulator.EventAccumulator(str(folder), size_guidance=SIZES)
    accumulator.Reload()
    tags = accumulator.Tags()
    points, histograms, pictures, charts = {}, {}, {}, {}
    for tag in tags[event_accumulator.SCALARS]:
        points[tag] = [[event.step, event.value] for event in accumulator.Scalars(tag)]
    for tag in tags[event_accumulator.TENSORS]:
        data = accumulator.SummaryMetadata(tag).plugin_data
        events = accumulator.Tensors(tag)
        if data.plugin_name == text_metadata.PLUGIN_NAME:
            text_metadata.parse_plugin_metadata(data.content)
            points[tag] = [[event.step, event.tensor_proto.string_val[0].decode()] for event in events]
        elif data.plugin_name == histogram_metadata.PLUGIN_NAME:
            histogram_metadata.parse_plugin_metadata(data.content)
            read_rows = lambda event: tensor_util.make_ndarray(event.tensor_proto).tolist()
            histograms[tag] = [[event.step, read_rows(event)] for event in events]
        elif data.plugin_name == image_metadata.PLUGIN_NAME:
            parts = [(event.step, event.tensor_proto.string_val) for event in events]
            pictures[tag] = [[step, int(width), int(height), file[:6].decode()] for step, (width, height, file) in parts]
        elif data.plugin_name == custom_metadata.PLUGIN_NAME:
            layout = layout_pb2.Layout.FromString(events[-1].tensor_proto.string_val[0])
            tags_of = lambda category: {chart.title: list(chart.multiline.tag) for chart in category.chart}
            charts = {category.title: tags_of(category) for category in layout.category}
    return {"points": points, "histograms": histograms, "pictures": pictures, "charts": charts}


def hparams(logdir):
    """Returns the content of TensorBoard's HPARAMS tab for a log directory."""
    multiplexer = plugin_event_multiplexer.EventMultiplexer().AddRunsFromDirectory(str(logdir))
    multiplexer.Reload()
    provider = data_provider.MultiplexerDataProvider(multiplexer, str(logdir))
    context = backend_context.Context(base_plugin.TBContext(data_provider=provider, logdir=str(logdir)))
    experiment = get_experiment.Handler(RequestContext(), context, "", api_pb2.GetExperimentRequest()).run()
    request = api_pb2.ListSessionGroupsRequest(
        start_index=0,
        slice_size=100,
        allowed_statuses=[api_pb2.STATUS_UNKNOWN, api_pb2.STATUS_SUCCESS, api_pb2.STATUS_FAILURE, api_pb2.STATUS_RUNNING],
        col_params=[api_pb2.ColParams(metric=info.name) for info in experiment.metric_infos],
    )
    groups = list_session_groups.Handler(RequestContext(), context, "", request).run().session_groups
    value = lambda entry: getattr(entry, entry.WhichOneof("kind"))
    return {
        "columns": [info.name for info in experiment.hparam_infos],
        "metrics": [info.name.tag for info in experiment.metric_infos],
        "sessions": [
            {
                "hparams": {name: value(entry) for name, entry in group.hparams.items()},
                "status": [api_pb2.Status.Name(session.status) for session in group.sessions],
                "metrics": {entry.name.tag: entry.value for entry in group.metric_values},
            }
            for group in groups
        ],
    }


def main():
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    folder = Path(sys.argv[1])
    print(json.dumps({**read(folder), "hparams": hparams(folder.parent)}))


if __name__ == "__main__":
    main()

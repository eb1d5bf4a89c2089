"""An actor for Treadmill in Python: Gymnasium environments that a Treadmill learner learns from.

Layout, in the order of the data:
    task       what an environment is to the learner: sizes, and what actions mean
    policy     the policy of a bundle in numpy
    rollout    fragments of T steps of N environments
    delivery   fragments to the learner, kept until they are durable
    worker     all of it as one process
    bus        the flows over Zenoh
    schema     the messages, as proto/schema says
    settings   the part of a run's configuration that an actor needs
"""

__version__ = "0.1.0"

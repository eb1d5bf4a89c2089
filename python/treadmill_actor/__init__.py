"""A Treadmill actor in Python: runs Gymnasium environments for a Treadmill learner.

Modules, in the order of the data:
    task       describes an environment to the learner: name, sizes, action ranges
    policy     evaluates a policy bundle in numpy
    policies   joins the run and fetches new policies
    rollout    collects fragments: T steps of N environments
    delivery   uploads fragments and keeps them until they are durable
    worker     one actor process: collects, uploads, reports statistics
    bus        Zenoh session, queries and publishers
    schema     protobuf messages of proto/schema
    settings   configuration keys that an actor needs
    signals    Ctrl-C and SIGTERM
    cli        command line
    forward    forwards metrics to MLflow or Weights & Biases; no actor
"""

__version__ = "0.1.0"

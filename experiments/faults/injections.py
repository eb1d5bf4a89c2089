"""Faults: each disturbs a training fleet and waits until it recovers."""

import contextlib
import random
import threading
import time

from experiments.faults import links
from experiments.faults.experiment import ACTORS
from experiments.faults.fleet import FRAGMENT

FAULT_S, RESTART_S = 12, 1
# Title, function and options of each fault, by name.
FAULTS = {}


def fault(title, **options):
    def keep(function):
        FAULTS[function.__name__.replace("_", "-")] = (title, function, options)
        return function

    return keep


def restart(experiment, *names, binary=None):
    """Restarts processes, as a supervisor would."""
    time.sleep(RESTART_S)
    for name in names:
        experiment.fleet.start(name, binary=binary)


@fault("none")
def undisturbed(experiment):
    experiment.inject()
    time.sleep(4 * FAULT_S)


@fault("an actor is killed (`kill -9`) and restarted 1 s later")
def actor_killed(experiment):
    experiment.inject()
    experiment.fleet.current["actor-1"].kill()
    experiment.await_gone("actor-1")
    experiment.repair()
    restart(experiment, "actor-1")
    experiment.await_actors("actor-1", delivers=True)
    experiment.note = "recovered: from detection until the learner accepts a fragment of the new process"


@fault("an actor is frozen for 12 s (`SIGSTOP`)")
def actor_frozen(experiment):
    experiment.inject()
    experiment.fleet.current["actor-1"].freeze()
    experiment.await_gone("actor-1")
    wait_until(experiment.injected + FAULT_S)
    experiment.repair()
    experiment.fleet.current["actor-1"].thaw()
    experiment.await_actors("actor-1")


@fault("the learner is killed and resumed 1 s later")
def learner_killed(experiment):
    experiment.inject()
    kill_learner(experiment)
    experiment.await_unanswered()
    experiment.fleet.start("learner")
    await_listening(experiment)
    experiment.await_training()
    count_repeated(experiment)


@fault("the learner is frozen for 12 s")
def learner_frozen(experiment):
    experiment.inject()
    experiment.fleet.current["learner"].freeze()
    experiment.await_unanswered()
    wait_until(experiment.injected + FAULT_S)
    experiment.repair()
    experiment.fleet.current["learner"].thaw()
    experiment.await_training()


@fault("the router is killed and restarted 1 s later")
def router_killed(experiment):
    experiment.inject()
    experiment.fleet.current["router"].kill()
    experiment.await_gone(*ACTORS)
    restart(experiment, "router")
    experiment.repair()
    experiment.await_actors(*ACTORS)


@fault("the router is frozen for 12 s")
def router_frozen(experiment):
    experiment.inject()
    experiment.fleet.current["router"].freeze()
    experiment.await_gone(*ACTORS)
    wait_until(experiment.injected + FAULT_S)
    experiment.repair()
    experiment.fleet.current["router"].thaw()
    experiment.await_actors(*ACTORS)


@fault("the router is killed for good; actors also have the learner's endpoint", via=["router", "learner"])
def router_gone(experiment):
    experiment.inject()
    experiment.fleet.current.pop("router").kill()
    experiment.repaired = experiment.injected
    # Actors may be back before the learner notices.
    experiment.await_training(2)


@fault("all actors are killed and restarted 1 s later")
def all_actors_killed(experiment):
    experiment.inject()
    for name in ACTORS:
        experiment.fleet.current[name].kill()
    experiment.await_gone(*ACTORS)
    experiment.repair()
    restart(experiment, *ACTORS)
    experiment.await_actors(*ACTORS, delivers=True)


@fault("all actors are frozen for 12 s")
def all_actors_frozen(experiment):
    experiment.inject()
    for name in ACTORS:
        experiment.fleet.current[name].freeze()
    experiment.await_gone(*ACTORS)
    wait_until(experiment.injected + FAULT_S)
    experiment.repair()
    for name in ACTORS:
        experiment.fleet.current[name].thaw()
    experiment.await_actors(*ACTORS)


@fault("an actor's host is disconnected for 12 s")
def actor_cut(experiment):
    cut(experiment, ["INPUT", "OUTPUT"])


@fault("one-way loss: nothing reaches an actor's host for 12 s")
def actor_deaf(experiment):
    cut(experiment, ["INPUT"])


@fault("one-way loss: nothing leaves an actor's host for 12 s")
def actor_mute(experiment):
    cut(experiment, ["OUTPUT"])


@fault("the learner's host is disconnected for 12 s")
def learner_cut(experiment):
    experiment.inject()
    with links.dropped(experiment.fleet.prefix, "learner", ["INPUT", "OUTPUT"]):
        experiment.await_gone(*ACTORS)
        wait_until(experiment.injected + FAULT_S)
    experiment.repair()
    experiment.await_actors(*ACTORS)


@fault("5 % of packets are lost on every host for 20 s (iptables `statistic`)")
def packets_lost(experiment):
    experiment.inject()
    with contextlib.ExitStack() as stack:
        for host in ("learner", "router", "actor1", "actor2"):
            stack.enter_context(links.dropped(experiment.fleet.prefix, host, ["INPUT"], probability=0.05))
        wait_until(experiment.injected + 20)
    experiment.repair()
    experiment.await_training()


@fault("200 ms delay each way for 20 s (a relay before each actor)", relay=True)
def delayed(experiment):
    experiment.inject()
    links.set_delay(experiment.fleet.folder, 0.2)
    wait_until(experiment.injected + 20)
    experiment.repair()
    links.set_delay(experiment.fleet.folder, 0)
    experiment.await_training()


@fault("1 MB/s on the links of router and actors for 20 s (`tc` TBF)")
def narrow(experiment):
    experiment.inject()
    with contextlib.ExitStack() as stack:
        for host in ("router", "actor1", "actor2"):
            stack.enter_context(links.narrowed(experiment.fleet.prefix, host, "8mbit"))
        wait_until(experiment.injected + 20)
    experiment.repair()
    experiment.await_training()


@fault("the learner's disk is full for 12 s", disk_mb=40)
def disk_full(experiment):
    experiment.inject()
    filler = links.fill(experiment.fleet.run.parent)
    learner = experiment.fleet.current["learner"]
    logged = lambda: learner.logged("waits until there is room", experiment.injected)
    experiment.detected = experiment.fleet.wait("the learner logs the full disk", logged, 30) - experiment.injected
    wait_until(experiment.injected + FAULT_S)
    experiment.repair()
    filler.unlink()
    experiment.await_training()


@fault("full disk for 12 s; the learner is killed, then started every 2 s until it stays up", disk_mb=40)
def disk_full_killed(experiment):
    experiment.inject()
    filler = links.fill(experiment.fleet.run.parent)
    kill_learner(experiment)
    experiment.await_unanswered()
    ends = 0
    while time.time() < experiment.injected + FAULT_S + 4:
        learner = experiment.fleet.start("learner")
        time.sleep(2)
        if learner.is_running():
            break
        ends += 1
    wait_until(experiment.injected + FAULT_S)
    experiment.repair()
    filler.unlink()
    while not experiment.fleet.current["learner"].is_running():
        restart(experiment, "learner")
        time.sleep(1)
    experiment.await_training()
    count_repeated(experiment)
    experiment.note = f"{ends} starts ended with an error about the full disk"


@fault("an actor runs at a tenth of its speed for 20 s (stopped for 90 of every 100 ms)")
def actor_slow(experiment):
    experiment.inject()
    actor, ended = experiment.fleet.current["actor-1"], threading.Event()

    def slow():
        while not ended.is_set():
            actor.freeze()
            ended.wait(0.09)
            actor.thaw()
            ended.wait(0.01)
        actor.thaw()

    slowing = threading.Thread(target=slow)
    slowing.start()
    wait_until(experiment.injected + 20)
    ended.set()
    slowing.join()
    experiment.repair()
    experiment.await_training()


@fault("the learner's clock jumps an hour ahead, then two back (libfaketime)", clock="learner")
def learner_clock(experiment):
    clock(experiment)


@fault("an actor's clock jumps an hour ahead, then two back (libfaketime)", clock="actor-1")
def actor_clock(experiment):
    clock(experiment)


@fault("all processes are killed and started in random order; worst of four orders")
def restart_of_everything(experiment):
    experiment.inject()
    fleet, slowest = experiment.fleet, 0.0
    order = ["learner", "router", *ACTORS]
    for number in range(4):
        random.Random(number).shuffle(order)
        for name in order:
            fleet.current[name].kill()
        killed = time.time()
        for name in order:
            fleet.start(name)
            time.sleep(0.5)
        experiment.repair()
        # The first actor may deliver before the last one starts.
        experiment.await_actors(*ACTORS, delivers=True, since=killed)
        slowest = max(slowest, experiment.recovered)
        fleet.grow(4 * FRAGMENT)
    experiment.recovered = slowest


@fault("rolling upgrade: actors one version older are replaced one by one", older=True)
def rolling_upgrade(experiment):
    experiment.inject()
    for name in ACTORS:
        experiment.fleet.current[name].stop()
        experiment.repair()
        experiment.fleet.start(name)
        experiment.await_actors(name, delivers=True)


def wait_until(moment):
    time.sleep(max(0.0, moment - time.time()))


def cut(experiment, chains):
    experiment.inject()
    with links.dropped(experiment.fleet.prefix, "actor1", chains):
        experiment.await_gone("actor-1")
        wait_until(experiment.injected + FAULT_S)
    experiment.repair()
    experiment.await_actors("actor-1")


def kill_learner(experiment):
    experiment.updates_before = experiment.fleet.newest()[1]
    experiment.fleet.current["learner"].kill()
    experiment.updates_before = max(experiment.updates_before, experiment.fleet.newest()[1])


def count_repeated(experiment):
    first = experiment.fleet.wait("an update", lambda: (newest := experiment.fleet.newest()) and newest[1] > 0 and newest[1])
    experiment.updates_repeated = max(0, experiment.updates_before - first + 1) if first <= experiment.updates_before else 0


def await_listening(experiment):
    out = experiment.fleet.current["learner"].out
    experiment.fleet.wait("the learner is listening", lambda: "listening" in out.read_text(encoding="utf-8", errors="replace"))
    experiment.repair()


def clock(experiment):
    experiment.inject()
    for offset in ("+3600", "-3600"):
        links.set_clock(experiment.fleet.folder, offset)
        time.sleep(FAULT_S)
    # New links must accept certificates while clocks differ.
    experiment.repair()
    experiment.fleet.current["router"].kill()
    experiment.fleet.start("router")
    experiment.await_training(2)
    experiment.note = "at the end the router is killed, so that links are established while clocks differ"

"""The faults: each disturbs a fleet that trains, and awaits that it recovers."""

import contextlib
import random
import threading
import time

import links
from fleet import FRAGMENT
from trial import ACTORS

FAULT_S, RESTART_S = 12, 1
# Title, function and options by name.
FAULTS = {}


def fault(title, **options):
    def keep(function):
        FAULTS[function.__name__.replace("_", "-")] = (title, function, options)
        return function

    return keep


def restart(trial, *names, binary=None):
    """What a restart policy does."""
    time.sleep(RESTART_S)
    for name in names:
        trial.fleet.start(name, binary=binary)


@fault("none")
def undisturbed(trial):
    trial.inject()
    time.sleep(4 * FAULT_S)


@fault("an actor is killed (`kill -9`), and started again 1 s later")
def actor_killed(trial):
    trial.inject()
    trial.fleet.current["actor-1"].kill()
    trial.gone("actor-1")
    trial.repair()
    restart(trial, "actor-1")
    trial.await_actors("actor-1", delivers=True)
    trial.note = "recovered: from the notice until the learner has work of the new process"


@fault("an actor is frozen for 12 s (`SIGSTOP`)")
def actor_frozen(trial):
    trial.inject()
    trial.fleet.current["actor-1"].freeze()
    trial.gone("actor-1")
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.fleet.current["actor-1"].thaw()
    trial.await_actors("actor-1")


@fault("the learner is killed, and resumed 1 s later")
def learner_killed(trial):
    trial.inject()
    kill_learner(trial)
    trial.unanswered()
    trial.fleet.start("learner")
    await_listening(trial)
    trial.await_training()
    count_repeated(trial)


@fault("the learner is frozen for 12 s")
def learner_frozen(trial):
    trial.inject()
    trial.fleet.current["learner"].freeze()
    trial.unanswered()
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.fleet.current["learner"].thaw()
    trial.await_training()


@fault("the router is killed, and started again 1 s later")
def router_killed(trial):
    trial.inject()
    trial.fleet.current["router"].kill()
    trial.gone(*ACTORS)
    restart(trial, "router")
    trial.repair()
    trial.await_actors(*ACTORS)


@fault("the router is frozen for 12 s")
def router_frozen(trial):
    trial.inject()
    trial.fleet.current["router"].freeze()
    trial.gone(*ACTORS)
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.fleet.current["router"].thaw()
    trial.await_actors(*ACTORS)


@fault("the router is killed for good; actors know the learner's endpoint, too", via=["router", "learner"])
def router_gone(trial):
    trial.inject()
    trial.fleet.current.pop("router").kill()
    trial.repaired = trial.injected
    # They may be back before the learner has looked.
    trial.await_training(2)


@fault("all actors are killed, and started again 1 s later")
def all_actors_killed(trial):
    trial.inject()
    for name in ACTORS:
        trial.fleet.current[name].kill()
    trial.gone(*ACTORS)
    trial.repair()
    restart(trial, *ACTORS)
    trial.await_actors(*ACTORS, delivers=True)


@fault("all actors are frozen for 12 s")
def all_actors_frozen(trial):
    trial.inject()
    for name in ACTORS:
        trial.fleet.current[name].freeze()
    trial.gone(*ACTORS)
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    for name in ACTORS:
        trial.fleet.current[name].thaw()
    trial.await_actors(*ACTORS)


@fault("an actor's host is cut off for 12 s")
def actor_cut(trial):
    cut(trial, ["INPUT", "OUTPUT"])


@fault("one-way loss: nothing reaches an actor's host for 12 s")
def actor_deaf(trial):
    cut(trial, ["INPUT"])


@fault("one-way loss: nothing leaves an actor's host for 12 s")
def actor_mute(trial):
    cut(trial, ["OUTPUT"])


@fault("the learner's host is cut off for 12 s")
def learner_cut(trial):
    trial.inject()
    with links.dropped(trial.fleet.prefix, "learner", ["INPUT", "OUTPUT"]):
        trial.gone(*ACTORS)
        wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.await_actors(*ACTORS)


@fault("5 % of packets are lost on every host for 20 s (iptables `statistic`)")
def packets_lost(trial):
    trial.inject()
    with contextlib.ExitStack() as stack:
        for host in ("learner", "router", "actor1", "actor2"):
            stack.enter_context(links.dropped(trial.fleet.prefix, host, ["INPUT"], probability=0.05))
        wait_until(trial.injected + 20)
    trial.repair()
    trial.await_training()


@fault("200 ms delay each way for 20 s (a relay before each actor)", relay=True)
def delayed(trial):
    trial.inject()
    links.set_delay(trial.fleet.folder, 0.2)
    wait_until(trial.injected + 20)
    trial.repair()
    links.set_delay(trial.fleet.folder, 0)
    trial.await_training()


@fault("1 MB/s on the links of router and actors for 20 s (`tc` TBF)")
def narrow(trial):
    trial.inject()
    with contextlib.ExitStack() as stack:
        for host in ("router", "actor1", "actor2"):
            stack.enter_context(links.narrowed(trial.fleet.prefix, host, "8mbit"))
        wait_until(trial.injected + 20)
    trial.repair()
    trial.await_training()


@fault("the learner's disk is full for 12 s", disk_mb=40)
def disk_full(trial):
    trial.inject()
    filler = links.fill(trial.fleet.run.parent)
    until = trial.fleet.current["learner"]
    trial.detected = trial.fleet.wait("it says so", lambda: until.said("waits until there is room", trial.injected), 30)
    trial.detected -= trial.injected
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    filler.unlink()
    trial.await_training()


@fault("the same, and the learner is killed meanwhile and started every 2 s until it stays", disk_mb=40)
def disk_full_killed(trial):
    trial.inject()
    filler = links.fill(trial.fleet.run.parent)
    kill_learner(trial)
    trial.unanswered()
    ends = 0
    while time.time() < trial.injected + FAULT_S + 4:
        learner = trial.fleet.start("learner")
        time.sleep(2)
        if learner.is_running():
            break
        ends += 1
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    filler.unlink()
    while not trial.fleet.current["learner"].is_running():
        restart(trial, "learner")
        time.sleep(1)
    trial.await_training()
    count_repeated(trial)
    trial.note = f"{ends} starts ended with an error that names the full disk"


@fault("an actor at a tenth of its speed for 20 s (stopped for 90 of every 100 ms)")
def actor_slow(trial):
    trial.inject()
    actor, over = trial.fleet.current["actor-1"], threading.Event()

    def slow():
        while not over.is_set():
            actor.freeze()
            over.wait(0.09)
            actor.thaw()
            over.wait(0.01)
        actor.thaw()

    slowing = threading.Thread(target=slow)
    slowing.start()
    wait_until(trial.injected + 20)
    over.set()
    slowing.join()
    trial.repair()
    trial.await_training()


@fault("the learner's clock jumps an hour ahead, then two back (libfaketime)", clock="learner")
def learner_clock(trial):
    clock(trial)


@fault("an actor's clock jumps an hour ahead, then two back (libfaketime)", clock="actor-1")
def actor_clock(trial):
    clock(trial)


@fault("everything is killed, and started in some order; the worst of four orders")
def restart_of_everything(trial):
    trial.inject()
    fleet, slowest = trial.fleet, 0.0
    order = ["learner", "router", *ACTORS]
    for number in range(4):
        random.Random(number).shuffle(order)
        for name in order:
            fleet.current[name].kill()
        killed = time.time()
        for name in order:
            fleet.start(name)
            time.sleep(0.5)
        trial.repair()
        # The first actor may deliver before the last one starts.
        trial.await_actors(*ACTORS, delivers=True, since=killed)
        slowest = max(slowest, trial.recovered)
        fleet.grow(4 * FRAGMENT)
    trial.recovered = slowest


@fault("a rolling upgrade: actors one version older, replaced one after the other", older=True)
def rolling_upgrade(trial):
    trial.inject()
    for name in ACTORS:
        trial.fleet.current[name].stop()
        trial.repair()
        trial.fleet.start(name)
        trial.await_actors(name, delivers=True)


def wait_until(moment):
    time.sleep(max(0.0, moment - time.time()))


def cut(trial, chains):
    trial.inject()
    with links.dropped(trial.fleet.prefix, "actor1", chains):
        trial.gone("actor-1")
        wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.await_actors("actor-1")


def kill_learner(trial):
    trial.updates_before = trial.fleet.newest()[1]
    trial.fleet.current["learner"].kill()
    trial.updates_before = max(trial.updates_before, trial.fleet.newest()[1])


def count_repeated(trial):
    first = trial.fleet.wait("an update", lambda: (newest := trial.fleet.newest()) and newest[1] > 0 and newest[1])
    trial.updates_repeated = max(0, trial.updates_before - first + 1) if first <= trial.updates_before else 0


def await_listening(trial):
    out = trial.fleet.current["learner"].out
    trial.fleet.wait("the learner listens", lambda: "listening" in out.read_text(encoding="utf-8", errors="replace"))
    trial.repair()


def clock(trial):
    trial.inject()
    for offset in ("+3600", "-3600"):
        links.set_clock(trial.fleet.folder, offset)
        time.sleep(FAULT_S)
    # A link that is made while clocks differ needs certificates that are valid on both.
    trial.repair()
    trial.fleet.current["router"].kill()
    trial.fleet.start("router")
    trial.await_training(2)
    trial.note = "at the end the router is killed, so that links are made anew while clocks differ"

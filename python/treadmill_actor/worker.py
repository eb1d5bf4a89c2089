"""One actor process: joins a run, collects and uploads fragments, reports statistics, survives learner restarts."""

import json
import logging
import os
import queue
import random
import socket
import threading
import time

from . import __version__, schema
from .delivery import Uploader
from .policies import Policies, join
from .rollout import Collector
from .settings import Settings

#: How long to wait for each thread at the end. Closing the session ends the others.
STOP_TIMEOUT_S = 2.0
#: Interval of asking whether the bus is a standby's.
PLACE_EVERY_S = 10.0
log = logging.getLogger("treadmill_actor")


def unique():
    """Returns a random 63-bit number from the operating system."""
    return random.SystemRandom().getrandbits(63)


class Worker:
    """Collects fragments for one run until a request to stop."""

    def __init__(self, bus, run, actor, environments, seed, stopping, leaves_standby=False):
        self.bus, self.run, self.actor = bus, run, actor
        #: Whether to end where the bus was dialled at a standby, and whether it was.
        self.leaves_standby, self.is_behind_standby = leaves_standby, False
        self.environments, self.seed, self.stopping = environments, seed, stopping
        self.env_steps = self.episodes = self.faults = 0
        #: Steps of the next fragment as the last receipt says; 0 if it leaves them open.
        self.receipt_steps = 0
        self.uploader = self.failure = None

    def work(self, steps=None):
        """Joins and simulates for `steps` environment steps; joins again if the run changes."""
        has_simulated, self.is_behind_standby = False, False
        while not self.stopping.is_set():
            if self.leaves_standby and self.bus.is_behind_standby(self.run):
                self.is_behind_standby = True
            if self.is_behind_standby:
                return
            bundle = join(self.bus, self.run, self.actor, self.environments.task, self.stopping)
            if bundle is None:
                return
            self.bus.wait_for_name(self.run, self.actor, self.stopping)
            if has_simulated:
                self.environments.reset()
            has_simulated = True
            log.info("%s joined run `%s` at version %d", self.actor, self.run, bundle.version.number)
            if self._simulate_run(bundle, steps):
                return
            if self.is_behind_standby:
                continue
            log.warning("run `%s` changed; joining again", self.run)

    def _simulate_run(self, bundle, steps):
        """Simulates until the end or until the run changes. Returns False if the run changed."""
        settings, incarnation = Settings.of(bundle), unique()
        self.receipt_steps = 0
        policies = Policies(self.bus, bundle, self.actor, self.environments.task)
        # Ends the upload threads.
        leaving = threading.Event()
        self.uploader = Uploader(
            self.bus,
            self.run,
            self.actor,
            bundle.version.incarnation,
            settings.receipt_timeout_s,
            leaving,
            policies.admits,
        )
        collector = Collector(
            self.environments, self.run, self.actor, incarnation, bundle.config_hash, (self.seed, incarnation)
        )
        ended, announced = threading.Event(), threading.Event()

        def apply(version):
            if policies.admits(version):
                policies.announced_version = version
                announced.set()

        token = self.bus.token(self.run, self.actor)
        subscriber = self.bus.announcements(self.run, apply)
        episode_publisher = self.bus.publisher(f"treadmill/{self.run}/episodes/{self.actor}")
        stats_publisher = self.bus.publisher(f"treadmill/{self.run}/actors/{self.actor}/stats")
        # One credit for each unanswered fragment; the receipt returns it.
        credit, outbox = threading.Semaphore(settings.fragments_in_flight), queue.Queue()
        jitter = random.uniform(0.8, 1.2)
        threads = [
            threading.Thread(target=policies.follow, args=(announced, settings.policy_poll_s * jitter, ended)),
            threading.Thread(
                target=self._report, args=(stats_publisher, policies, incarnation, settings.stats_every_s, ended)
            ),
            *(
                threading.Thread(target=self._deliver, args=(outbox, credit, policies))
                for _ in range(settings.fragments_in_flight)
            ),
        ]
        uploads = threads[2:]
        if self.leaves_standby:
            threads.append(threading.Thread(target=self._watch_place, args=(policies, ended)))
        for thread in threads:
            thread.daemon = True
            thread.start()
        done = False
        try:
            done = self._simulate(collector, settings, policies, credit, outbox, episode_publisher, steps)
        finally:
            for _ in range(settings.fragments_in_flight):
                outbox.put(None)
            # After all steps, wait for the last receipts; after a stop, a failure or a changed run, do not.
            while done and not self.stopping.is_set() and any(thread.is_alive() for thread in uploads):
                self.stopping.wait(0.1)
            leaving.set()
            for thread in uploads:
                thread.join(STOP_TIMEOUT_S)
            ended.set()
            announced.set()
            for thread in threads[:2]:
                thread.join(STOP_TIMEOUT_S)
            for declared in (subscriber, token, episode_publisher, stats_publisher):
                declared.undeclare()
        if self.failure is not None:
            raise self.failure
        return done

    def _simulate(self, collector, settings, policies, credit, outbox, episode_publisher, steps):
        while not self.stopping.is_set() and self.failure is None:
            if policies.run_changed.is_set():
                return False
            if not credit.acquire(timeout=0.1):
                continue
            policy, version = policies.current
            length = settings.next_fragment_steps(self.receipt_steps, policies.fragment_steps)
            before = collector.env_steps
            settled = self.uploader.settled_through()
            collected = collector.collect(policy, version, settled, length, self.stopping.is_set)
            if collected is None:
                break
            fragment, episodes = collected
            self.uploader.produce(collector.sequence, fragment)
            outbox.put((collector.sequence, fragment))
            self.env_steps += collector.env_steps - before
            self.episodes += len(episodes)
            for episode in episodes:
                self.faults += episode["cause"] == "non_finite"
                report = {"run": self.run, "actor": self.actor, "return": episode["return_sum"], **episode}
                del report["return_sum"]
                episode_publisher.put(json.dumps(report))
            if steps is not None and self.env_steps >= steps:
                return True
        return True

    def _deliver(self, outbox, credit, policies):
        """Uploads fragments; runs on one thread per credit."""
        try:
            while (item := outbox.get()) is not None:
                receipt = self.uploader.deliver(*item)
                if receipt is None:
                    return
                self.receipt_steps = receipt.fragment_steps
                policies.refresh(receipt.version)
                self.uploader.resend_unsaved(policies.current[1].incarnation)
                credit.release()
        except Exception as why:  # noqa: BLE001: the simulating thread raises it
            self.failure = why

    def _watch_place(self, policies, ended):
        """Ends the simulation once the bus is a standby's: a learner that leads may be overtaken."""
        while not ended.wait(PLACE_EVERY_S):
            if self.bus.is_behind_standby(self.run):
                self.is_behind_standby = True
                policies.run_changed.set()
                return

    def _report(self, publisher, policies, incarnation, every_s, ended):
        steps_before, since = self.env_steps, time.monotonic()
        while not ended.wait(every_s):
            now, delivery = time.monotonic(), self.uploader.delivery
            rate, since = (self.env_steps - steps_before) / max(now - since, 1e-9), now
            steps_before = self.env_steps
            stats = schema.ActorStats(
                actor=self.actor,
                incarnation=incarnation,
                host=socket.gethostname(),
                pid=os.getpid(),
                version=policies.current[1],
                envs=len(self.environments),
                env_steps_per_s=rate,
                env_steps=self.env_steps,
                episodes=self.episodes,
                faults=self.faults,
                produced=delivery.produced,
                accepted=delivery.accepted,
                dropped_by_rule=delivery.dropped_by_rule,
                in_flight=len(delivery.pending),
                resent=delivery.resent,
                awaiting_durability=len(delivery.kept),
                resident_bytes=resident_bytes(),
                program_version=f"python {__version__}",
            )
            publisher.put(stats.SerializeToString())


def resident_bytes():
    """Returns the resident memory of this process in bytes, or 0 outside Linux."""
    try:
        with open("/proc/self/statm", encoding="ascii") as statm:
            return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 0

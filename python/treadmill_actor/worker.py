"""One actor process: joins, collects, delivers, tells about itself, and outlives the learner."""

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

#: After this, a thread that waits for an answer is left behind: closing the session ends its wait.
STOP_PATIENCE_S = 2.0
log = logging.getLogger("treadmill_actor")


def unique():
    """A number that no other process has."""
    return random.SystemRandom().getrandbits(63)


class Worker:
    """Simulates for one run until it is asked to stop."""

    def __init__(self, bus, run, actor, environments, seed, stopping):
        self.bus, self.run, self.actor = bus, run, actor
        self.environments, self.seed, self.stopping = environments, seed, stopping
        self.env_steps = self.episodes = self.faults = 0
        self.failure = None

    def work(self, steps=None):
        """Joins, again where the run was begun anew, and simulates; after `steps` environment steps it is enough."""
        while not self.stopping.is_set():
            bundle = join(self.bus, self.run, self.actor, self.environments.task, self.stopping)
            if bundle is None:
                return
            log.info("%s joined run `%s` at version %d", self.actor, self.run, bundle.version.number)
            if self._stay(bundle, steps):
                return
            log.warning("run `%s` is no longer there as it was; joining again", self.run)

    def _stay(self, bundle, steps):
        """True where it was enough, False where the run is another one now."""
        settings, incarnation = Settings.of(bundle), unique()
        policies = Policies(self.bus, bundle, self.actor, self.environments.task)
        # Set once what is still under way is given up.
        leaving = threading.Event()
        self.uploader = Uploader(
            self.bus, self.run, self.actor, bundle.version.incarnation, settings.receipt_timeout_s, leaving
        )
        collector = Collector(
            self.environments, settings, self.run, self.actor, incarnation, bundle.config_hash, (self.seed, incarnation)
        )
        over, announced = threading.Event(), threading.Event()

        def apply(version):
            policies.announced_version = version
            announced.set()

        token = self.bus.token(self.run, self.actor)
        subscriber = self.bus.announcements(self.run, apply)
        tell_episode = self.bus.publisher(f"treadmill/{self.run}/episodes/{self.actor}")
        tell_stats = self.bus.publisher(f"treadmill/{self.run}/actors/{self.actor}/stats")
        # Credit: one for each fragment that may be unanswered; the receipt gives it back.
        credit, outbox = threading.Semaphore(settings.fragments_in_flight), queue.Queue()
        jitter = random.uniform(0.8, 1.2)
        threads = [
            threading.Thread(target=policies.follow, args=(announced, settings.policy_poll_s * jitter, over)),
            threading.Thread(
                target=self._tell, args=(tell_stats, policies, incarnation, settings.stats_every_s, over)
            ),
            *(
                threading.Thread(target=self._deliver, args=(outbox, credit, policies))
                for _ in range(settings.fragments_in_flight)
            ),
        ]
        for thread in threads:
            thread.daemon = True
            thread.start()
        done = False
        try:
            done = self._simulate(collector, policies, credit, outbox, tell_episode, steps)
        finally:
            for _ in range(settings.fragments_in_flight):
                outbox.put(None)
            # Who has done enough waits for the last receipts; who is asked to stop, failed or has no run any more does not.
            while done and not self.stopping.is_set() and any(thread.is_alive() for thread in threads[2:]):
                self.stopping.wait(0.1)
            leaving.set()
            for thread in threads[2:]:
                thread.join(STOP_PATIENCE_S)
            over.set()
            announced.set()
            for thread in threads[:2]:
                thread.join(STOP_PATIENCE_S)
            for declared in (subscriber, token, tell_episode, tell_stats):
                declared.undeclare()
        if self.failure is not None:
            raise self.failure
        return done

    def _simulate(self, collector, policies, credit, outbox, tell_episode, steps):
        while not self.stopping.is_set() and self.failure is None:
            if policies.other_run.is_set():
                return False
            if not credit.acquire(timeout=0.1):
                continue
            policy, version = policies.current
            fragment, episodes = collector.collect(policy, version, self.uploader.settled_through())
            self.uploader.produced(collector.sequence)
            outbox.put((collector.sequence, fragment))
            self.env_steps += collector.transitions
            self.episodes += len(episodes)
            for episode in episodes:
                self.faults += episode["cause"] == "non_finite"
                report = {"run": self.run, "actor": self.actor, "return": episode["return_sum"], **episode}
                del report["return_sum"]
                tell_episode.put(json.dumps(report))
            if steps is not None and self.env_steps >= steps:
                return True
        return True

    def _deliver(self, outbox, credit, policies):
        """Runs in as many threads as fragments may be unanswered."""
        try:
            while (item := outbox.get()) is not None:
                receipt = self.uploader.deliver(*item)
                if receipt is None:
                    return
                policies.refresh(receipt.version)
                self.uploader.send_again(policies.current[1].incarnation)
                credit.release()
        except Exception as why:  # noqa: BLE001: whatever it is, the simulating thread must not wait for ever
            self.failure = why

    def _tell(self, publisher, policies, incarnation, every_s, over):
        steps_before, since = self.env_steps, time.monotonic()
        while not over.wait(every_s):
            now, book = time.monotonic(), self.uploader.book
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
                produced=book.produced,
                accepted=book.accepted,
                dropped_by_rule=book.dropped_by_rule,
                in_flight=len(book.in_flight),
                resent=book.resent,
                awaiting_durability=len(book.kept),
                resident_bytes=resident_bytes(),
                program_version=f"python {__version__}",
            )
            publisher.put(stats.SerializeToString())


def resident_bytes():
    """Memory of this process that is in RAM, where the system tells it."""
    try:
        with open("/proc/self/statm", encoding="ascii") as statm:
            return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 0

"""Study of Optuna, served to `treadmill sweep`: each request is a line of JSON, and so is its answer."""

import importlib.util
import json
import warnings

try:
    import optuna
    from optuna import pruners, samplers
    from optuna.trial import TrialState
except ImportError:
    optuna = None

#: Pruners wait for this part of the steps, before which curves say little. Hyperband then has three brackets.
PRUNES_FROM = 9


class Study:
    """Study with the trials that have not ended, by their numbers; each method answers one kind of request."""

    def check(self, strategy):
        """Refuses what lacks a package, before anything is written."""
        if optuna is None:
            raise ValueError("Optuna is missing; install it: pip install 'optuna>=5,<6'")
        if strategy == "cmaes" and not importlib.util.find_spec("cmaes"):
            raise ValueError('`strategy` "cmaes" needs another package: pip install cmaes')
        optuna.logging.set_verbosity(optuna.logging.ERROR)
        return {}

    def open(self, storage, name, trials, direction, strategy, pruner, seed, steps, keys):
        """Creates the study, or opens that of a sweep that has begun `trials`. Returns which go on, with their last steps."""
        # Readers such as a dashboard lock a file for a moment.
        options = {"connect_args": {"timeout": 60}} if storage.startswith("sqlite") else {}
        place = {"storage": optuna.storages.RDBStorage(storage, options), "study_name": name}
        self.keys = keys
        try:
            if trials is None:
                self.study = optuna.create_study(**place, direction=direction, load_if_exists=True)
            else:
                self.study = optuna.load_study(**place)
        except KeyError:
            raise ValueError("it is not there; restore the database") from None
        found = self.study.get_trials(deepcopy=False)
        # A killed sweep may not have saved its last trial.
        known = [0] if trials is None else [trials, trials + 1]
        if len(found) not in known or self.study.direction.name.lower() != direction:
            raise ValueError(f"it has {len(found)} trials, and the sweep {known[0]}; choose another --run-dir or --storage")
        # After a resume, the same seed would draw the first settings again.
        seed = (seed + len(found)) % 2**32
        strategies = {"tpe": samplers.TPESampler, "cmaes": samplers.CmaEsSampler, "random": samplers.RandomSampler}
        self.study.sampler, least = strategies[strategy](seed=seed), max(1, steps // PRUNES_FROM)
        self.study.pruner = {
            "none": pruners.NopPruner(),
            "median": pruners.MedianPruner(n_warmup_steps=least),
            "hyperband": pruners.HyperbandPruner(min_resource=least, max_resource=max(steps, least)),
        }[pruner]
        begun = [trial for trial in found if trial.state == TrialState.RUNNING]
        self.trials = {trial.number: optuna.Trial(self.study, trial._trial_id) for trial in begun}
        return {"begun": [[trial.number, trial.last_step or 0] for trial in begun]}

    def ask(self, trial):
        """Proposes the value of each key; those of a trial that has begun stay."""
        asked = self.trials[trial] if trial in self.trials else self.study.ask()
        if asked.number != trial:
            raise ValueError(f"the study has {asked.number} trials, and the sweep {trial}; another program has changed it")
        self.trials[trial], values = asked, []
        for key, kind, given in self.keys:
            if kind == "choices":
                values.append(asked.suggest_categorical(key, given))
            elif kind == "integers":
                values.append(asked.suggest_int(key, *given))
            else:
                values.append(asked.suggest_float(key, *given, log=kind == "log_uniform"))
        return {"values": values}

    def report(self, trial, step, value):
        """Returns whether a trial with this value is hopeless."""
        self.trials[trial].report(value, step)
        # Of NumPy, which JSON does not know.
        return {"prune": bool(self.trials[trial].should_prune())}

    def end(self, trial, state, value):
        """Records the result of a trial."""
        self.study.tell(self.trials.pop(trial), value, TrialState[state])
        return {}

    def importance(self):
        """Returns the importance of each key by PED-ANOVA, once two trials have a result."""
        if len(self.study.get_trials(deepcopy=False, states=[TrialState.COMPLETE])) < 2:
            return {"importance": {}}
        # Optuna warns of few trials, whose number the sweep prints.
        with warnings.catch_warnings(action="ignore"):
            return {"importance": optuna.importance.get_param_importances(self.study)}


def serve(requests, answers):
    """Answers requests until they end."""
    study = Study()
    for line in requests:
        request = json.loads(line)
        try:
            answer = getattr(study, request.pop("call"))(**request)
        except Exception as why:  # noqa: BLE001: each database has errors of its own
            answer = {"error": str(why) or repr(why)}
        print(json.dumps(answer), file=answers, flush=True)

//! Keys of the configuration. The doc texts are the reference page and `--help`.

use treadmill_proto::{
    ident::check_task_name,
    limits::WIDTH_MAX,
    pool::{RUN_ENVS_MAX, is_share},
};
use treadmill_settings::section;

use super::choices::{LearnerMode, ObservationPrecision, Symmetry};

section! {
    /// Seed, length and determinism of the run.
    RunConfig as "run" {
        /// Seed of all random streams of the run.
        seed: u64 = 1, "0 to 9223372036854775807" => |v| *v <= i64::MAX as u64;
        /// Environment steps of the run in total; no schedule depends on it.
        steps: u64 = 8_000_000, "1 to 1000000000000" => |v| (1..=1_000_000_000_000).contains(v);
        /// Run one actor in lock-step with the learner: the same seed then gives the same weights, bit for bit.
        deterministic: bool = false, "true or false" => |_| true;
        /// Weight of the run where runs share a pool of actors; 0 takes none of them. Deterministic runs and external tasks
        /// take none, either.
        share: f64 = 1.0, "0, or 0.001 to 1000" => |v| is_share(*v);
        /// Smallest number of environments that is of use to the run: a pool that has fewer for it gives none.
        envs_min: u32 = 0, "0 to 1000000" => |v| *v <= RUN_ENVS_MAX;
        /// Largest number of environments that is of use to the run, its own actors included. Beyond some hundred, more
        /// environments hardly shorten a training.
        envs_max: u32 = 512, "0 to 1000000" => |v| *v <= RUN_ENVS_MAX;
        /// Words that group runs, shown by `treadmill runs` and TensorBoard.
        tags: Vec<String> = Vec::new(), "at most 16 words, each of 1 to 32 characters"
            => |v| v.len() <= 16 && v.iter().all(|tag| is_tag(tag));
        /// Free text about the run, shown by `treadmill runs` and TensorBoard.
        description: String = String::new(), "at most 500 characters in one line"
            => |v| v.chars().count() <= 500 && !v.contains(char::is_control);
    }
}

section! {
    /// External task, if `env.task` is `"external"`. Keys left at their defaults take the values that the first actor
    /// registers, and are then fixed for the run. The other keys of `[env]` and those of `[randomisation]` have no effect.
    TaskConfig as "task" {
        /// Name of the task, as its actors register it; empty takes the first registered one.
        name: String = String::new(),
            "at most 128 of the characters a-z, A-Z, 0-9, _ - . : and /, not beginning with treadmill/"
            => |v| v.is_empty() || check_task_name("task.name", v).is_ok();
        /// Entries of one observation; 0 takes what the first actor registers.
        observation_size: u32 = 0, "0 to 4096" => |v| *v <= WIDTH_MAX;
        /// Entries of one action; 0 takes what the first actor registers.
        action_size: u32 = 0, "0 to 4096" => |v| *v <= WIDTH_MAX;
        /// Environment's value for an action of -1, for each entry.
        action_low: Vec<f64> = vec![], "as many finite numbers as task.action_size says"
            => |v| v.iter().all(|v| v.is_finite());
        /// Environment's value for an action of 1, for each entry.
        action_high: Vec<f64> = vec![], "as many finite numbers, each above that of task.action_low"
            => |v| v.iter().all(|v| v.is_finite());
        /// Duration of one control step in seconds; 0 means unknown.
        control_step_s: f64 = 0.0, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Mirror image of an observation, which exchanges left and right: for each entry the number from 1 of the entry
        /// that it holds, negative if with its sign changed. Empty means none.
        observation_mirror: Vec<i32> = vec![], "as many numbers as task.observation_size says" => |_| true;
        /// Mirror image of an action.
        action_mirror: Vec<i32> = vec![], "as many numbers as task.action_size says" => |_| true;
    }
}

section! {
    /// Collection of experience.
    RolloutConfig as "rollout" {
        /// Environments in total, divided among the actors of `train`.
        envs: u32 = 64, "1 to 65536" => |v| (1..=65_536).contains(v);
        /// Actor processes that `train` starts; 0 means one per core.
        actors: u32 = 0, "0 to 256" => |v| *v <= 256;
        /// Control steps of each environment in one fragment; 0 lets the learner fit them to the number and speed of the
        /// actors.
        fragment_steps: u32 = 0, "0 to 4096" => |v| *v <= 4096;
        /// Precision to which observations are rounded before the policy and the learner receive them; "f16" saves a third
        /// of the bytes.
        observation_precision: ObservationPrecision = ObservationPrecision::F32, "\"f32\" or \"f16\"" => |_| true;
        /// Fragments without a receipt that an actor may have on the bus; 0 means 1 in learner.mode "sync" and 2 in "async".
        max_in_flight: u32 = 0, "0 to 2, and not 2 in learner.mode \"sync\"" => |v| *v <= 2;
        /// Threads of each actor process, which divide its environments; 0 means one per core. A deterministic run uses one.
        threads: u32 = 1, "0 to 256" => |v| *v <= 256;
    }
}

section! {
    /// Actor and critic networks.
    PolicyConfig as "policy" {
        /// Widths of the hidden layers of both networks.
        hidden: Vec<u32> = vec![256, 128], "1 to 8 widths, each 1 to 4096"
            => |v| (1..=8).contains(&v.len()) && v.iter().all(|w| (1..=4096).contains(w));
        /// Natural logarithm of the initial standard deviation of each action.
        init_log_std: f64 = -0.5, "-5 to 2" => |v| (-5.0..=2.0).contains(v);
        /// Limit to which normalised observations are clipped, in both directions.
        observation_clip: f64 = 10.0, "above 0" => |v| *v > 0.0 && v.is_finite();
    }
}

section! {
    /// Proximal policy optimisation.
    PpoConfig as "ppo" {
        /// Fewest transitions of one update; a batch holds all that the actors have delivered. A new run replaces 0 by 2,048
        /// if its networks are equivariant, and by 4,096 if they are dense.
        batch: u32 = 0, "0 to 16777216" => |v| *v <= 16_777_216;
        /// Transitions of one update that automatic fragments do not exceed; in learner.mode "async" no batch does.
        batch_max: u32 = 131_072, "0 to 16777216; less than ppo.batch counts as ppo.batch" => |v| *v <= 16_777_216;
        /// Transitions of one gradient step; 0 means 512, or a whole batch that is smaller.
        minibatch: u32 = 0, "0 to ppo.batch" => |_| true;
        /// Environment steps of the run from which on batch and minibatch are twice as large; they double again when the
        /// steps have doubled, up to 8 times their size. 0 keeps them.
        batch_growth_steps: u64 = 0, "0 or more" => |_| true;
        /// Passes over the batch in one update.
        epochs: u32 = 5, "1 to 100" => |v| (1..=100).contains(v);
        /// Fewest passes in learner.mode "async", used when experience waits although batches have their largest size.
        epochs_min: u32 = 1, "1 to ppo.epochs; more than that counts as ppo.epochs" => |v| (1..=100).contains(v);
        /// Discount of future reward per control step.
        gamma: f64 = 0.99, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Bias-variance trade-off of generalised advantage estimation.
        gae_lambda: f64 = 0.95, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Range around 1 to which the probability ratio is clipped.
        clip_range: f64 = 0.2, "above 0, at most 1" => |v| *v > 0.0 && *v <= 1.0;
        /// Whether the networks act mirrored in mirrored states, with left and right exchanged, with half of the parameters:
        /// "auto" where robot and task have a mirror image and the widths of policy.hidden are even.
        symmetry: Symmetry = Symmetry::Auto, "\"auto\", \"off\" or \"equivariant\"" => |_| true;
        /// Weight of the value loss.
        value_coefficient: f64 = 1.0, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Weight of the entropy bonus.
        entropy_coefficient: f64 = 0.0, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Weight of the squared excess of action means over ppo.bounds_limit.
        bounds_coefficient: f64 = 5e-4, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Absolute action mean above which the bounds loss applies, in units of the action range.
        bounds_limit: f64 = 1.1, "above 0" => |v| *v > 0.0 && v.is_finite();
        /// Largest Euclidean norm of the gradient.
        max_grad_norm: f64 = 1.0, "above 0" => |v| *v > 0.0 && v.is_finite();
        /// Learning rate of Adam at the start.
        learning_rate: f64 = 3e-4, "above 0, at most 1" => |v| *v > 0.0 && *v <= 1.0;
        /// Lowest learning rate that adaptation may reach.
        learning_rate_min: f64 = 1e-5, "above 0, at most ppo.learning_rate_max" => |v| *v > 0.0 && v.is_finite();
        /// Highest learning rate that adaptation may reach.
        learning_rate_max: f64 = 1e-3, "at least ppo.learning_rate_min, at most 1" => |v| *v > 0.0 && *v <= 1.0;
        /// Target KL divergence. Above twice this value the learning rate is divided by 1.5, below half of it multiplied by
        /// 1.5; 0 keeps it fixed.
        target_kl: f64 = 0.04, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Factor on rewards before returns are computed.
        reward_scale: f64 = 0.1, "above 0" => |v| *v > 0.0 && v.is_finite();
    }
}

section! {
    /// Learner: mode, intake and checkpoints.
    LearnerConfig as "learner" {
        /// Threads of the update; 0 means one per core.
        threads: u32 = 0, "0 to 256" => |v| *v <= 256;
        /// Rows of a gradient step that a thread takes at a time; results depend on it in their last bits. A new run
        /// replaces 0 by the most, up to 256, with which its threads all find work; later 0 means 256.
        chunk_rows: u32 = 0, "0, 64, 128 or 256" => |v| [0, 64, 128, 256].contains(v);
        /// Whether a batch holds only experience of the newest policy and actors wait ("sync"), or also of older ones and
        /// actors never idle ("async").
        mode: LearnerMode = LearnerMode::Sync, "\"sync\" or \"async\"" => |_| true;
        /// Versions that a fragment's policy may lag behind the newest in mode "async"; older fragments are dropped and
        /// counted.
        max_policy_lag: u32 = 8, "0 to 100" => |v| *v <= 100;
        /// Fragments that may wait in the learner's queue.
        intake_fragments: u32 = 4096, "1 to 65536" => |v| (1..=65_536).contains(v);
        /// Malformed fragments in a row after which a sender is put in quarantine for 60 s.
        quarantine_after: u32 = 8, "1 to 1000" => |v| (1..=1000).contains(v);
        /// Updates in a row that may be undone, because a number is not finite, before the run stops.
        undone_max: u32 = 10, "1 to 1000" => |v| (1..=1000).contains(v);
        /// Numbered checkpoints kept beside `latest` and `best`.
        keep_checkpoints: u32 = 3, "0 to 1000" => |v| *v <= 1000;
        /// Updates between two numbered checkpoints.
        checkpoint_every_updates: u32 = 200, "1 to 1000000" => |v| (1..=1_000_000).contains(v);
        /// Shortest time between two updates whose metrics are logged; 0 logs all, as deterministic runs do. Evaluations and
        /// the last update are always logged.
        metrics_every_ms: u32 = 500, "0 to 3600000" => |v| *v <= 3_600_000;
        /// Updates between two outputs of all metrics with `--log-metrics`.
        table_every_updates: u32 = 50, "1 to 1000000" => |v| (1..=1_000_000).contains(v);
    }
}

section! {
    /// Evaluation during training.
    EvaluationConfig as "eval" {
        /// Environment steps between two evaluations of the current policy; 0 disables them.
        every_steps: u64 = 200_000, "0 to 1000000000000" => |v| *v <= 1_000_000_000_000;
        /// Deterministic episodes of one evaluation, without randomisation and always from the same initial states.
        episodes: u32 = 10, "1 to 1000" => |v| (1..=1000).contains(v);
    }
}

section! {
    /// Message bus.
    BusConfig as "bus" {
        /// Milliseconds that an actor waits for the receipt of a fragment before it sends the fragment again.
        receipt_timeout_ms: u64 = 60_000, "1000 to 3600000" => |v| (1000..=3_600_000).contains(v);
        /// Milliseconds between two polls for a newer policy without an announcement, jittered.
        policy_poll_ms: u64 = 10_000, "100 to 600000" => |v| (100..=600_000).contains(v);
        /// Milliseconds between two statistics messages of an actor.
        stats_every_ms: u64 = 2000, "100 to 600000" => |v| (100..=600_000).contains(v);
    }
}

/// Returns whether a text may group runs.
fn is_tag(text: &str) -> bool {
    (1..=32).contains(&text.chars().count())
        && !text.contains(|letter: char| letter.is_whitespace() || letter.is_control())
}

impl RolloutConfig {
    /// Shortest automatic fragment in control steps.
    pub const STEPS_MIN: u32 = 8;
    /// Longest automatic fragment of an actor at the usual speed. Fewer environments than fill a batch with it deliver
    /// several fragments for each batch.
    pub const STEPS_MAX: u32 = 128;
}

impl PpoConfig {
    /// Transitions of one gradient step if `minibatch` is 0.
    const MINIBATCH_ROWS: u32 = 512;
    /// Most doublings of a batch during a run.
    const DOUBLINGS_MAX: u32 = 3;

    /// Returns the transitions of one gradient step, for batches that are as large.
    pub fn minibatch_rows(&self) -> usize {
        (if self.minibatch == 0 { Self::MINIBATCH_ROWS } else { self.minibatch }) as usize
    }

    /// Returns the factor on batch and minibatch after so many environment steps. Late in a run, noisy gradients keep a
    /// policy from its best, and a larger batch has the effect of a lower learning rate (Smith et al. 2018,
    /// arXiv:1711.00489).
    pub fn growth(&self, env_steps: u64) -> u32 {
        let times = env_steps.checked_div(self.batch_growth_steps).unwrap_or(0);
        let doublings = u64::BITS - times.leading_zeros();
        1 << doublings.min(Self::DOUBLINGS_MAX)
    }

    /// Returns these settings with a batch and minibatch that have grown.
    pub fn grown(&self, env_steps: u64) -> Self {
        let growth = self.growth(env_steps);
        let minibatch = (self.minibatch_rows() as u32).saturating_mul(growth);
        Self { batch: self.batch.saturating_mul(growth), minibatch, ..self.clone() }
    }

    /// Replaces a batch of 0 by that of equivariant or dense networks. Small batches harm dense ones.
    pub fn choose_batch(&mut self, is_equivariant: bool) {
        if self.batch == 0 {
            self.batch = if is_equivariant { 2048 } else { 4096 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::PpoConfig;

    #[test]
    fn batches_double_when_the_steps_have_doubled() {
        let ppo = PpoConfig { batch: 2048, batch_growth_steps: 1000, ..PpoConfig::default() };
        let growth = [0, 999, 1000, 1999, 2000, 3999, 4000, u64::MAX].map(|steps| ppo.growth(steps));
        assert_eq!(growth, [1, 1, 2, 2, 4, 4, 8, 8]);
        let grown = ppo.grown(2000);
        assert_eq!((grown.batch, grown.minibatch), (8192, 2048));
        assert_eq!(PpoConfig { batch_growth_steps: 0, ..ppo }.growth(u64::MAX), 1);
    }
}

//! External tasks and their registration.

use prost::Message;

use crate::{
    Malformed, check_finite, check_range, check_size,
    ident::{check_ident, check_task_name},
    limits::{TASK_BYTES_MAX, WIDTH_MAX},
    mirror, wire,
};

pub use wire::{Task, TaskReceipt};

impl std::fmt::Display for Task {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(to, "`{}` ({} observations, {} actions)", self.name, self.observation_size, self.action_size)
    }
}

impl Task {
    /// Checks name, sizes and ranges.
    pub fn check(&self) -> Result<(), Malformed> {
        check_task_name("task.name", &self.name)?;
        check_range("task.observation_size", self.observation_size, WIDTH_MAX)?;
        check_range("task.action_size", self.action_size, WIDTH_MAX)?;
        for (field, range) in [("task.action_low", &self.action_low), ("task.action_high", &self.action_high)] {
            if range.len() != self.action_size as usize {
                let expected = format!("{}, as task.action_size says", self.action_size);
                return Err(Malformed::length(field, range.len(), expected));
            }
            check_finite(field, range.iter().copied())?;
        }
        if let Some((low, high)) = self.action_low.iter().zip(&self.action_high).find(|(low, high)| low >= high) {
            return Err(Malformed::field("task.action_low", low, format!("below task.action_high, which is {high}")));
        }
        if !(self.control_step_s.is_finite() && self.control_step_s >= 0.0) {
            return Err(Malformed::field("task.control_step_s", self.control_step_s, "0 or more"));
        }
        self.check_mirror()
    }

    fn check_mirror(&self) -> Result<(), Malformed> {
        let (observation, action) = (&self.observation_mirror, &self.action_mirror);
        mirror::check("task.observation_mirror", observation, self.observation_size as usize)?;
        mirror::check("task.action_mirror", action, self.action_size as usize)?;
        if observation.is_empty() != action.is_empty() {
            let empty = if action.is_empty() { "task.action_mirror" } else { "task.observation_mirror" };
            return Err(Malformed::field(empty, "empty", "as long as the other mirror image"));
        }
        // Policies output shares of the range, and a mirrored share must be the mirrored action.
        let range = |entry: usize| (self.action_low[entry], self.action_high[entry]);
        let differs = |(entry, number): &(usize, &i32)| {
            let (low, high) = range(number.unsigned_abs() as usize - 1);
            range(*entry) != if **number > 0 { (low, high) } else { (-high, -low) }
        };
        match action.iter().enumerate().find(differs) {
            None => Ok(()),
            Some((entry, number)) => {
                let ((low, high), (to_low, to_high)) = (range(entry), range(number.unsigned_abs() as usize - 1));
                let value = format!("{number} at entry {}, whose range is {low} to {high}", entry + 1);
                let expected = format!("an entry with the mirrored range, not one of {to_low} to {to_high}");
                Err(Malformed::field("task.action_mirror", value, expected))
            }
        }
    }

    /// Returns why an actor of `other` cannot join a run of this task; `None` if it can.
    pub fn differs_from(&self, other: &Self) -> Option<String> {
        if self == other {
            return None;
        }
        if (&self.name, self.observation_size, self.action_size)
            != (&other.name, other.observation_size, other.action_size)
        {
            return Some(format!("this run trains {self}; you registered {other}"));
        }
        let fields = |task: &Self| {
            [
                ("action_low", format!("{:?}", task.action_low)),
                ("action_high", format!("{:?}", task.action_high)),
                ("control_step_s", task.control_step_s.to_string()),
                ("observation_mirror", format!("{:?}", task.observation_mirror)),
                ("action_mirror", format!("{:?}", task.action_mirror)),
            ]
        };
        let ((field, ours), (_, theirs)) = fields(self).into_iter().zip(fields(other)).find(|(a, b)| a != b)?;
        Some(format!("this run trains {self} with task.{field} {ours}, you registered {theirs}"))
    }
}

/// Registration of an actor of an external task, its first message to the learner.
#[derive(Clone, Debug, PartialEq)]
pub struct TaskRegistration {
    /// Name of the run to join.
    pub run: String,
    /// Name of the actor.
    pub actor: String,
    /// Task that the actor simulates.
    pub task: Task,
}

impl TaskRegistration {
    /// Encodes as protobuf.
    pub fn encode(&self) -> Result<Vec<u8>, Malformed> {
        self.check()?;
        let task = Some(self.task.clone());
        Ok(wire::TaskRegistration { run: self.run.clone(), actor: self.actor.clone(), task }.encode_to_vec())
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode(bytes: &[u8]) -> Result<Self, Malformed> {
        check_size("task", bytes.len(), TASK_BYTES_MAX)?;
        let message = wire::TaskRegistration::decode(bytes).map_err(Malformed::undecodable("task registration"))?;
        let task = message.task.ok_or_else(|| Malformed::field("task", "missing", "a task"))?;
        let registration = Self { run: message.run, actor: message.actor, task };
        registration.check()?;
        Ok(registration)
    }

    fn check(&self) -> Result<(), Malformed> {
        check_ident("run", &self.run)?;
        check_ident("actor", &self.actor)?;
        self.task.check()
    }
}

impl TaskReceipt {
    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Decodes untrusted protobuf bytes of limited size.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        check_size("task", bytes.len(), TASK_BYTES_MAX)?;
        Self::decode(bytes).map_err(Malformed::undecodable("task receipt"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn task() -> Task {
        Task {
            name: "gymnasium/Pendulum-v1".into(),
            observation_size: 3,
            action_size: 1,
            action_low: vec![-2.0],
            action_high: vec![2.0],
            control_step_s: 0.05,
            observation_mirror: vec![1, -2, -3],
            action_mirror: vec![-1],
        }
    }

    fn registration(task: Task) -> TaskRegistration {
        TaskRegistration { run: "run".into(), actor: "gym-1".into(), task }
    }

    #[test]
    fn registrations_and_receipts_round_trip() {
        let registration = registration(task());
        assert_eq!(TaskRegistration::decode(&registration.encode().unwrap()).unwrap(), registration);
        for task in [None, Some(task())] {
            let receipt = TaskReceipt { accepted: task.is_some(), reason: "because".into(), task };
            assert_eq!(TaskReceipt::decode_checked(&receipt.to_bytes()).unwrap(), receipt);
        }
    }

    #[test]
    fn the_error_names_the_bad_field() {
        type Corrupt = fn(&mut Task);
        let cases: [(&str, Corrupt); 13] = [
            ("task.name", |task| task.name = "treadmill/humanoid-v5".into()),
            ("task.observation_size", |task| task.observation_size = 0),
            ("task.observation_size", |task| task.observation_size = 4097),
            ("task.action_size", |task| task.action_size = u32::MAX),
            ("task.action_low", |task| task.action_low = vec![]),
            ("task.action_high", |task| task.action_high = vec![f64::INFINITY]),
            ("task.action_low", |task| task.action_low = vec![2.0]),
            ("task.control_step_s", |task| task.control_step_s = f64::NAN),
            ("task.observation_mirror", |task| task.observation_mirror = vec![1, 2]),
            ("task.observation_mirror", |task| task.observation_mirror = vec![1, i32::MIN, 3]),
            ("task.observation_mirror", |task| task.observation_mirror = vec![2, 3, 1]),
            ("task.action_mirror", |task| task.action_mirror = vec![]),
            ("task.action_mirror", |task| task.action_low = vec![-1.0]),
        ];
        for (field, corrupt) in cases {
            let mut bad = task();
            corrupt(&mut bad);
            let unchecked = wire::TaskRegistration { run: "run".into(), actor: "a".into(), task: Some(bad) };
            let why = TaskRegistration::decode(&unchecked.encode_to_vec()).unwrap_err().to_string();
            assert!(why.contains(&format!("`{field}`")), "{field}: {why}");
        }
        let nameless = TaskRegistration { run: "A/B".into(), ..registration(task()) };
        assert!(nameless.encode().unwrap_err().to_string().contains("`run`"));
        let huge = vec![0; TASK_BYTES_MAX + 1];
        assert!(TaskRegistration::decode(&huge).unwrap_err().to_string().contains("more than"));
    }

    #[test]
    fn the_reason_names_the_difference() {
        assert_eq!(task().differs_from(&task()), None);
        let other = Task { name: "gymnasium/Other-v0".into(), ..task() };
        let why = task().differs_from(&other).unwrap();
        assert_eq!(
            why,
            "this run trains `gymnasium/Pendulum-v1` (3 observations, 1 actions); you registered `gymnasium/Other-v0` (3 \
             observations, 1 actions)"
        );
        let weak = Task { action_high: vec![1.0], ..task() };
        assert!(task().differs_from(&weak).unwrap().contains("task.action_high [2.0], you registered [1.0]"));
        let slow = Task { control_step_s: 0.1, ..task() };
        assert!(task().differs_from(&slow).unwrap().contains("task.control_step_s 0.05"));
        let other = Task { observation_mirror: vec![1, 3, 2], ..task() };
        assert!(
            task().differs_from(&other).unwrap().contains("task.observation_mirror [1, -2, -3], you registered [1, 3")
        );
    }

    proptest! {
        #[test]
        fn random_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
            let _ = TaskRegistration::decode(&bytes);
            let _ = TaskReceipt::decode_checked(&bytes);
        }
    }
}

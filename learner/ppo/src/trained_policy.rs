//! Policy that an update leaves.

use treadmill_policy::normaliser::RunningMoments;

/// Policy with its critic, as it is published, exported, and adopted by a new run.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainedPolicy {
    /// Actor, log standard deviations and critic of dense networks, in the order of
    /// [`NetworkShape`](treadmill_policy::NetworkShape).
    pub parameters: Vec<f32>,
    /// Statistics of raw observations.
    pub observation_moments: RunningMoments,
    /// Statistics of scaled returns, the units of the critic; `None` if they are unknown.
    pub value_moments: Option<RunningMoments>,
}

//! Values that are one of a few names.

use serde::{Deserialize, Serialize};

/// Declares an enum whose variants are written as names, and the list of these names.
macro_rules! choice {
    (
        $(#[$meta:meta])*
        $name:ident { $( $(#[$variant_meta:meta])* $variant:ident = $text:literal, )* }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        pub enum $name {
            $( $(#[$variant_meta])* #[serde(rename = $text)] $variant, )*
        }

        impl $name {
            /// Names of the variants in a configuration.
            pub const NAMES: &[&str] = &[$($text),*];

            /// Returns the name of this variant.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $( Self::$variant => $text, )*
                }
            }
        }
    };
}

choice! {
    /// Task: one of Gymnasium's, or an external one.
    EnvTask {
        /// Humanoid-v5.
        HumanoidV5 = "humanoid-v5",
        /// Humanoid-v4.
        HumanoidV4 = "humanoid-v4",
        /// Walking at commanded velocities, for robots with a card.
        Velocity = "velocity",
        /// Task that other programs simulate and register.
        External = "external",
    }
}

choice! {
    /// Observation of the policy.
    EnvObservation {
        /// Positions and velocities.
        Compact = "compact",
        /// Observation of Gymnasium's Humanoid-v5.
        GymnasiumV5 = "gymnasium-v5",
        /// Observation of Gymnasium's Humanoid-v4.
        GymnasiumV4 = "gymnasium-v4",
    }
}

choice! {
    /// Precision of observations.
    ObservationPrecision {
        /// Single precision.
        F32 = "f32",
        /// Half precision.
        F16 = "f16",
    }
}

choice! {
    /// Policy versions whose experience a batch may hold.
    LearnerMode {
        /// The newest only; actors wait during an update.
        Sync = "sync",
        /// Older ones, too; actors continue during an update.
        Async = "async",
    }
}

choice! {
    /// Use of the symmetry of left and right in an update.
    Symmetry {
        /// Unused.
        Off = "off",
        /// Adds the mirror image of each transition.
        Mirrored = "mirrored",
    }
}

/// Returns the names allowed for a type as in [`super::KeyDoc::kind`]; `None` if it is no choice.
pub(super) fn names(kind: &str) -> Option<&'static [&'static str]> {
    match kind {
        "EnvTask" => Some(EnvTask::NAMES),
        "EnvObservation" => Some(EnvObservation::NAMES),
        "ObservationPrecision" => Some(ObservationPrecision::NAMES),
        "LearnerMode" => Some(LearnerMode::NAMES),
        "Symmetry" => Some(Symmetry::NAMES),
        _ => None,
    }
}

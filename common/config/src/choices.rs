//! Keys whose value is one of a few names.

use serde::{Deserialize, Serialize};

/// Declares an enum that is written by name, and the list of its names.
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
            /// The names, as a configuration gives them.
            pub const NAMES: &[&str] = &[$($text),*];

            /// Its name.
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
    /// Which of Gymnasium's tasks it is, or that it is none of ours.
    EnvTask {
        /// Humanoid-v5.
        HumanoidV5 = "humanoid-v5",
        /// Humanoid-v4.
        HumanoidV4 = "humanoid-v4",
        /// What actors of other programs simulate, and register.
        External = "external",
    }
}

choice! {
    /// Which numbers the policy sees.
    EnvObservation {
        /// Positions and velocities.
        Compact = "compact",
        /// What Gymnasium's Humanoid-v5 observes.
        GymnasiumV5 = "gymnasium-v5",
        /// What Gymnasium's Humanoid-v4 observes.
        GymnasiumV4 = "gymnasium-v4",
    }
}

choice! {
    /// How exactly observations travel, and are seen.
    ObservationPrecision {
        /// Single precision.
        F32 = "f32",
        /// Half precision.
        F16 = "f16",
    }
}

choice! {
    /// Which policy versions a batch is made of.
    LearnerMode {
        /// The newest alone: actors wait while it is improved.
        Sync = "sync",
        /// Also somewhat older ones: actors go on while it is improved.
        Async = "async",
    }
}

choice! {
    /// What an update makes of the symmetry of left and right.
    Symmetry {
        /// Nothing.
        Off = "off",
        /// A mirror image of each transition.
        Mirrored = "mirrored",
    }
}

/// The names that a key of this type (as [`super::KeyDoc::kind`] has it) may take; `None` for other types.
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

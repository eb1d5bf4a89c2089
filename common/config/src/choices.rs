//! Values that are one of a few names.

use treadmill_settings::choice;

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
    /// Use of the symmetry of left and right by the networks.
    Symmetry {
        /// Equivariant networks where the task and the robot have a mirror image, dense ones elsewhere.
        Auto = "auto",
        /// Dense networks.
        Off = "off",
        /// Networks that act mirrored in mirrored states.
        Equivariant = "equivariant",
    }
}

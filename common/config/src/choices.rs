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
    /// Use of the symmetry of left and right in an update.
    Symmetry {
        /// Unused.
        Off = "off",
        /// Adds the mirror image of each transition.
        Mirrored = "mirrored",
    }
}

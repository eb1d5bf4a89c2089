//! Settings of the motion task: what is compared, how episodes begin and end, and the terms of its reward.

use crate::section;

/// Declares the keys of the task, and each term of its reward once: its documentation, key, weight and mjlab's name.
macro_rules! motion {
    (
        keys { $($keys:tt)* }
        terms { $( $(#[doc = $doc:literal])+ $name:ident = $weight:expr, $mjlab:literal; )* }
    ) => {
        section! {
            /// Motion task: the robot imitates motions that `--motion` gives; see docs/guide/motion.md. Each weight of a
            /// term has the name of mjlab's term without `motion_`, and the reward of a control step is the sum of weight
            /// times term. mjlab's costs are three to ten times as large, and its offsets at the start up to eight times:
            /// with them, a run with few environments learns more slowly (`experiments/robots/motion_search.csv`).
            MotionConfig as "motion" {
                $($keys)*
                $( $(#[doc = $doc])+ $name: f64 = $weight, "a finite number" => |v| v.is_finite(); )*
            }
        }

        /// Number of terms of the reward.
        pub const MOTION_TERMS: usize = [$(stringify!($name)),*].len();

        /// Terms of the motion task's reward for a control step, without weights.
        pub trait MotionRewards {
            $( $(#[doc = $doc])+ fn $name(&self) -> f64; )*

            /// Returns all terms, in the order of [`MotionConfig::TERM_NAMES`].
            fn values(&self) -> [f64; MOTION_TERMS] {
                [$( self.$name() ),*]
            }
        }

        impl MotionConfig {
            /// Names of the terms in mjlab's tracking task, in order.
            pub const TERM_NAMES: [&str; MOTION_TERMS] = [$($mjlab),*];

            /// Returns whether every key has its default.
            #[must_use]
            pub fn is_default(&self) -> bool {
                *self == Self::default()
            }

            /// Returns the weights, in order.
            #[must_use]
            pub fn weights(&self) -> [f64; MOTION_TERMS] {
                [$( self.$name ),*]
            }
        }
    };
}

/// Most names in a list of links.
const LINKS_MAX: usize = 256;

motion! {
    keys {
        /// Link of the robot whose pose is the frame of comparison; empty means: the one that carries the arms, or else the
        /// base.
        anchor: String = String::new(), "at most 128 characters in one line" => |name| is_name(name);
        /// Links whose poses and velocities are compared; empty means: the anchor, the base, and of each limb the end and
        /// those that lie apart.
        bodies: Vec<String> = Vec::new(), "at most 256 names" => |names| is_list(names);
        /// Links at the ends of the limbs, whose heights may end an episode; empty means: the last one of each limb.
        end_effectors: Vec<String> = Vec::new(), "at most 256 names" => |names| is_list(names);
        /// Whether the policy knows where it is: it then sees the error of the anchor's position and the velocity of the
        /// base.
        state_estimation: bool = true, "true or false" => |_| true;
        /// Whether an action of 0 asks the servos for the angles of the motion, and not for those of the default pose. The
        /// exported ONNX adds them itself, so that its players need not know.
        residual_action: bool = true, "true or false" => |_| true;
        /// Number of further control steps whose reference angles the policy sees.
        future_steps: u32 = 0, "0 to 16" => |v| *v <= 16;
        /// Share of the episodes that begin at the first frame of a motion, in training.
        first_share: f64 = 0.2, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Share of the episodes that begin anywhere in the motions, in training. The others begin up to
        /// `motion.lead_s` before the frame at which this environment failed last.
        uniform_share: f64 = 0.3, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Longest time before the last failure at which an episode begins, in seconds.
        lead_s: f64 = 1.5, "0.1 to 60" => |v| (0.1..=60.0).contains(v);
        /// Greatest offset of the base from the motion at the start of an episode: along x and y (m).
        start_xy_m: f64 = 0.05, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// The same along z (m).
        start_z_m: f64 = 0.01, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// The same of roll and pitch (rad).
        start_tilt_rad: f64 = 0.05, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// The same of the heading (rad).
        start_yaw_rad: f64 = 0.2, "0 to 3.2" => |v| (0.0..=3.2).contains(v);
        /// The same of the horizontal velocity of the base, along x and y (m/s).
        start_xy_mps: f64 = 0.1, "0 to 5" => |v| (0.0..=5.0).contains(v);
        /// The same of its vertical velocity (m/s).
        start_z_mps: f64 = 0.05, "0 to 5" => |v| (0.0..=5.0).contains(v);
        /// The same of its roll and pitch rates (rad/s).
        start_tilt_radps: f64 = 0.1, "0 to 10" => |v| (0.0..=10.0).contains(v);
        /// The same of its yaw rate (rad/s).
        start_yaw_radps: f64 = 0.1, "0 to 10" => |v| (0.0..=10.0).contains(v);
        /// The same of each hinge (rad).
        start_hinge_rad: f64 = 0.05, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Error of the anchor's height that ends an episode, in metres.
        anchor_height_max_m: f64 = 0.25, "0.01 to 100" => |v| (0.01..=100.0).contains(v);
        /// Error of the vertical part of gravity's direction in the anchor's frame that ends an episode.
        anchor_tilt_max: f64 = 0.8, "0.01 to 2" => |v| (0.01..=2.0).contains(v);
        /// Error of an end effector's height that ends an episode, in metres.
        end_effector_height_max_m: f64 = 0.25, "0.01 to 100" => |v| (0.01..=100.0).contains(v);
        /// Width of the term `global_root_pos`, in metres.
        global_root_pos_std_m: f64 = 0.3, "0.001 to 100" => is_width;
        /// Width of the term `global_root_ori`, in rad.
        global_root_ori_std_rad: f64 = 0.4, "0.001 to 100" => is_width;
        /// Width of the term `body_pos`, in metres.
        body_pos_std_m: f64 = 0.3, "0.001 to 100" => is_width;
        /// Width of the term `body_ori`, in rad.
        body_ori_std_rad: f64 = 0.4, "0.001 to 100" => is_width;
        /// Width of the term `body_lin_vel`, in m/s.
        body_lin_vel_std_mps: f64 = 1.0, "0.001 to 100" => is_width;
        /// Width of the term `body_ang_vel`, in rad/s.
        body_ang_vel_std_radps: f64 = std::f64::consts::PI, "0.001 to 100" => is_width;
    }
    terms {
        /// exp(-e²/width²) of the distance e between the anchor and that of the motion (m).
        global_root_pos = 0.5, "motion_global_root_pos";
        /// exp(-e²/width²) of the angle e between the anchor and that of the motion (rad).
        global_root_ori = 0.5, "motion_global_root_ori";
        /// exp(-m/width²) of the mean m over `motion.bodies` of the squared distance from the motion (m²), which is moved
        /// and turned about the vertical so that the anchors lie above each other.
        body_pos = 1.0, "motion_body_pos";
        /// The same of the squared angle (rad²).
        body_ori = 1.0, "motion_body_ori";
        /// The same of the squared difference of the velocities, without moving the motion (m²/s²).
        body_lin_vel = 1.0, "motion_body_lin_vel";
        /// The same of the angular velocities (rad²/s²).
        body_ang_vel = 1.0, "motion_body_ang_vel";
        /// Squared change of the action from step to step, in units of the action.
        action_rate = -0.03, "action_rate_l2";
        /// Angle beyond nine tenths of the hinges' ranges (rad).
        joint_limit = -2.0, "joint_limit";
        /// 1 if the robot touches itself with more than 10 N at the end of the step.
        self_collisions = -1.0, "self_collisions";
    }
}

fn is_name(name: &str) -> bool {
    name.chars().count() <= 128 && !name.contains(char::is_control)
}

fn is_list(names: &[String]) -> bool {
    names.len() <= LINKS_MAX && names.iter().all(|name| !name.is_empty() && is_name(name))
}

fn is_width(width: &f64) -> bool {
    (1e-3..=100.0).contains(width)
}

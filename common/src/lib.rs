//! Treadmill: common.

//! Whether the fast kernels compute on this processor what plain operations do.

use treadmill_policy::{NetworkShape, agreement};

use super::finding::Finding;

const NAME: &str = "networks";

/// Both sum in their own order; more than this is no rounding.
const OFF_MAX: f32 = 1e-4;

/// Computes the default networks both ways.
pub fn diagnose() -> Finding {
    let shape = NetworkShape { observation: 45, action: 17, hidden: vec![256, 128] };
    assess(agreement::largest_difference(&shape).map_err(|why| why.to_string()))
}

fn assess(off: Result<f32, String>) -> Finding {
    match off {
        Ok(off) if off <= OFF_MAX => Finding::ok(NAME, format!("fused and plain ones differ by {off:.0e} at most")),
        Ok(off) => Finding::problem(
            NAME,
            format!("fused and plain ones differ by {off}, and not only by rounding"),
            "this processor or this build computes wrongly: build anew on this machine, test its memory, and report it",
        ),
        Err(why) => Finding::problem(NAME, format!("they cannot be computed: {why}"), "build anew, and report it"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn more_than_rounding_is_a_problem() {
        assert_eq!(assess(Ok(1e-6)).severity, Severity::Ok);
        for off in [0.01, f32::INFINITY, f32::NAN] {
            assert_eq!(assess(Ok(off)).severity, Severity::Problem, "{off}");
        }
        assert!(assess(Err("no memory".to_string())).seen.contains("no memory"));
    }
}

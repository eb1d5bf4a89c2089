//! Whether the fast kernels compute on this processor what plain operations do.

use treadmill_policy::{NetworkShape, agreement};

use super::finding::Finding;

const NAME: &str = "networks";

/// Both sum in their own order; more than this is no rounding.
const OFF_MAX: f32 = 1e-4;

/// Computes the default networks both ways.
pub fn look() -> Finding {
    let shape = NetworkShape { observation: 45, action: 17, hidden: vec![256, 128] };
    judge(agreement::largest_difference(&shape).map_err(|why| why.to_string()))
}

fn judge(off: Result<f32, String>) -> Finding {
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
    use crate::check::finding::Verdict;

    #[test]
    fn more_than_rounding_is_a_problem() {
        assert_eq!(judge(Ok(1e-6)).verdict, Verdict::Ok);
        for off in [0.01, f32::INFINITY, f32::NAN] {
            assert_eq!(judge(Ok(off)).verdict, Verdict::Problem, "{off}");
        }
        assert!(judge(Err("no memory".to_string())).seen.contains("no memory"));
    }
}

//! Whether there is a GPU, in builds that could use one.

use treadmill_policy::device::{DeviceError, DeviceKind};

use super::finding::Finding;

const NAME: &str = "gpu";

/// Of this build and this machine.
pub fn look() -> Finding {
    judge(DeviceKind::Cuda.open().map(drop))
}

fn judge(opened: Result<(), DeviceError>) -> Finding {
    match opened {
        Ok(()) => Finding::ok(NAME, "CUDA device 0 can be used: --device cuda"),
        Err(DeviceError::NotBuilt) => Finding::ok(NAME, "none wanted: this build computes on the processor"),
        Err(why) => Finding::note(NAME, why.to_string(), "without --device cuda nothing needs it"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::finding::Verdict;

    #[test]
    fn a_build_with_cuda_tells_of_a_missing_device() {
        assert_eq!(judge(Ok(())).verdict, Verdict::Ok);
        assert_eq!(judge(Err(DeviceError::NotBuilt)).verdict, Verdict::Ok);
        let found = judge(Err(DeviceError::Absent { why: "no driver".to_string() }));
        assert!(found.verdict == Verdict::Note && found.seen.contains("no driver"));
    }
}

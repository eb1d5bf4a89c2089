//! Whether there is a GPU, in builds that could use one.

use treadmill_policy::device::{DeviceError, DeviceKind};

use super::finding::Finding;

const NAME: &str = "gpu";

/// Of this build and this machine.
pub fn diagnose() -> Finding {
    assess(DeviceKind::Cuda.open().map(drop))
}

fn assess(opened: Result<(), DeviceError>) -> Finding {
    match opened {
        Ok(()) => Finding::ok(NAME, "CUDA device 0 can be used: --device cuda"),
        Err(DeviceError::NotBuilt) => Finding::ok(NAME, "none wanted: this build computes on the processor"),
        Err(why) => Finding::note(NAME, why.to_string(), "without --device cuda nothing needs it"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn a_build_with_cuda_tells_of_a_missing_device() {
        assert_eq!(assess(Ok(())).severity, Severity::Ok);
        assert_eq!(assess(Err(DeviceError::NotBuilt)).severity, Severity::Ok);
        let found = assess(Err(DeviceError::Absent { why: "no driver".to_string() }));
        assert!(found.severity == Severity::Note && found.seen.contains("no driver"));
    }
}

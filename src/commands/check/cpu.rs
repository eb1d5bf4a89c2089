//! Which vector instructions there are, and so which kernels compute the networks.

use treadmill_runtime::machine;

use super::finding::Finding;

const NAME: &str = "cpu";

/// What matters of a processor.
#[derive(Clone, Copy, Debug, Default)]
struct Features {
    is_x86: bool,
    avx2_fma: bool,
    avx512: bool,
}

/// Of this processor.
pub fn diagnose() -> Finding {
    assess(features(), &machine::cpu_name())
}

/// The same sets that the kernels are compiled for (`common/src/policy/elementwise.rs`).
#[cfg(target_arch = "x86_64")]
fn features() -> Features {
    Features {
        is_x86: true,
        avx2_fma: is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
        avx512: is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512cd")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl"),
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn features() -> Features {
    Features::default()
}

fn assess(features: Features, name: &str) -> Finding {
    match features {
        Features { avx512: true, .. } => Finding::ok(NAME, format!("{name}: kernels for AVX-512")),
        Features { avx2_fma: true, .. } => Finding::ok(NAME, format!("{name}: kernels for AVX2 and FMA")),
        Features { is_x86: true, .. } => Finding::note(
            NAME,
            format!("{name}: neither AVX2 with FMA nor AVX-512, so the networks are computed by portable kernels"),
            "expect a several times slower update; where this is a virtual machine, let it show its host's processor \
             (-cpu host in QEMU)",
        ),
        _ => Finding::ok(NAME, format!("{name}: kernels for {}", std::env::consts::ARCH)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn the_widest_kernels_are_named_and_their_lack_is_noted() {
        let seen = |avx2_fma, avx512| assess(Features { is_x86: true, avx2_fma, avx512 }, "box");
        assert!(seen(true, true).seen.contains("AVX-512"));
        assert_eq!(seen(true, false).seen, "box: kernels for AVX2 and FMA");
        let old = seen(false, false);
        assert_eq!(old.severity, Severity::Note);
        assert!(old.seen.contains("portable") && old.remedy.unwrap().contains("-cpu host"));
    }
}

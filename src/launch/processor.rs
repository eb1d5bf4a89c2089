//! Refuses a processor for which this program was not compiled, before it stops at an unknown instruction.
//!
//! `deploy/release.sh` compiles for x86-64-v3, the processors with AVX2 and FMA. A build with Cargo's defaults runs on every
//! x86-64 processor and skips this check. The standard library's `is_x86_feature_detected` would not help: it takes for
//! granted what the compiler may use.

/// Names the instruction sets that this program was compiled for and this processor lacks. Empty if there are none.
///
/// Neither allocates nor formats: the code must run where vector instructions do not.
#[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
pub(crate) fn lacks() -> impl Iterator<Item = &'static str> {
    use std::arch::x86_64::{__cpuid, __cpuid_count};

    // Bits from Intel's manual, volume 2, instruction CPUID. FMA, AVX and the rest of the first leaf also need an operating
    // system that saves wide registers (OSXSAVE).
    let basic = __cpuid(1).ecx;
    let extended = if __cpuid(0).eax >= 7 { __cpuid_count(7, 0).ebx } else { 0 };
    let long = if __cpuid(0x8000_0000).eax >= 0x8000_0001 { __cpuid(0x8000_0001).ecx } else { 0 };
    [
        ("AVX", basic, 28),
        ("AVX2", extended, 5),
        ("BMI1", extended, 3),
        ("BMI2", extended, 8),
        ("F16C", basic, 29),
        ("FMA", basic, 12),
        ("LZCNT", long, 5),
        ("MOVBE", basic, 22),
        ("OSXSAVE", basic, 27),
    ]
    .into_iter()
    .filter(|(_, register, bit)| register >> bit & 1 == 0)
    .map(|(name, _, _)| name)
}

/// Nothing: this program was compiled for every processor of its architecture.
#[cfg(not(all(target_arch = "x86_64", target_feature = "avx2")))]
pub(crate) fn lacks() -> impl Iterator<Item = &'static str> {
    std::iter::empty()
}

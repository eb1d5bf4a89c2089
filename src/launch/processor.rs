//! Refuses a processor for which this program was not compiled, before the program stops at an unknown instruction.
//!
//! `deploy/release.sh` compiles for x86-64-v3, the processors with AVX2 and FMA. A build with Cargo's defaults runs on every
//! x86-64 processor and skips this check. The standard library's `is_x86_feature_detected` would not help: it takes for
//! granted what the compiler may use.

/// Returns whether this processor has all instructions that the program was compiled for; else prints those it lacks.
///
/// The compiler may use vector instructions here, too, to move larger values. So the code moves none: it only reads
/// registers, and writes text that exists already. `deploy/release.sh` runs it on emulated processors.
#[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
#[inline(never)]
pub(crate) fn is_supported() -> bool {
    use std::{
        arch::x86_64::{__cpuid, __cpuid_count},
        io::Write,
    };

    // Bits from Intel's manual, volume 2, instruction CPUID. OSXSAVE: the operating system saves wide registers.
    let basic = __cpuid(1).ecx;
    let extended = if __cpuid(0).eax >= 7 { __cpuid_count(7, 0).ebx } else { 0 };
    let long = if __cpuid(0x8000_0000).eax >= 0x8000_0001 { __cpuid(0x8000_0001).ecx } else { 0 };
    let (osxsave, avx, fma) = (basic >> 27 & 1, basic >> 28 & 1, basic >> 12 & 1);
    let (avx2, bmi) = (extended >> 5 & 1, extended >> 3 & extended >> 8 & 1);
    // F16C, MOVBE and LZCNT.
    let rest = basic >> 29 & basic >> 22 & long >> 5 & 1;
    if osxsave & avx & fma & avx2 & bmi & rest == 1 {
        return true;
    }
    // Failures to write are ignored: the exit code remains.
    let say = |text: &[u8]| drop(std::io::stderr().write_all(text));
    say(b"error: this build of treadmill needs a processor with AVX2, FMA and BMI (x86-64-v3: Intel since 2013, AMD \
          since 2015); this one lacks");
    if osxsave & avx == 0 {
        say(b" AVX");
    }
    if avx2 == 0 {
        say(b" AVX2");
    }
    if fma == 0 {
        say(b" FMA");
    }
    if bmi == 0 {
        say(b" BMI");
    }
    if rest == 0 {
        say(b" F16C, MOVBE or LZCNT");
    }
    say(
        b"; build it from source, which runs on every x86-64 processor: cargo install --locked --path . (in a virtual \
          machine, expose the host's processor instead; QEMU: -cpu host)\n",
    );
    false
}

/// Returns true: this program was compiled for every processor of its architecture.
#[cfg(not(all(target_arch = "x86_64", target_feature = "avx2")))]
pub(crate) fn is_supported() -> bool {
    true
}

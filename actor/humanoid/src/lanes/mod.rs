//! Numbers of several worlds side by side: one world per lane of a vector register, in single precision. What needs more is
//! outside: the worlds' states, to which a pass adds its motion.
//!
//! Every operation acts on each lane by itself, so a world's numbers do not depend on its lane or on its neighbours. `pulp`
//! selects the widest registers of the machine: AVX-512 (16 lanes), AVX2 (8), NEON (4), or none (1).

/// Implements an operator that acts on each field by itself.
macro_rules! fieldwise {
    ($trait:ident, $method:ident, $type:ident, $($field:ident)*) => {
        impl<S: Simd> $trait for $type<S> {
            #[inline(always)]
            fn $method(&mut self, other: Self) {
                $(self.$field.$method(other.$field);)*
            }
        }
    };
}

mod linear;
mod spatial;
mod trigonometry;

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use pulp::bytemuck;

pub(crate) use linear::{Mat3, Vec3};
pub(crate) use pulp::{NullaryFnOnce, Scalar};
pub(crate) use spatial::{Force, Inertia, Motion};

/// Most lanes of any machine.
pub(crate) const LANES_MAX: usize = 16;

/// Registers of a machine. Numbers in memory are aligned like a register: with AVX-512, numbers across two cache lines
/// took a third more time.
pub(crate) trait Simd: pulp::Simd {
    /// Nothing, aligned like a register.
    type Aligned: Copy + Debug;
}

macro_rules! registers {
    ($simd:path, $aligned:ident, $bytes:literal) => {
        #[derive(Clone, Copy, Debug)]
        #[repr(align($bytes))]
        pub(crate) struct $aligned;

        impl Simd for $simd {
            type Aligned = $aligned;
        }
    };
}

registers!(Scalar, AlignedScalar, 4);
#[cfg(target_arch = "x86_64")]
registers!(pulp::x86::V3, AlignedV3, 32);
#[cfg(target_arch = "x86_64")]
registers!(pulp::x86::V4, AlignedV4, 64);
#[cfg(target_arch = "aarch64")]
registers!(pulp::aarch64::Neon, AlignedNeon, 16);

/// Something to do with registers of any kind.
pub(crate) trait WithRegisters {
    type Output;
    fn run<S: Simd>(&self, simd: S) -> Self::Output;
}

/// Does something with all kinds of registers of this machine, widest first.
pub(crate) fn with_registers<T: WithRegisters>(action: &T) -> Vec<T::Output> {
    let mut outputs = Vec::new();
    #[cfg(target_arch = "x86_64")]
    {
        outputs.extend(pulp::x86::V4::try_new().map(|simd| action.run(simd)));
        outputs.extend(pulp::x86::V3::try_new().map(|simd| action.run(simd)));
    }
    #[cfg(target_arch = "aarch64")]
    outputs.extend(pulp::aarch64::Neon::try_new().map(|simd| action.run(simd)));
    if outputs.is_empty() {
        outputs.push(action.run(Scalar::new()));
    }
    outputs
}

/// One number per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes<S: Simd> {
    simd: S,
    _aligned: [S::Aligned; 0],
    numbers: S::f32s,
}

/// One truth value per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mask<S: Simd> {
    simd: S,
    values: S::m32s,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn splat(simd: S, number: f64) -> Self {
        Self { simd, _aligned: [], numbers: simd.splat_f32s(number as f32) }
    }

    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        Self::splat(simd, 0.0)
    }

    /// Returns the same number in every lane, in registers like those of `self`.
    #[inline(always)]
    pub(crate) fn constant(self, number: f64) -> Self {
        Self::splat(self.simd, number)
    }

    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> f64 {
        f64::from(bytemuck::cast_slice::<S::f32s, f32>(std::slice::from_ref(&self.numbers))[lane])
    }

    #[inline(always)]
    pub(crate) fn set_lane(&mut self, lane: usize, number: f64) {
        bytemuck::cast_slice_mut::<S::f32s, f32>(std::slice::from_mut(&mut self.numbers))[lane] = number as f32;
    }

    /// Returns `self * factor + term`, rounded once where the machine can.
    #[inline(always)]
    pub(crate) fn mul_add(self, factor: Self, term: Self) -> Self {
        self.with(self.simd.mul_add_e_f32s(self.numbers, factor.numbers, term.numbers))
    }

    /// Returns `term - self * factor`, rounded once where the machine can.
    #[inline(always)]
    pub(crate) fn mul_sub_from(self, factor: Self, term: Self) -> Self {
        (-self).mul_add(factor, term)
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f32s(self.numbers))
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.with(self.simd.abs_f32s(self.numbers))
    }

    /// Returns the greater number of each lane.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(self.simd.max_f32s(self.numbers, other.numbers))
    }

    /// Returns the smaller number of each lane.
    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        self.with(self.simd.min_f32s(self.numbers, other.numbers))
    }

    #[inline(always)]
    pub(crate) fn less_than(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, values: self.simd.less_than_f32s(self.numbers, other.numbers) }
    }

    #[inline(always)]
    pub(crate) fn equals(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, values: self.simd.equal_f32s(self.numbers, other.numbers) }
    }

    #[inline(always)]
    fn with(self, numbers: S::f32s) -> Self {
        Self { numbers, ..self }
    }
}

impl<S: Simd> Mask<S> {
    /// Returns `yes` in the lanes where the mask is true and `no` in the others.
    #[inline(always)]
    pub(crate) fn select(self, yes: Lanes<S>, no: Lanes<S>) -> Lanes<S> {
        yes.with(self.simd.select_f32s(self.values, yes.numbers, no.numbers))
    }

    /// Returns the number where the mask is true and 0 elsewhere.
    #[inline(always)]
    pub(crate) fn keep(self, number: Lanes<S>) -> Lanes<S> {
        self.select(number, number.constant(0.0))
    }

    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        Self { simd: self.simd, values: self.simd.and_m32s(self.values, other.values) }
    }

    #[inline(always)]
    pub(crate) fn or(self, other: Self) -> Self {
        Self { simd: self.simd, values: self.simd.or_m32s(self.values, other.values) }
    }

    /// Returns whether the mask is true in any lane.
    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        self.simd.first_true_m32s(self.values) < S::F32_LANES
    }
}

/// Adds the products of a row with `other` to two sums in turn: one addition need not wait for the one before.
#[inline(always)]
pub(crate) fn add_products<S: Simd>(sums: &mut [Lanes<S>; 2], row: &[Lanes<S>], other: impl Fn(usize) -> Lanes<S>) {
    let (pairs, rest) = row.as_chunks::<2>();
    for (index, [one, two]) in pairs.iter().enumerate() {
        sums[0] = one.mul_add(other(2 * index), sums[0]);
        sums[1] = two.mul_add(other(2 * index + 1), sums[1]);
    }
    if let [last] = rest {
        sums[0] = last.mul_add(other(row.len() - 1), sums[0]);
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $function:ident) => {
        impl<S: Simd> $trait for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.with(self.simd.$function(self.numbers, other.numbers))
            }
        }

        impl<S: Simd> $trait<f64> for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.with(self.simd.$function(self.numbers, self.simd.splat_f32s(other as f32)))
            }
        }
    };
}

operator!(Add, add, add_f32s);
operator!(Sub, sub, sub_f32s);
operator!(Mul, mul, mul_f32s);
operator!(Div, div, div_f32s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // `neg_f32s` is a provided method, which compilers do not inline into code for wider registers.
        self.with(self.simd.xor_f32s(self.numbers, self.simd.splat_f32s(-0.0)))
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> SubAssign for Lanes<S> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

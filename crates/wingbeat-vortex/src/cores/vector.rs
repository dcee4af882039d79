//! What the vector loop is written over: the precision of its numbers, and the core models.

use crate::cores::exp2::{EXP2_POLYNOMIAL, EXPONENT, FULL, NEAREST, ONE};
use fearless_simd::{SimdFloatElement, prelude::*};

/// Squared length.
#[inline(always)]
pub(crate) fn square<S: Simd, V: SimdFloat<S>>([x, y, z]: [V; 3]) -> V {
    x * x + y * y + z * z
}

/// The numbers that the loop works with.
pub(crate) trait Precision<S: Simd> {
    type Element: SimdFloatElement + From<f32>;
    type Lanes: SimdFloat<S, Element = Self::Element>;

    /// Whether every core model looks after targets close to a filament.
    const IS_ROUGH: bool;

    /// From here on 1 - 2^-z is 1.
    const FULL: Self::Element;

    /// [`crate::direct::reference::one_minus_exp2`] in place, side by side, to a few units in the last place of
    /// this precision.
    fn one_minus_exp2<const N: usize>(simd: S, z: &mut [Self::Lanes; N]);
}

/// 53 bits.
pub(crate) struct Double;

/// 24 bits.
pub(crate) struct Float;

impl<S: Simd> Precision<S> for Double {
    type Element = f64;
    type Lanes = S::f64s;
    const IS_ROUGH: bool = false;
    const FULL: f64 = FULL;

    #[inline(always)]
    fn one_minus_exp2<const N: usize>(simd: S, z: &mut [S::f64s; N]) {
        let a = EXP2_POLYNOMIAL;
        let (full, one) = (
            S::f64s::splat(simd, <Self as Precision<S>>::FULL),
            S::f64s::splat(simd, 1.0),
        );
        let ones = S::u64s::splat(simd, ONE);
        for u in z.iter_mut() {
            let z = u.min(full);
            let shifted = z + NEAREST;
            let f = z - (shifted - NEAREST);
            let f2 = f * f;
            let even = (((f2 * a[8] + a[6]) * f2 + a[4]) * f2 + a[2]) * f2 + a[0];
            let odd = (((f2 * a[9] + a[7]) * f2 + a[5]) * f2 + a[3]) * f2 + a[1];
            let scale: S::f64s = (ones - (shifted.bitcast::<S::u64s>() << EXPONENT)).bitcast();
            *u = (one - scale) + (odd * f + even) * f * scale;
        }
    }
}

impl<S: Simd> Precision<S> for Float {
    type Element = f32;
    type Lanes = S::f32s;
    const IS_ROUGH: bool = true;
    const FULL: f32 = 25.0;

    #[inline(always)]
    fn one_minus_exp2<const N: usize>(simd: S, z: &mut [S::f32s; N]) {
        // As in double precision: 1.5 2^23, an interpolant at six points, good to 1.2e-8.
        const NEAREST: f32 = 12_582_912.0;
        const A: [f32; 6] = [
            std::f32::consts::LN_2,
            -0.240_226_5,
            0.055_503_57,
            -0.009_618_083,
            0.001_339_086_3,
            -0.000_154_531_63,
        ];
        let (full, one) = (
            S::f32s::splat(simd, <Self as Precision<S>>::FULL),
            S::f32s::splat(simd, 1.0),
        );
        let ones = S::u32s::splat(simd, 1.0_f32.to_bits());
        for u in z.iter_mut() {
            let z = u.min(full);
            let shifted = z + NEAREST;
            let f = z - (shifted - NEAREST);
            let f2 = f * f;
            let even = (f2 * A[4] + A[2]) * f2 + A[0];
            let odd = (f2 * A[5] + A[3]) * f2 + A[1];
            let scale: S::f32s = (ones - (shifted.bitcast::<S::u32s>() << 23)).bitcast();
            *u = (one - scale) + (odd * f + even) * f * scale;
        }
    }
}

/// A core model, as in [`crate::direct::reference`].
pub(crate) trait Core {
    /// Whether targets close to a filament are looked after in double precision: the cut-off has no h.
    const IS_EXACT: bool = true;

    /// Whether distances are softened: then nothing is ever close.
    const IS_SOFT: bool = false;

    /// Numerator and denominator of K from those of the bare filament, both multiplied by `scale`, and what
    /// the core's function, if it has one, is a function of.
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        c: [V; 3],
        scale: V,
        term: V::Element,
    ) -> [V; 3];

    /// Multiplies the numerators by the core's function of `z`, which is used up.
    #[inline(always)]
    fn regularise<S: Simd, P: Precision<S>, const N: usize>(
        _: S,
        _: &mut [P::Lanes; N],
        _: &mut [P::Lanes; N],
    ) {
    }
}

pub(crate) struct CutOff;
pub(crate) struct Scully;
pub(crate) struct Vatistas;
pub(crate) struct LambOseen;
pub(crate) struct Algebraic;

impl Core for CutOff {
    const IS_EXACT: bool = false;

    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        _: [V; 3],
        scale: V,
        term: V::Element,
    ) -> [V; 3] {
        [num, bare + scale * term, num]
    }
}

impl Core for Algebraic {
    const IS_EXACT: bool = false;
    const IS_SOFT: bool = true;

    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        _: [V; 3],
        _: V,
        _: V::Element,
    ) -> [V; 3] {
        [num, bare, num]
    }
}

impl Core for Scully {
    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        c: [V; 3],
        _: V,
        term: V::Element,
    ) -> [V; 3] {
        let c2 = square::<S, V>(c);
        [num * c2, bare * (c2 + term), c2]
    }
}

impl Core for Vatistas {
    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        c: [V; 3],
        _: V,
        term: V::Element,
    ) -> [V; 3] {
        let c2 = square::<S, V>(c);
        [num * c2, bare * (c2 * c2 + term).sqrt(), c2]
    }
}

impl Core for LambOseen {
    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        c: [V; 3],
        _: V,
        term: V::Element,
    ) -> [V; 3] {
        [num, bare, square::<S, V>(c) * term]
    }

    #[inline(always)]
    fn regularise<S: Simd, P: Precision<S>, const N: usize>(
        simd: S,
        num: &mut [P::Lanes; N],
        z: &mut [P::Lanes; N],
    ) {
        let mut min = z[0];
        for z in &z[1..] {
            min = min.min(*z);
        }
        // Far from all of them the factor is 1 to the last bit.
        if min.simd_lt(P::Lanes::splat(simd, P::FULL)).any_true() {
            P::one_minus_exp2(simd, z);
            for i in 0..N {
                num[i] *= z[i];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};

    /// From `FULL` on, leaving the factor out changes no bit; a little below it would.
    #[test]
    fn exact_factor_is_one_where_it_is_left_out() {
        fn single<S: Simd>(simd: S, z: f32) -> f32 {
            let mut z = [S::f32s::splat(simd, z)];
            Float::one_minus_exp2(simd, &mut z);
            z[0].as_slice()[0]
        }
        fn double<S: Simd>(simd: S, z: f64) -> f64 {
            let mut z = [S::f64s::splat(simd, z)];
            Double::one_minus_exp2(simd, &mut z);
            z[0].as_slice()[0]
        }
        for more in [0.0, 0.3, 0.5, 0.7, 1.0, 1e3, 1e30] {
            let z = 25.0 + more as f32;
            assert_eq!(dispatch!(Level::new(), simd => single(simd, z)), 1.0);
            let z = FULL + more;
            assert_eq!(dispatch!(Level::new(), simd => double(simd, z)), 1.0);
        }
        assert!(dispatch!(Level::new(), simd => single(simd, 23.9)) < 1.0);
        assert!(dispatch!(Level::new(), simd => double(simd, 52.9)) < 1.0);
    }
}

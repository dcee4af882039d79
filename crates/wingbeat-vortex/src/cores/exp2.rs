//! Exponentials with the same bits on every processor: that of Lamb and Oseen, and that of Gaussians.

/// u = 1 - 2^-z, z >= 0, to a few units in the last place, with operations that give the same bits on every
/// processor. With z = k + f, k the nearest integer: u = (1 - 2^-k) + 2^-k f R(f), a sum that cancels nothing.
/// Above z = 60 it is 1 to machine accuracy.
pub fn one_minus_exp2(z: f64) -> f64 {
    let z = z.min(FULL);
    let shifted = z + NEAREST;
    let f = z - (shifted - NEAREST);
    let (a, f2) = (EXP2_POLYNOMIAL, f * f);
    let even = (((a[8] * f2 + a[6]) * f2 + a[4]) * f2 + a[2]) * f2 + a[0];
    let odd = (((a[9] * f2 + a[7]) * f2 + a[5]) * f2 + a[3]) * f2 + a[1];
    let scale = f64::from_bits(ONE.wrapping_sub(shifted.to_bits() << EXPONENT));
    (1.0 - scale) + (odd * f + even) * f * scale
}

/// Where 1 - 2^-z is 1.
pub(crate) const FULL: f64 = 60.0;

/// Added to a number, leaves the nearest integer in the last bits: 1.5 2^52.
pub(crate) const NEAREST: f64 = 6_755_399_441_055_744.0;

/// Bits of 1, and the place of the exponent among them.
pub(crate) const ONE: u64 = 0x3ff0_0000_0000_0000;
pub(crate) const EXPONENT: u32 = 52;

/// (1 - 2^-f) / f on \[-1/2, 1/2\], lowest power first: the Chebyshev interpolant at ten points,
/// relative error 1.4e-15.
pub(crate) const EXP2_POLYNOMIAL: [f64; 10] = [
    0.6931471805599462,
    -0.24022650695910075,
    0.05550410866465167,
    -0.009618129107618665,
    0.0013333558200794592,
    -0.00015403530424776529,
    1.5252672924850737e-05,
    -1.3215451633221434e-06,
    1.0205905413765595e-07,
    -7.070977866508138e-09,
];

/// exp(-x) for a number x >= 0 in plain arithmetic of single precision, to its last digits; nothing where that is less
/// than 1e-36.
#[inline(always)]
pub(crate) fn exp_minus(x: f32) -> f32 {
    const SHIFT: f32 = 12_582_912.0; // 1.5 * 2^23: adding it rounds to a whole number
    let y = (x * -std::f32::consts::LOG2_E).max(-120.0);
    let shifted = y + SHIFT;
    let f = (y - (shifted - SHIFT)) * std::f32::consts::LN_2;
    let mut sum = 1.0 / 5040.0;
    for k in [720.0, 120.0, 24.0, 6.0, 2.0, 1.0, 1.0_f32] {
        sum = sum * f + 1.0 / k;
    }
    let power = shifted.to_bits().wrapping_sub(SHIFT.to_bits() - 127) << 23;
    sum * f32::from_bits(power)
}

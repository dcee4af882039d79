//! Numbers that follow from a seed.

/// The generator SplitMix64 [Steele, Lea & Flood 2014, fig. 16]: 64 bits at a time, all that follow from its seed.
///
/// ```
/// use wingbeat_math::SplitMix64;
/// assert_eq!(SplitMix64::new(1_234_567).bits(), 6_457_827_717_110_365_317);
/// ```
#[derive(Clone, Debug)]
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// The generator of this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = self.0;
        let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// The next number in [0, 1), of 53 bits.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Bits that follow from a seed and from numbers, mixed in one after the other.
    pub fn mixed_with(seed: u64, numbers: &[u64]) -> u64 {
        let first = Self(seed).bits();
        numbers
            .iter()
            .fold(first, |mixed, x| Self(mixed ^ x).bits())
    }
}

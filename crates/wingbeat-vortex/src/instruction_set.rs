//! Which vector instructions run the kernel.

use fearless_simd::Level;

/// Vector instructions of the kernel. All give the same bits; they differ in speed only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InstructionSet {
    /// The best of this processor.
    #[default]
    Best,
    /// No explicit vector instructions.
    Scalar,
    /// Two lanes, x86.
    Sse2,
    /// Four lanes, x86-64-v3.
    Avx2,
    /// Eight lanes, Ice Lake and Zen 4 onwards.
    Avx512,
    /// Two lanes, 64-bit ARM.
    Neon,
}

impl InstructionSet {
    /// The sets this processor has, slowest first, without [`InstructionSet::Best`].
    pub fn available() -> Vec<Self> {
        [
            Self::Scalar,
            Self::Sse2,
            Self::Avx2,
            Self::Avx512,
            Self::Neon,
        ]
        .into_iter()
        .filter(|set| set.level().is_some())
        .collect()
    }

    /// The best set of this processor in `fearless_simd`'s terms.
    pub fn best() -> Level {
        Level::new()
    }

    /// The set in `fearless_simd`'s terms; None where the processor lacks it.
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    pub fn level(self) -> Option<Level> {
        let best = Self::best();
        match self {
            Self::Best => Some(best),
            Self::Scalar => Some(Level::fallback()),
            Self::Sse2 => best.as_sse2().map(Level::Sse2),
            Self::Avx2 => best.as_avx2().map(Level::Avx2),
            Self::Avx512 => best.as_avx512().map(Level::Avx512),
            Self::Neon => None,
        }
    }

    /// The set in `fearless_simd`'s terms; None where the processor lacks it.
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    pub fn level(self) -> Option<Level> {
        match self {
            Self::Best => Some(Self::best()),
            Self::Scalar => Some(Level::fallback()),
            #[cfg(target_arch = "aarch64")]
            Self::Neon => Level::new().as_neon().map(Level::Neon),
            _ => None,
        }
    }
}

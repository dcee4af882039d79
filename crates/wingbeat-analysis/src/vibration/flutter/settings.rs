//! How flutter is sought.

/// How flutter is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlutterSettings {
    /// Modes of the deformed wing that are disturbed.
    pub modes: usize,
    /// Largest displacement that each of them would have without air, over the size of the wing \[1\].
    pub disturbance: f64,
    /// Length of the response in periods of the first mode \[1\].
    pub periods: f64,
    /// Whether mirror images are disturbed against each other: one side up, the other down.
    pub antisymmetric: bool,
    /// Most steps to the steady state, long ones, or 30 periods of the first mode if those are more.
    pub settling: usize,
}

impl Default for FlutterSettings {
    fn default() -> Self {
        Self {
            modes: 3,
            disturbance: 1e-5,
            periods: 1.5,
            antisymmetric: false,
            settling: 4000,
        }
    }
}

//! Numbers and functions of one: extremes, statistics, steps between values, random numbers, series.

pub mod extremes;
pub mod series;
pub mod smoothstep;
pub mod split_mix;
pub mod statistics;

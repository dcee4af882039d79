//! Analysis of flight: cycle means, power, studies.

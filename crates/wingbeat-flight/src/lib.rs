//! Coupled flight: multibody dynamics and unsteady air integrated together.

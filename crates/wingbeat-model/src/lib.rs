//! The flapping animal: geometry, quad meshes, mass properties, wing motion laws.

//! Many blobs by convolution on meshes.

pub(crate) mod mesh;
mod spline;
mod transform;

//! numpy arrays that own what Rust computed and cannot be written to.

use numpy::{Element, PyArray1, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use wingbeat::math::DVec3;

/// The numbers as an array of this shape: nothing is copied, and it lives as long as anyone holds it.
pub fn array<'py, T: Element>(
    py: Python<'py>,
    numbers: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let flat = PyArray1::from_vec(py, numbers);
    let array = match shape {
        [_] => flat.into_any(),
        _ => flat.reshape(shape.to_vec())?.into_any(),
    };
    array.call_method1("setflags", (false,))?;
    Ok(array)
}

/// Vectors as an array of these shape and three columns.
pub fn vectors<'py>(
    py: Python<'py>,
    list: impl IntoIterator<Item = [f64; 3]>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let numbers: Vec<f64> = list.into_iter().flatten().collect();
    array(py, numbers, &[shape, &[3]].concat())
}

/// Three numbers.
pub fn vector(py: Python<'_>, v: DVec3) -> PyResult<Bound<'_, PyAny>> {
    array(py, v.to_array().to_vec(), &[3])
}

/// The numbers of what numpy takes for an array of three columns.
pub fn points(list: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; 3]>> {
    let py = list.py();
    let numpy = py.import("numpy")?;
    let plain = numpy.call_method1("ascontiguousarray", (list, "float64"))?;
    let plain = plain.call_method1("reshape", ((-1, 3),))?;
    let array = plain.cast::<numpy::PyArray2<f64>>()?;
    debug_assert_eq!(array.shape()[1], 3);
    let view = array.readonly();
    let rows = view.as_slice()?.as_chunks::<3>().0;
    Ok(rows.to_vec())
}

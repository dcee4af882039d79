//! numpy arrays that own what Rust computed and cannot be written to.

use numpy::{Element, PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use wingbeat::air::Points;
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

/// Points as an array of three columns.
pub fn rows<'py>(py: Python<'py>, list: &Points) -> PyResult<Bound<'py, PyAny>> {
    let count = list.len();
    vectors(py, (0..count).map(|k| list.get(k).to_array()), &[count])
}

/// The points that are given as an array of three columns, or of three numbers; refuses what is none.
pub fn points(list: &Bound<'_, PyAny>) -> PyResult<Points> {
    let numbers = list.py().import("wingbeat._numbers")?;
    let plain = numbers.call_method1("points", ("points_m", list))?;
    let array = plain.cast::<PyArray2<f64>>()?;
    debug_assert_eq!(array.shape()[1], 3);
    let view = array.readonly();
    let rows = view.as_slice()?.as_chunks::<3>().0;
    Ok(rows.iter().map(|p| DVec3::from_array(*p)).collect())
}

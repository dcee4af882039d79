//! A linear model as JSON has it.

use serde_json::{Value, json};
use wingbeat::analysis::{ControlDerivative, LinearModel, STATE, STATE_UNITS};

/// States, their units and their values in the flight that the model is about, and A by rows; of the `inputs`, where there
/// are some, names, units and B by rows.
pub(super) fn value(model: &LinearModel, inputs: Option<(&[ControlDerivative], &[f64])>) -> Value {
    let mut equilibrium = [0.0; STATE.len()];
    model.velocity.write_to_slice(&mut equilibrium);
    let mut value = json!({
        "states": STATE,
        "state_units": STATE_UNITS,
        "equilibrium": equilibrium,
        "a": rows(&model.matrix, STATE.len()),
    });
    if let Some((controls, b)) = inputs {
        let names = controls.iter().map(|d| format!("{} {}", d.control, d.wing));
        value["inputs"] = names.collect();
        value["input_units"] = controls.iter().map(|d| d.unit).collect();
        value["b"] = rows(b, controls.len());
    }
    value
}

/// A matrix of so many columns.
fn rows(entries: &[f64], columns: usize) -> Value {
    entries
        .chunks_exact(columns)
        .map(|row| json!(row))
        .collect()
}

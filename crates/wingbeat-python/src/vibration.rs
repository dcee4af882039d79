//! Vibrations of elastic wings, and when they grow.

use std::f64::consts::TAU;

use pyo3::prelude::*;
use wingbeat::analysis::flutter::{
    Condition, FlutterSettings, Onset, by_wing, condition, crossings, likely,
};
use wingbeat::analysis::{About, WingMode, WingModes, wing_modes};

use crate::arrays::{array, vectors};
use crate::errors::{broken, raised, refused};
use crate::worker::{Watch, Worked, analyse, work};

/// Frequencies [Hz], growth [1/s], modal masses [kg]; shapes, of shape (modes, nodes, 3), the largest displacement of each of length 1.
type Modes<'py> = [Bound<'py, PyAny>; 4];

/// Name of the wing, its mass \[kg\]; nodes and their deflection, wing components \[m\]; modes without air and with
/// its added mass.
pub type WingParts<'py> = (
    String,
    f64,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Modes<'py>,
    Option<Modes<'py>>,
);

/// The leading `count` modes of the elastic wings, about the wing at rest or its deformed steady state.
pub fn modes<'py>(
    py: Python<'py>,
    flight: &wingbeat::Flight,
    count: usize,
    steady: bool,
) -> PyResult<Vec<WingParts<'py>>> {
    let about = match steady {
        true => About::Steady,
        false => About::Rest,
    };
    let setup = flight.setup.clone();
    let found = analyse(py, move || wing_modes(&setup, about, count))?;
    let found = found.map_err(|e| raised(py, &e.into()))?;
    let wings = &flight.setup.animal.wings;
    let parts = |w: &WingModes| {
        let n = w.nodes.len();
        let places =
            |of: &[wingbeat::math::DVec3]| vectors(py, of.iter().map(|x| x.to_array()), &[n]);
        let air = w.air.as_deref();
        Ok((
            wings[w.wing].name.clone(),
            w.mass,
            places(&w.nodes)?,
            places(&w.deflection)?,
            numbers(py, &w.vacuum, n)?,
            air.map(|modes| numbers(py, modes, n)).transpose()?,
        ))
    };
    found.iter().map(parts).collect()
}

fn numbers<'py>(py: Python<'py>, modes: &[WingMode], nodes: usize) -> PyResult<Modes<'py>> {
    let list =
        |f: &dyn Fn(&WingMode) -> f64| array(py, modes.iter().map(f).collect(), &[modes.len()]);
    let shapes = modes
        .iter()
        .flat_map(|m| m.displacement.iter().map(|x| x.to_array()));
    Ok([
        list(&|m| m.frequency / TAU)?,
        list(&|m| m.growth)?,
        list(&|m| m.mass)?,
        vectors(py, shapes, &[modes.len(), nodes])?,
    ])
}

/// Name of the wing; speed [m/s]; tip's displacement \[m\] and turn \[rad\]; frequencies in vacuum [Hz]; of each mode frequency [Hz],
/// growth and its uncertainty [1/s], damping over critical, share; growth of a motion that does not vibrate and its
/// uncertainty [1/s]; part of the response that no mode explains, that is not linear, disturbance,
/// length of the response \[s\]; the joint that is slower than that with its period \[s\]; of each motion of unknown
/// frequency where it appears [Hz], growth [1/s], share.
pub type ConditionParts = (
    String,
    f64,
    [[f64; 3]; 2],
    Vec<f64>,
    Vec<[f64; 5]>,
    Option<[f64; 2]>,
    [f64; 4],
    Option<(String, f64)>,
    Vec<[f64; 3]>,
);

/// Name of the wing; whether it is certain, whether flutter begins there; speed [m/s], frequency [Hz]; speeds between
/// which it lies.
pub type OnsetParts = (String, bool, bool, f64, f64, [f64; 2]);

/// The elastic wings at each of these `speeds` [m/s], and where flutter begins or ends between them.
pub fn flutter(
    py: Python<'_>,
    flight: &wingbeat::Flight,
    speeds: Vec<f64>,
    (modes, disturbance, periods, antisymmetric): (usize, f64, f64, bool),
    progress: Option<Py<PyAny>>,
) -> PyResult<(Vec<ConditionParts>, Vec<OnsetParts>)> {
    let rising = speeds.windows(2).all(|w| w[0] < w[1]);
    if speeds.is_empty() || !rising || !speeds.iter().all(|v| v.is_finite() && *v > 0.0) {
        let remedy = "speeds above 0 in m/s, each larger than the one before";
        return Err(refused(py, "speeds_m_per_s", "no rising speeds", remedy));
    }
    let settings = FlutterSettings {
        modes,
        disturbance,
        periods,
        antisymmetric,
        ..FlutterSettings::default()
    };
    let setup = flight.setup.clone();
    let told = progress.as_ref().map(|callback| (callback, speeds.len()));
    let fly = move |watch: &Watch| {
        let mut found: Vec<Condition> = vec![];
        for (done, speed) in speeds.into_iter().enumerate() {
            if watch.reached(done) {
                break;
            }
            found.extend(condition(&setup, speed, &settings)?);
            watch.reached(done + 1);
        }
        Ok(found)
    };
    let Worked {
        result,
        interrupted,
    } = work(py, told, false, fly)?;
    let found = match (interrupted, result) {
        (Some(e), _) => return Err(e),
        (None, None) => return Err(broken()),
        (None, Some(found)) => found,
    };
    let found = found.map_err(|e: wingbeat::analysis::AnalysisError| raised(py, &e.into()))?;
    let wings = &flight.setup.animal.wings;
    let name = |c: &Condition| wings[c.steady.wing].name.clone();
    let onsets = |of_wing: &Vec<Condition>| {
        let [certain, uncertain] = [crossings(of_wing), likely(of_wing)];
        let onset = |(c, certain): (Onset, bool)| {
            let wing = name(&of_wing[0]);
            (
                wing,
                certain,
                c.begins,
                c.speed,
                c.frequency / TAU,
                c.between,
            )
        };
        let certain = certain.into_iter().map(|c| (c, true));
        let all = certain.chain(uncertain.into_iter().map(|c| (c, false)));
        all.map(onset).collect::<Vec<_>>()
    };
    let onsets = by_wing(&found).iter().flat_map(onsets).collect();
    Ok((found.iter().map(|c| parts(name(c), c)).collect(), onsets))
}

fn parts(wing: String, c: &Condition) -> ConditionParts {
    let modes = c.modes.iter().zip(&c.uncertainty);
    let divergence = c.divergence.filter(|_| c.diverges());
    (
        wing,
        c.speed,
        [c.steady.tip.to_array(), c.steady.turn.to_array()],
        c.steady.vacuum.iter().map(|w| w / TAU).collect(),
        modes
            .map(|(m, u)| [m.frequency / TAU, m.growth, *u, m.damping(), m.share])
            .collect(),
        divergence.map(|(motion, uncertainty)| [motion.growth, uncertainty]),
        [c.response.residual, c.nonlinearity, c.disturbance, c.length],
        c.slow_joint.clone(),
        c.untold
            .iter()
            .map(|v| [v.frequency / TAU, v.growth, v.share])
            .collect(),
    )
}

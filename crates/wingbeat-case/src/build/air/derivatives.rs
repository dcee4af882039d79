//! `[air.derivatives]`.

use wingbeat_blade::{DerivativeTable, ReferenceSizes};
use wingbeat_math::six_by_six::from_entries;
use wingbeat_math::{SixBySix, r1, r2};
use wingbeat_model::Animal;

use crate::build::fault::Built;
use crate::build::numbers::vector;
use crate::error::Fault;
use crate::raw::{Case, DerivativesCase, DimensionlessCase};

/// The table of the case.
pub(crate) fn table(case: &Case, animal: &Animal) -> Built<DerivativeTable> {
    let Some(d) = &case.air.derivatives else {
        return Err(Fault::new(
            "air.derivatives",
            "this table is missing: air.model = \"derivatives\" needs it",
            "[air.derivatives] with force_by_velocity_newton_s_m and its fellows",
            "`wingbeat stability CASE --write FILE` makes one from a case with blade elements",
        ));
    };
    check_scale(case)?;
    let weight = animal.mass() * vector(case.gravity_m_s2).length();
    let force = d.force_newton.unwrap_or([0.0, 0.0, -weight]);
    let [f, m] = [force, d.moment_newton_m];
    Ok(DerivativeTable {
        to_body: (r2(d.body_pitch_deg.to_radians()) * r1(d.body_roll_deg.to_radians())).transpose(),
        point: animal.body.centre(),
        velocity: vector(d.velocity_m_s),
        reference: [f[0], f[1], f[2], m[0], m[1], m[2]],
        derivatives: matrix(case, d),
        added_mass: added_mass(d)?,
        stream: vector(case.air.stream_m_s),
    })
}

/// Derivatives of an animal of another size depend on how its wingbeat changes with it: the table is of one size.
fn check_scale(case: &Case) -> Built<()> {
    if case.animal.scale == 1.0 {
        return Ok(());
    }
    Err(Fault::new(
        "animal.scale",
        "a table of derivatives is of an animal of one size: masses would be scaled, forces and derivatives not",
        "1 with air.model = \"derivatives\"",
        "scale the case that the table is made from: `wingbeat stability CASE --set animal.scale=... --write FILE`",
    ))
}

type Block = [[f64; 3]; 3];

fn matrix(case: &Case, d: &DerivativesCase) -> SixBySix {
    let given = [
        d.force_by_velocity_newton_s_m,
        d.force_by_rate_newton_s,
        d.moment_by_velocity_newton_s,
        d.moment_by_rate_newton_m_s,
    ];
    match &d.dimensionless {
        None => joined(given.map(Option::unwrap_or_default)),
        Some(plus) => dimensional(case, plus),
    }
}

fn added_mass(d: &DerivativesCase) -> Built<SixBySix> {
    let [mass, coupling, inertia] = [
        d.added_mass_kg,
        d.added_mass_by_turning_kg_m,
        d.added_inertia_kg_m2,
    ]
    .map(Option::unwrap_or_default);
    let symmetric = |key: &str, m: &Block| {
        let size = m
            .as_flattened()
            .iter()
            .fold(0.0, |s: f64, x| s.max(x.abs()));
        let pairs = [(0, 1), (0, 2), (1, 2)];
        let bad = pairs
            .iter()
            .find(|(i, j)| (m[*i][*j] - m[*j][*i]).abs() > 1e-6 * size);
        match bad {
            None => Ok(()),
            Some((i, j)) => Err(Fault::new(
                format!("air.derivatives.{key}"),
                format!("not symmetric: {} and {}", m[*i][*j], m[*j][*i]),
                "a symmetric matrix",
                "take the mean of the two: the energy of the air is that of one motion",
            )),
        }
    };
    symmetric("added_mass_kg", &mass)?;
    symmetric("added_inertia_kg_m2", &inertia)?;
    let turned = std::array::from_fn(|i| std::array::from_fn(|j| coupling[j][i]));
    Ok(joined([mass, coupling, turned, inertia]))
}

fn dimensional(case: &Case, plus: &DimensionlessCase) -> SixBySix {
    let sizes = ReferenceSizes {
        density: case.air.density_kg_m3,
        speed: plus.speed_m_s,
        area: plus.area_m2,
        chord: plus.chord_m,
        period: plus.period_s,
    };
    let blocks = [
        plus.force_by_velocity,
        plus.force_by_rate,
        plus.moment_by_velocity,
        plus.moment_by_rate,
    ];
    sizes.dimensional(&joined(blocks))
}

/// Four blocks as one matrix.
fn joined([fv, fw, mv, mw]: [Block; 4]) -> SixBySix {
    let quarters = [[fv, fw], [mv, mw]];
    from_entries(|i, j| quarters[i / 3][j / 3][i % 3][j % 3])
}

//! Regions of a wing of sheet that are made of something else.

use wingbeat_math::DVec3;
use wingbeat_structure::Lamina;

use super::body::{Fibres, check_poisson, check_tension};
use crate::deformation::{behind, column, strip_axes};
use crate::error::{ModelError, require};
use crate::mesh::GridMesh;

/// A part of a wing of sheet that is made otherwise: panels whose middle lies in it. What is none is as elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// From and to along the span, r/R \[1\].
    pub span: [f64; 2],
    /// From and to behind the leading edge over the chord \[1\].
    pub chord: [f64; 2],
    /// Young's moduli along and across the fibres \[Pa\].
    pub young: Option<[f64; 2]>,
    /// Poisson's ratio \[1\].
    pub poisson: Option<f64>,
    /// Shear modulus \[Pa\]; where `young` is given and this is not, that of a sheet alike in all directions.
    pub shear: Option<f64>,
    /// Thickness \[m\].
    pub thickness: Option<f64>,
    /// Density \[kg/m3\].
    pub density: Option<f64>,
    /// Direction of the fibres from the span towards the leading edge \[rad\].
    pub fibre_angle: Option<f64>,
    /// Tension at rest along and across the fibres \[N/m\].
    pub prestress: Option<[f64; 2]>,
}

/// The middle of panel `k`: r/R, and place behind the leading edge over the chord; `tip` is the wing length \[m\].
pub(super) fn middle(grid: &GridMesh, k: usize, tip: f64) -> [f64; 2] {
    let (i, j) = (k / grid.cols, k % grid.cols);
    let corners = [(i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1)];
    let x = corners.map(|(i, j)| behind(grid, i, j)).iter().sum::<f64>() / 4.0;
    [0.5 * (column(grid, j).0 + column(grid, j + 1).0) / tip, x]
}

/// Direction of the fibres of panel `k` at an angle \[rad\] from the span towards the leading edge, wing components.
pub(super) fn fibres(grid: &GridMesh, k: usize, angle: f64) -> DVec3 {
    let [chord, span] = strip_axes(grid, k % grid.cols);
    angle.sin() * chord + angle.cos() * span
}

impl Region {
    /// Whether a place (r/R, behind the leading edge over the chord) lies in it.
    pub(super) fn holds(&self, place: [f64; 2]) -> bool {
        let ranges = [self.span, self.chord];
        (place.iter().zip(ranges)).all(|(x, [from, to])| (from..=to).contains(x))
    }

    /// Whether nothing of `other`, which comes before, is left where both are.
    pub(super) fn hides(&self, other: &Self) -> bool {
        let given = |g: &Self| {
            [
                g.young.is_some(),
                g.poisson.is_some(),
                g.shear.is_some(),
                g.thickness.is_some(),
                g.density.is_some(),
                g.fibre_angle.is_some(),
                g.prestress.is_some(),
            ]
        };
        let both = given(self).into_iter().zip(given(other));
        both.fold(true, |all, (own, others)| all && (own || !others))
    }

    /// What panel `k` in it is made of, but for the shear modulus ([`Self::own_shear`]).
    pub(super) fn applied(&self, grid: &GridMesh, k: usize, elsewhere: Lamina) -> Lamina {
        let young = self.young.unwrap_or(elsewhere.young);
        let poisson = self.poisson.unwrap_or(elsewhere.poisson);
        Lamina {
            young,
            poisson,
            thickness: self.thickness.unwrap_or(elsewhere.thickness),
            density: self.density.unwrap_or(elsewhere.density),
            axis: (self.fibre_angle).map_or(elsewhere.axis, |angle| fibres(grid, k, angle)),
            prestress: (self.prestress).map_or(elsewhere.prestress, |[a, b]| [a, b, 0.0]),
            ..elsewhere
        }
    }

    /// Shear modulus that is given in it \[Pa\], in a sheet of which this one is given `elsewhere`; none: that of a sheet alike
    /// in all directions.
    pub(super) fn own_shear(&self, elsewhere: Option<f64>) -> Option<f64> {
        self.shear.or(elsewhere.filter(|_| self.young.is_none()))
    }

    /// Whether it has a mass over area of its own, in a sheet with a density.
    pub(super) fn weighs(&self) -> bool {
        self.thickness.is_some() || self.density.is_some()
    }

    pub(super) fn scaled(&self, s: f64) -> Self {
        Self {
            thickness: self.thickness.map(|h| s * h),
            prestress: self.prestress.map(|n| n.map(|n| s * n)),
            ..self.clone()
        }
    }

    /// What gives its fibres a direction, in a sheet of fibres `elsewhere`.
    pub(super) fn fibres(&self, elsewhere: Fibres) -> Fibres {
        Fibres {
            young: self.young.unwrap_or(elsewhere.young),
            shear: self.own_shear(elsewhere.shear),
            prestress: self.prestress.unwrap_or(elsewhere.prestress),
        }
    }

    /// `weighed`: whether the rest of the sheet has a density.
    pub(super) fn check(
        &self,
        key: &str,
        weighed: bool,
        elsewhere: Fibres,
    ) -> Result<(), ModelError> {
        let of = |k: &str| format!("{key}.{k}");
        let density = self.density.unwrap_or_default();
        let allowed = "left out where the shell has no density of its own";
        require(
            &of("density"),
            density,
            weighed || self.density.is_none(),
            allowed,
        )?;
        for (k, [from, to]) in [("span_range", self.span), ("chord_range", self.chord)] {
            require(&of(k), from, 0.0 <= from, "from 0 to 1")?;
            require(&of(k), to, to <= 1.0, "from 0 to 1")?;
            require(&of(k), to, from < to, "above where the region begins")?;
        }
        let positive = [
            ("young", self.young.map(|y| y[0])),
            ("young", self.young.map(|y| y[1])),
            ("shear", self.shear),
            ("thickness", self.thickness),
            ("density", self.density),
        ];
        for (k, x) in positive {
            if let Some(x) = x {
                require(&of(k), x, x > 0.0, "above 0")?;
            }
        }
        if let Some(poisson) = self.poisson {
            check_poisson(
                &of("poisson"),
                poisson,
                self.young.unwrap_or(elsewhere.young),
            )?;
        }
        check_tension(&of("prestress"), self.prestress.unwrap_or_default())?;
        let angle = self.fibre_angle.unwrap_or(0.0);
        self.fibres(elsewhere).check(&of("fibre_angle"), angle)
    }
}

//! Which numbers make sense.

use crate::edges::SheddingKinds;
use crate::error::{AirError, is_positive, require};
use crate::images::{Plane, mirrors};
use crate::settings::air::AirSettings;
use crate::settings::choices::{LeadingEdge, LoadMethod};
use std::f64::consts::PI;
use wingbeat_vortex::{CoreModel, MESH_TOLERANCE, Method};

impl AirSettings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`AirError::Setting`] names the first one that makes no sense.
    pub fn validate(&self) -> Result<(), AirError> {
        require(
            is_positive(self.density),
            "density",
            self.density,
            "a finite number of kg/m3 above 0",
        )?;
        require(
            self.free_stream.is_finite(),
            "free_stream",
            self.free_stream,
            "three finite numbers in m/s",
        )?;
        self.check_cores()?;
        self.check_wake()?;
        require(
            (0.0..0.5).contains(&self.inset),
            "inset",
            self.inset,
            "a part of a panel from 0 to below 1/2",
        )?;
        require(
            is_positive(self.tolerance) && self.tolerance <= 0.1,
            "summation tolerance",
            self.tolerance,
            "a number above 0 and up to 0.1",
        )?;
        self.check_summation()?;
        self.check_leading()?;
        self.check_particles()?;
        self.check_plane()?;
        self.section_drag.map_or(Ok(()), |d| d.validate())?;
        self.wind.validate()?;
        self.check_images()?;
        require(
            self.max_rows != Some(0),
            "max_rows",
            0,
            "at least 1 row, or none to keep all; without any shed row there is no Kutta condition",
        )?;
        require(
            self.max_rows.is_none_or(|rows| rows >= self.least_rows()),
            "max_rows",
            shown(self.max_rows),
            "at least 2 rows where leading edges shed by a criterion, which asks what left the step before",
        )
    }

    fn check_wake(&self) -> Result<(), AirError> {
        self.check_symmetric()?;
        let has_radius = !matches!(self.wake_core, CoreModel::CutOff { .. });
        require(
            self.wake_overlap == 0.0 || is_positive(self.wake_overlap) && has_radius,
            "wake_overlap",
            self.wake_overlap,
            "a finite number from 0; above 0 only if wake_core has a radius, which a cut-off has not",
        )?;
        require(
            is_positive(self.overlap_slope),
            "overlap_slope",
            self.overlap_slope,
            "a finite number above 0",
        )?;
        require(
            self.wake_blob_length
                .is_none_or(|l| is_positive(l) && self.wake_overlap >= 0.5),
            "wake_blob_length",
            shown(self.wake_blob_length),
            "a finite length in m above 0, with wake_overlap 0.5 or more: blobs narrower than their filaments are \
             long leave gaps; or none",
        )?;
        require(
            self.max_displacement.is_none_or(is_positive),
            "max_displacement",
            shown(self.max_displacement),
            "a finite length in m above 0, or none for no limit",
        )?;
        require(
            self.clearance.is_finite() && self.clearance >= 0.0,
            "clearance",
            self.clearance,
            "a finite height in m, 0 to count nothing",
        )?;
        for (key, value) in [
            ("max_age", self.max_age),
            ("max_distance", self.max_distance),
        ] {
            let allowed = "a finite number above 0, or none for no limit";
            require(value.is_none_or(is_positive), key, shown(value), allowed)?;
        }
        Ok(())
    }

    /// Meshes are for kernels that are smooth, and as good as they are.
    fn check_summation(&self) -> Result<(), AirError> {
        let serves = self.is_symmetric() && self.tolerance >= MESH_TOLERANCE;
        require(
            self.summation != Method::Mesh || serves,
            "summation",
            "mesh",
            "auto, direct, single or tree; mesh only with algebraic cores and a summation tolerance of 1e-3 or more",
        )
    }

    fn check_cores(&self) -> Result<(), AirError> {
        for (key, core) in [
            ("bound_core", self.bound_core),
            ("wake_core", self.wake_core),
        ] {
            require(
                core.is_sound(),
                key,
                format!("{core:?}"),
                "finite numbers, none below 0",
            )?;
        }
        Ok(())
    }

    /// Algebraic cores are for all filaments or none.
    fn check_symmetric(&self) -> Result<(), AirError> {
        let is_algebraic = |core: CoreModel| matches!(core, CoreModel::Algebraic { .. });
        require(
            is_algebraic(self.bound_core) == self.is_symmetric(),
            "bound_core",
            format!(
                "{} beside {} in the wakes",
                self.bound_core.name(),
                self.wake_core.name()
            ),
            "algebraic if and only if wake_core is: action equals reaction only if all filaments have cores of one kind; \
             set both",
        )?;
        require(
            !(self.is_symmetric() && self.wake_blob_length.is_some()),
            "wake_blob_length",
            shown(self.wake_blob_length),
            "none with algebraic cores, whose filaments stay filaments",
        )
    }

    fn check_leading(&self) -> Result<(), AirError> {
        let SheddingKinds {
            trailing,
            tip,
            leading,
            root,
        } = self.shedding;
        require(
            self.leading.sheds() || !leading || trailing || tip || root,
            "shedding",
            "leading edges alone",
            "other edges too, or none: leading edges of this choice shed nothing",
        )?;
        match self.leading {
            LeadingEdge::Never | LeadingEdge::Always => Ok(()),
            LeadingEdge::AngleOfAttack { threshold } => require(
                (0.0..=PI).contains(&threshold),
                "leading angle-of-attack threshold",
                threshold,
                "an angle in rad from 0 to pi",
            ),
            LeadingEdge::VortexLift(law) => {
                law.validate()?;
                self.check_vortex_lift()
            }
            LeadingEdge::Suction {
                threshold,
                efficiency,
            }
            | LeadingEdge::SuctionImplicit {
                threshold,
                efficiency,
            } => check_suction(threshold, efficiency),
        }
    }

    /// Vortex lift is made of the suction of leading edges, which only forces on segments have.
    fn check_vortex_lift(&self) -> Result<(), AirError> {
        require(
            self.shedding.leading,
            "shedding",
            "no leading edges",
            "leading edges too: it is theirs that the vortex lift is",
        )?;
        require(
            self.loads == LoadMethod::Joukowski,
            "loads",
            self.loads.name(),
            "forces on segments with the vortex lift of leading edges, which is made of their suction",
        )
    }

    fn check_particles(&self) -> Result<(), AirError> {
        let Some(particles) = &self.particles else {
            return Ok(());
        };
        particles.validate()?;
        require(
            !particles.leading_at_once || self.leading.sheds(),
            "particles leading_at_once",
            particles.leading_at_once,
            "false where nothing leaves leading edges",
        )?;
        require(
            self.max_rows.is_none(),
            "max_rows",
            shown(self.max_rows),
            "none beside particles, which have no rows: truncate by age or distance",
        )
    }

    /// In plane flow nothing leaves side edges, and wakes are filaments across it.
    fn check_plane(&self) -> Result<(), AirError> {
        let SheddingKinds { tip, root, .. } = self.shedding;
        let is_plane = !tip && !root && self.particles.is_none() && self.wake_blob_length.is_none();
        require(
            !self.plane_wakes || is_plane,
            "plane_wakes",
            self.plane_wakes,
            "true only where tips and roots do not shed, without particles and blobs: plane flow has vorticity across it alone",
        )
    }

    fn check_images(&self) -> Result<(), AirError> {
        mirrors(&self.images)?;
        let through = |p: &Plane| {
            let across = self.free_stream.dot(p.normal.normalize()).abs();
            across > 1e-12 * self.free_stream.length()
        };
        if self.images.iter().any(through) {
            return Err(AirError::WindThroughPlane { part: "stream" });
        }
        let part = self.images.iter().find_map(|p| self.wind.part_through(p));
        part.map_or(Ok(()), |part| Err(AirError::WindThroughPlane { part }))
    }
}

fn check_suction(threshold: f64, efficiency: f64) -> Result<(), AirError> {
    require(
        is_positive(threshold),
        "leading suction threshold",
        threshold,
        "a finite number above 0",
    )?;
    require(
        (0.0..=1.0).contains(&efficiency),
        "leading suction efficiency",
        efficiency,
        "a number from 0 to 1",
    )
}

/// A limit that there may be, as a user writes it.
fn shown(value: Option<impl ToString>) -> String {
    value.map_or_else(|| "none".to_owned(), |value| value.to_string())
}

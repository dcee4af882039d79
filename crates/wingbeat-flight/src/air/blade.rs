//! Blade elements as the air of a flight: strips from the wing meshes, loads from the motions.
//!
//! Wind beside the free stream (gusts, shear) is seen strip by strip. The added mass stands on
//! the left-hand side of the equations of motion ([`AddedMass`]); what of it follows from velocities
//! is among the loads.

use wingbeat_air::Wind;
use wingbeat_blade::{
    BladeError, BladeWing, BodyDrag, Calm, Lag, LocalWind, SectionMotion, StripTrial, WingMemory,
};
use wingbeat_dynamics::{AddedMass, BodyAcceleration, BodyMotion, Wrench};
use wingbeat_math::six_by_six::{from_entries, symmetric_part, unit};
use wingbeat_math::{DVec3, SixBySix, six};
use wingbeat_model::{Animal, Wing};

use super::bent::{BentStrips, refuse_measured_surfaces};
use super::strips::{MovingStrips, strips};
use crate::error::FlightError;
use crate::interface::memory::AirMemory;
use crate::interface::{Air, AirScratch, Instant, StripScratch, WingResponse, misfit};
use crate::setup::BladeOptions;

/// The blade elements of an animal.
#[derive(Clone, Debug)]
pub struct BladeAir {
    /// Wings in the animal's order: body `i + 1`.
    wings: Vec<BladeWing>,
    /// How their strips lie and move where they are deformed or not flat.
    moving: Vec<Option<MovingStrips>>,
    /// How loads bend them.
    bent: Vec<Option<BentStrips>>,
    /// Added mass of those that keep their shape.
    added: Vec<AddedMass>,
    /// Drag of the body and where it acts, body components \[m\].
    drag: Option<(BodyDrag, DVec3)>,
    density: f64,
    stream: DVec3,
    induced: DVec3,
    wind: Wind,
}

impl BladeAir {
    /// One strip per column of each wing's mesh.
    ///
    /// # Errors
    /// A setting out of range; a strip without chord; a wing with a measured surface.
    pub fn new(animal: &Animal, options: &BladeOptions) -> Result<Self, FlightError> {
        if let Some(drag) = &options.body_drag {
            drag.check()?;
        }
        options.wind.validate()?;
        refuse_measured_surfaces(animal)?;
        let mut settings = options.blade;
        settings.free_stream += options.induced;
        let wing = |w: &Wing| BladeWing::new(strips(w).iter().map(|s| s.strip).collect(), settings);
        let wings: Result<Vec<BladeWing>, BladeError> = animal.wings.iter().map(wing).collect();
        let mut air = Self {
            wings: wings?,
            moving: animal.wings.iter().map(MovingStrips::new).collect(),
            bent: (animal.wings.iter().enumerate())
                .map(|(i, w)| BentStrips::new(i, w))
                .collect(),
            added: vec![],
            drag: (options.body_drag)
                .map(|d| (d, d.centre.unwrap_or_else(|| animal.body_centre()))),
            density: options.blade.density,
            stream: options.blade.free_stream,
            induced: options.induced,
            wind: options.wind.clone(),
        };
        let rigid = |i: &usize| !air.is_deformed(*i) && air.bent[*i].is_none();
        let rigid = (0..air.wings.len()).filter(rigid);
        let mut none = vec![];
        let added = rigid.filter_map(|i| air.added_to(i, 0.0, &mut none));
        air.added = added.collect();
        Ok(air)
    }

    /// The wings, in the animal's order.
    pub fn wings(&self) -> &[BladeWing] {
        &self.wings
    }

    /// Whether the shape of wing `i` is prescribed.
    fn is_deformed(&self, i: usize) -> bool {
        self.moving[i]
            .as_ref()
            .is_some_and(MovingStrips::is_deformed)
    }

    /// How the strips of wing `i` lie and move at time `t` \[s\], into `out`; nothing of a flat wing.
    fn put_sections(&self, i: usize, t: f64, out: &mut Vec<SectionMotion>) {
        out.clear();
        if let Some(moving) = &self.moving[i] {
            out.extend(moving.sections(t));
        }
    }

    /// Force and moment of the added mass of wing `i` with its `sections`, wing components, and the power that deforms
    /// it; it moves like `m` and accelerates like `acc`.
    fn acceleration_load(
        &self,
        (i, sections): (usize, &[SectionMotion]),
        t: f64,
        m: &BodyMotion,
        acc: &BodyAcceleration,
    ) -> (Wrench, f64) {
        let (wing, wind) = (&self.wings[i], self.wind_on(m, t, None));
        match &self.moving[i] {
            None => (wing.acceleration_load_in(m, acc, wind), 0.0),
            Some(_) => {
                let sum = wing.deforming_acceleration_load(m, acc, |k| sections[k], wind);
                (sum.load, sum.power)
            }
        }
    }

    /// Force and moment on wing `i` with its `sections` by its velocities and the wakes that `lag` tells of, wing
    /// components, and the power that deforms it.
    fn velocity_load(
        &self,
        (i, sections): (usize, &[SectionMotion]),
        t: f64,
        m: &BodyMotion,
        lag: Option<Lag<'_>>,
    ) -> (Wrench, f64) {
        let (wing, wind) = (&self.wings[i], self.wind_on(m, t, lag.as_ref()));
        match &self.moving[i] {
            None if self.wind.is_none() => (wing.lagging_load(m, Calm, lag), 0.0),
            None => (wing.lagging_load(m, wind, lag), 0.0),
            Some(_) => {
                let sum = wing.deforming_velocity_load(m, |k| sections[k], wind, lag);
                (sum.load, sum.power)
            }
        }
    }

    /// The wakes of the strips, where they are remembered.
    fn wakes<'a>(
        &self,
        memory: Option<&'a AirMemory>,
    ) -> Result<Option<&'a [WingMemory]>, FlightError> {
        match (self.has_memory(), memory.and_then(AirMemory::strips)) {
            (false, _) => Ok(None),
            (true, Some(wakes)) => Ok(Some(wakes)),
            (true, None) => Err(misfit("strips with wakes need their memory")),
        }
    }

    /// The `drag` of the body that moves like `b`, at the point `centre`.
    fn drag_on(&self, drag: &BodyDrag, centre: DVec3, t: f64, b: &BodyMotion) -> Wrench {
        let wind = self.wind_on(b, t, None).velocity(centre);
        let v = b.r.transpose() * (b.v - self.stream) + b.w.cross(centre) - wind;
        let force = drag.force(self.density, v);
        let moment = centre.cross(force);
        Wrench { force, moment }.turned(b.r)
    }

    /// Wind on a wing that moves like `m` at time `t` \[s\], whose strips may remember their wakes (`lag`).
    fn wind_on(&self, m: &BodyMotion, t: f64, lag: Option<&Lag<'_>>) -> WindOn<'_> {
        WindOn {
            wind: &self.wind,
            is_calm: self.wind.is_none(),
            stream: self.stream + self.induced,
            motion: *m,
            time: t,
            remembered: lag.and_then(Lag::since),
        }
    }

    /// The added mass of wing `i`, read off its loads under unit accelerations; none if it has none.
    fn added_to(&self, i: usize, t: f64, sections: &mut Vec<SectionMotion>) -> Option<AddedMass> {
        self.put_sections(i, t, sections);
        let load = |[linear, angular]: [DVec3; 2]| {
            let acc = BodyAcceleration { linear, angular };
            let wing = (i, &sections[..]);
            let (load, _) = self.acceleration_load(wing, t, &BodyMotion::REST, &acc);
            six(load.force, load.moment)
        };
        let still = load([DVec3::ZERO; 2]);
        let columns: SixBySix = std::array::from_fn(|k| load(unit(k)));
        // Exactly symmetric, as energy asks: the two halves differ by roundings.
        let matrix = symmetric_part(&from_entries(|j, k| still[j] - columns[k][j]));
        let felt = matrix.iter().flatten().any(|x| *x != 0.0);
        felt.then(|| AddedMass::new(i + 1, matrix))
    }
}

impl Air for BladeAir {
    fn loads(
        &self,
        at: &Instant<'_>,
        memory: Option<&AirMemory>,
        scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        let wakes = self.wakes(memory)?;
        scratch.strips.time = at.time;
        (scratch.strips.trials).resize_with(self.wings.len(), Vec::new);
        let (t, still) = (at.time, BodyAcceleration::default());
        out.fill(Wrench::default());
        if let Some((drag, centre)) = &self.drag {
            out[0] = self.drag_on(drag, *centre, t, &at.motions[0]);
        }
        for (i, m) in (0..self.wings.len()).zip(&at.motions[1..]) {
            let bent = self.bent[i].as_ref();
            let StripScratch {
                trials, sections, ..
            } = &mut scratch.strips;
            let trial = &mut trials[i];
            if let Some(load) = bent.and_then(|b| {
                let lag = lag(wakes, i, t, trial);
                let wind = self.wind_on(m, t, lag.as_ref());
                b.load(&self.wings[i], at, wind, lag, &mut scratch.bent)
            }) {
                out[i + 1] = load;
                continue;
            }
            self.put_sections(i, t, sections);
            let wing = (i, &sections[..]);
            out[i + 1] = (self.velocity_load(wing, t, m, lag(wakes, i, t, trial)).0).turned(m.r);
            if self.wings[i].has_added_mass() {
                out[i + 1] += (self.acceleration_load(wing, t, m, &still).0).turned(m.r);
            }
        }
        Ok(())
    }

    fn added_mass(&self, t: f64, scratch: &mut AirScratch, out: &mut Vec<AddedMass>) {
        out.extend_from_slice(&self.added);
        let deforming = (0..self.wings.len()).filter(|&i| self.is_deformed(i));
        let sections = &mut scratch.strips.sections;
        out.extend(deforming.filter_map(|i| self.added_to(i, t, sections)));
    }

    fn has_memory(&self) -> bool {
        self.wings.iter().any(|w| w.settings().unsteady.is_some())
    }

    fn initial(&self, _scratch: &AirScratch) -> Option<AirMemory> {
        let memories: Vec<_> = self.wings.iter().filter_map(BladeWing::memory).collect();
        self.has_memory().then_some(AirMemory::Strips(memories))
    }

    fn accept(
        &self,
        memory: &mut Option<AirMemory>,
        scratch: &AirScratch,
    ) -> Result<(), FlightError> {
        let StripScratch { time, trials, .. } = &scratch.strips;
        if let Some(AirMemory::Strips(wakes)) = memory {
            let wings = self.wings.iter().zip(wakes).zip(trials);
            wings.for_each(|((wing, wake), trial)| wing.accept(wake, trial, *time));
        }
        Ok(())
    }

    fn check(&self, memory: Option<&AirMemory>) -> Result<(), FlightError> {
        let own = self.initial(&AirScratch::default());
        let fits = match (&own, memory) {
            (None, None) => true,
            (Some(AirMemory::Strips(own)), Some(AirMemory::Strips(saved))) => {
                let mut both = own.iter().zip(saved);
                own.len() == saved.len() && both.all(|(a, b)| a.fits(b))
            }
            _ => false,
        };
        match fits {
            true => Ok(()),
            false => Err(misfit("the strips of the case have other wakes, or none")),
        }
    }

    fn is_steady_and_uniform(&self) -> bool {
        self.wind.is_none()
    }

    fn nodal_forces(
        &self,
        wing: usize,
        _at: &Instant<'_>,
        scratch: &mut AirScratch,
        out: &mut Vec<DVec3>,
    ) -> Result<(), FlightError> {
        out.clear();
        out.extend_from_slice(scratch.bent.forces(wing));
        Ok(())
    }

    fn wing_response(
        &self,
        wing: usize,
        at: &Instant<'_>,
        memory: Option<&AirMemory>,
        scratch: &mut AirScratch,
        out: &mut WingResponse,
    ) -> Result<bool, FlightError> {
        let (bent, room) = (self.bent[wing].as_ref(), &mut scratch.bent);
        let lag = lag(
            self.wakes(memory)?,
            wing,
            at.time,
            &mut scratch.strips.asked,
        );
        let wind = self.wind_on(&at.motions[wing + 1], at.time, lag.as_ref());
        Ok(bent.is_some_and(|b| b.respond(&self.wings[wing], at, wind, lag, (room, out))))
    }

    fn follows_accelerations(&self) -> bool {
        let mut wings = self.bent.iter().zip(&self.wings);
        wings.any(|(bent, wing)| bent.is_some() && wing.has_added_mass())
    }

    fn deforms(&self) -> bool {
        (0..self.wings.len()).any(|i| self.is_deformed(i))
    }

    fn deformation_power(
        &self,
        at: &Instant<'_>,
        accelerations: &[BodyAcceleration],
        scratch: &mut AirScratch,
        out: &mut [f64],
    ) {
        out.fill(0.0);
        let mut sections = std::mem::take(&mut scratch.strips.sections);
        for i in (0..self.wings.len()).filter(|&i| self.is_deformed(i)) {
            let (m, a) = (&at.motions[i + 1], &accelerations[i + 1]);
            let known = scratch.strips.trials.get(i).map(|t| Lag::Known(t));
            self.put_sections(i, at.time, &mut sections);
            let wing = (i, &sections[..]);
            let [by_velocity, by_mass] = [
                self.velocity_load(wing, at.time, m, known).1,
                self.acceleration_load(wing, at.time, m, a).1,
            ];
            out[i + 1] = by_velocity + by_mass;
        }
        scratch.strips.sections = sections;
    }
}

/// The wind on a wing.
struct WindOn<'a> {
    wind: &'a Wind,
    is_calm: bool,
    /// Velocity of the air at the wings without it, N components \[m/s\].
    stream: DVec3,
    motion: BodyMotion,
    time: f64,
    /// When the strips' memory was accepted \[s\], where they have one.
    remembered: Option<f64>,
}

impl LocalWind for WindOn<'_> {
    fn velocity(&self, point: DVec3) -> DVec3 {
        match self.is_calm {
            true => DVec3::ZERO,
            false => {
                let m = &self.motion;
                m.r.transpose() * self.wind.at(m.point(point), self.time)
            }
        }
    }

    fn rate(&self, point: DVec3, through: DVec3) -> DVec3 {
        match self.is_calm {
            true => DVec3::ZERO,
            false => {
                let m = &self.motion;
                let (x, v) = (m.point(point), self.stream + m.r * through);
                m.r.transpose() * self.wind.rate(x, v, self.time)
            }
        }
    }

    fn at_once(&self) -> [DVec3; 2] {
        if self.is_calm {
            return [DVec3::ZERO; 2];
        }
        let [now, rate] = self.wind.at_once(self.time);
        let before = self.remembered.map_or(now, |t| self.wind.at_once(t)[0]);
        [now - before, rate].map(|x| self.motion.r.transpose() * x)
    }

    fn is_calm(&self) -> bool {
        self.is_calm
    }
}

/// What slows wing number `i` down at time `t` \[s\]; its strips go into `trial`.
fn lag<'a>(
    wakes: Option<&'a [WingMemory]>,
    i: usize,
    t: f64,
    trial: &'a mut Vec<StripTrial>,
) -> Option<Lag<'a>> {
    wakes.map(|wakes| Lag::Trial {
        memory: &wakes[i],
        time: t,
        trial,
    })
}

//! Loads on one wing from the motion of its frame, whose origin is the hinge: force and moment about it, wing
//! components.

use wingbeat_math::{BodyAcceleration, BodyMotion, DVec2, DVec3, Wrench};

use crate::error::BladeError;
use crate::lag::{Lag, Lags, StripTrial, StripWind, WingMemory};
use crate::pair::{PairMotion, StripPair};
use crate::settings::{AddedMassModel, BladeSettings};
use crate::slowed::{Gust, Slowed, slowed_forces};
use crate::strip::Strip;
use crate::wind::{Calm, LocalWind};

/// A wing made of strips.
#[derive(Clone, Debug, PartialEq)]
pub struct BladeWing {
    strips: Vec<Strip>,
    pairs: Vec<StripPair>,
    settings: BladeSettings,
    added: AddedMoments,
    lags: Option<Lags>,
}

/// Sums over the strips of the added mass m = rho pi/4 c^2 dr and its place (x, y) at mid chord,
/// and of the added moment of inertia.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct AddedMoments {
    m: f64,
    mx: f64,
    my: f64,
    mxx: f64,
    mxy: f64,
    myy: f64,
    inertia: f64,
}

impl AddedMoments {
    fn of(strips: &[Strip], settings: &BladeSettings) -> Self {
        let mut a = Self::default();
        if settings.added_mass == AddedMassModel::None {
            return a;
        }
        for s in strips {
            let (x, y) = (s.x_mid(), s.y);
            let m = s.added_mass(settings.density);
            a.m += m;
            a.mx += m * x;
            a.my += m * y;
            a.mxx += m * x * x;
            a.mxy += m * x * y;
            a.myy += m * y * y;
            if settings.added_mass.is_kirchhoff() {
                a.inertia += s.added_inertia(settings.density);
            }
        }
        a
    }
}

impl BladeWing {
    /// A wing of these strips.
    ///
    /// # Errors
    /// A strip without chord or width; a setting out of range.
    pub fn new(strips: Vec<Strip>, settings: BladeSettings) -> Result<Self, BladeError> {
        settings.check()?;
        strips
            .iter()
            .enumerate()
            .try_for_each(|(k, s)| s.check(k))?;
        let added = AddedMoments::of(&strips, &settings);
        Ok(Self {
            pairs: StripPair::all(&strips, &settings),
            strips,
            lags: settings.unsteady.map(Lags::of),
            settings,
            added,
        })
    }

    /// The strips, root to tip.
    pub fn strips(&self) -> &[Strip] {
        &self.strips
    }

    /// The model.
    pub fn settings(&self) -> &BladeSettings {
        &self.settings
    }

    /// Whether the forces of its strips by velocities hold all of the force along the chord, that of the added
    /// mass, too: the leading-edge suction of strips with wakes.
    pub(crate) fn has_suction(&self) -> bool {
        self.settings.unsteady.is_some()
    }

    /// The law of what the added mass does by velocities beside the strips' own forces: none of `section` where their
    /// suction holds all of it.
    pub(crate) fn added_by_velocities(&self) -> AddedMassModel {
        match self.settings.added_mass {
            AddedMassModel::Section if self.has_suction() => AddedMassModel::None,
            law => law,
        }
    }

    /// Whether it carries air along.
    pub fn has_added_mass(&self) -> bool {
        self.settings.added_mass != AddedMassModel::None
    }

    /// Everything that depends on velocities alone: translation, rotation, viscous moment, and
    /// the part of the added mass that is no acceleration; wing components.
    pub fn velocity_load(&self, motion: &BodyMotion) -> Wrench {
        self.velocity_load_in(motion, Calm)
    }

    /// As [`Self::velocity_load`], `wind` being added to the free stream.
    pub fn velocity_load_in(&self, motion: &BodyMotion, wind: impl LocalWind) -> Wrench {
        self.lagging_load(motion, wind, None)
    }

    /// As [`Self::velocity_load_in`], the circulation of the strips lagging behind as `lag` says.
    pub fn lagging_load(
        &self,
        motion: &BodyMotion,
        wind: impl LocalWind,
        lag: Option<Lag<'_>>,
    ) -> Wrench {
        let v = self.velocity_through_air(motion);
        let mut sum = self.strip_load(v, motion, &wind, lag);
        if !wind.is_calm() {
            return sum + self.turning_load_in(motion, |p| v - wind.velocity(p));
        }
        match self.added_by_velocities() {
            AddedMassModel::None | AddedMassModel::Normal => {}
            AddedMassModel::Section => self.add_chordwise_added_mass(v, motion.w, &mut sum),
            AddedMassModel::Impulse => self.add_turning_impulse(v, motion.w, &mut sum),
        }
        sum
    }

    /// The added mass: linear in the rates of the velocity components in the wing frame; wing components.
    pub fn acceleration_load(&self, motion: &BodyMotion, acc: &BodyAcceleration) -> Wrench {
        let v = self.velocity_through_air(motion);
        // Rate of the components in the turning frame.
        let rate = motion.r.transpose() * acc.linear - motion.w.cross(v);
        let (a, turn) = (&self.added, acc.angular);
        // Normal velocity of the point (x, y): v3 + w1 y - w2 x.
        let force = -(a.m * rate.z + a.my * turn.x - a.mx * turn.y);
        let about_1 = -(a.my * rate.z + a.myy * turn.x - a.mxy * turn.y);
        let about_2 = a.mx * rate.z + a.mxy * turn.x - a.mxx * turn.y;
        Wrench {
            force: DVec3::new(0.0, 0.0, force),
            moment: DVec3::new(about_1, about_2 - a.inertia * turn.y, 0.0),
        }
    }

    /// Rate of the `wind` that the added mass feels at a point that moves with `through` [m/s] through the
    /// stream, wing components
    /// [m/s2]: with wakes Kuessner's function has what a strip comes into.
    pub(crate) fn wind_rate(&self, wind: &impl LocalWind, point: DVec3, through: DVec3) -> DVec3 {
        match self.settings.unsteady {
            None => wind.rate(point, through),
            Some(_) => wind.at_once()[1],
        }
    }

    /// Both together in uniform air, for motions whose accelerations are known; wing components.
    pub fn load(&self, motion: &BodyMotion, acc: &BodyAcceleration) -> Wrench {
        self.velocity_load(motion) + self.acceleration_load(motion, acc)
    }

    /// Velocity of the hinge through the undisturbed air, wing components.
    pub(crate) fn velocity_through_air(&self, motion: &BodyMotion) -> DVec3 {
        motion.r.transpose() * (motion.v - self.settings.free_stream)
    }

    /// Translation, rotation and viscous moment of all strips; the hinge moves with `v` through air
    /// without wind.
    fn strip_load(
        &self,
        v: DVec3,
        frame: &BodyMotion,
        wind: &impl LocalWind,
        mut lag: Option<Lag<'_>>,
    ) -> Wrench {
        let rate = frame.w;
        let motion = |_: usize, pair: &StripPair| {
            let [a, b] = [pair.y.x, pair.y.y].map(|y| v - wind.velocity(DVec3::new(0.0, y, 0.0)));
            // Velocity of the points on the feathering axis, v + rate x (0, y, 0).
            PairMotion {
                u: DVec2::new(a.x, b.x) - rate.z * pair.y,
                w: DVec2::new(a.z, b.z) + rate.x * pair.y,
                q: DVec2::splat(rate.y),
            }
        };
        let gust = |k: usize, front: f64| {
            let s = &self.strips[k];
            let at = |x: f64| wind.velocity(DVec3::new(x, s.y, 0.0));
            StripWind {
                at_axis: at(0.0).z,
                at_front: frame.r * at(s.x_mid() + 0.5 * s.chord * front),
                at_rear: frame.r * at(s.x_mid() - 0.5 * s.chord * front),
                at_once: frame.r * wind.at_once()[0],
                normal: frame.r.z_axis,
            }
        };
        let mut slowed = self.slowed(lag.as_mut(), &gust);
        let mut sums = [DVec2::ZERO; 5];
        let (pairs, settings) = (&self.pairs, &self.settings);
        slowed_forces(pairs, settings, slowed.as_mut(), motion, |_, pair, f| {
            let y = pair.y;
            sums[0] += f.along;
            sums[1] += f.normal;
            sums[2] += y * f.normal;
            sums[3] += f.about;
            sums[4] -= y * f.along;
        });
        let [along, normal, about_1, about_2, about_3] = sums.map(|s| s.x + s.y);
        Wrench {
            force: DVec3::new(along, 0.0, normal),
            moment: DVec3::new(about_1, about_2, about_3),
        }
    }

    /// What its strips remember before they have moved; none of a quasi-steady wing.
    pub fn memory(&self) -> Option<WingMemory> {
        let lags = self.lags.as_ref()?;
        Some(WingMemory::new(self.strips.len(), lags))
    }

    /// Strips that have moved as in the `trial` at `time` \[s\].
    pub fn accept(&self, memory: &mut WingMemory, trial: &[StripTrial], time: f64) {
        if let Some(lags) = &self.lags {
            lags.accept(memory, trial, time, self.strips.iter().map(|s| s.chord));
        }
    }

    /// What the strips would remember if the motion by which they came from `before` to `after` repeated itself
    /// for ever.
    #[must_use]
    pub fn periodic(&self, before: &WingMemory, after: &WingMemory) -> WingMemory {
        let mut found = after.clone();
        if let Some(lags) = &self.lags {
            lags.periodic(before, &mut found);
        }
        found
    }

    /// The strips as their wakes slow them down in a `gust`; none where nothing does.
    pub(crate) fn slowed<'a, 'b>(
        &'a self,
        lag: Option<&'a mut Lag<'b>>,
        gust: &'a Gust<'a>,
    ) -> Option<Slowed<'a, 'b>> {
        let (lags, lag) = (self.lags.as_ref()?, lag?);
        let count = self.strips.len();
        if let Lag::Trial { trial, .. } = &mut *lag {
            trial.resize(count, StripTrial::default());
        }
        Some(Slowed {
            lags,
            lag,
            gust,
            count,
        })
    }

    /// The strips, two by two.
    pub(crate) fn pairs(&self) -> &[StripPair] {
        &self.pairs
    }

    /// What changes the impulse of the air while its components in the wing frame stay: force
    /// `-w x P`, moment `-w x L - v x P` about the hinge, P and L the air's momentum and angular
    /// momentum about the hinge (Kirchhoff's equations). About the span that is Munk's couple alone,
    /// `sum m w u`, and left out: the law of the centre of pressure has it ([`AddedMassModel::Impulse`]).
    fn add_turning_impulse(&self, v: DVec3, rate: DVec3, sum: &mut Wrench) {
        let a = &self.added;
        let p = DVec3::new(0.0, 0.0, a.m * v.z + a.my * rate.x - a.mx * rate.y);
        let about_1 = a.my * v.z + a.myy * rate.x - a.mxy * rate.y;
        let about_2 = (a.mxx + a.inertia) * rate.y - a.mx * v.z - a.mxy * rate.x;
        let mut force = rate.cross(p);
        let mut moment = rate.cross(DVec3::new(about_1, about_2, 0.0)) + v.cross(p);
        if self.has_suction() {
            force.x = 0.0;
            moment.z += rate.y * about_1;
        }
        sum.force -= force;
        sum.moment -= moment.with_y(0.0);
    }

    /// Force `-m q w` along the chord, w at mid chord, with its moment.
    fn add_chordwise_added_mass(&self, v: DVec3, rate: DVec3, sum: &mut Wrench) {
        let a = &self.added;
        let momentum = a.m * v.z + a.my * rate.x - a.mx * rate.y;
        let moment = a.my * v.z + a.myy * rate.x - a.mxy * rate.y; // sum of y times momentum
        sum.force.x -= rate.y * momentum;
        sum.moment.z += rate.y * moment;
    }
}

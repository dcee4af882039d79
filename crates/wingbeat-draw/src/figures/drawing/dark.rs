//! Drawings on a dark ground, for slides and dark screens.

use crate::figures::drawing::{COLOURS, Colour, Drawing, Mark};

/// The ground.
const NIGHT: Colour = Colour(17, 22, 31);

/// [`COLOURS`] on it, each four times as bright as the ground at least and told apart as those on white are.
const BRIGHT: [Colour; COLOURS.len()] = [
    Colour(89, 197, 255),
    Colour(255, 140, 54),
    Colour(0, 178, 130),
    Colour(214, 136, 180),
    Colour(178, 220, 250),
    Colour(240, 183, 50),
    Colour(160, 160, 160),
];

impl Drawing {
    /// The same on a dark ground: what is near white comes near the ground and what is near black near white;
    /// hues stay.
    pub(crate) fn on_dark(mut self) -> Self {
        self.ground = self.ground.on_dark();
        for mark in &mut self.marks {
            let colour = match mark {
                Mark::Line { stroke, .. } => &mut stroke.colour,
                Mark::Area { fill, .. } => fill,
                Mark::Text { colour, .. } => colour,
            };
            *colour = colour.on_dark();
        }
        self
    }
}

impl Colour {
    /// Its parts of white and of black exchanged, on the ground; of the colours of curves their bright ones.
    fn on_dark(self) -> Self {
        if let Some(k) = COLOURS.iter().position(|c| *c == self) {
            return BRIGHT[k];
        }
        let parts = [self.0, self.1, self.2].map(i32::from);
        let shift = 255 - parts.iter().sum::<i32>() + middle(parts);
        let [r, g, b] = parts.map(|x| f64::from(x + shift) / 255.0);
        let mix = |ground: u8, x: f64| Colour(ground, 0, 0).toward(Colour(255, 0, 0), x).0;
        Self(mix(NIGHT.0, r), mix(NIGHT.1, g), mix(NIGHT.2, b))
    }
}

/// The middle one of three numbers.
fn middle(mut parts: [i32; 3]) -> i32 {
    parts.sort_unstable();
    parts[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::drawing::{FAINT, GROUND, INK, SHADE};
    use crate::figures::stills::dots::dye;
    use crate::figures::stills::wake::pen;

    /// Relative luminance and contrast [W3C, *Web Content Accessibility Guidelines 2.2*].
    fn contrast(a: Colour, b: Colour) -> f64 {
        let part = |x: u8| match f64::from(x) / 255.0 {
            x if x <= 0.04045 => x / 12.92,
            x => ((x + 0.055) / 1.055).powf(2.4),
        };
        let light = |c: Colour| 0.2126 * part(c.0) + 0.7152 * part(c.1) + 0.0722 * part(c.2) + 0.05;
        let [a, b] = [light(a), light(b)];
        a.max(b) / a.min(b)
    }

    #[test]
    fn exact_contrast_on_dark_is_enough_for_words_and_curves() {
        let ground = GROUND.on_dark();
        assert_eq!(ground, NIGHT);
        assert!(contrast(INK.on_dark(), ground) > 7.0);
        for colour in COLOURS {
            let found = contrast(colour.on_dark(), ground);
            assert!(found > 4.5, "{colour:?}: {found}");
        }
        // What is faint on white is so here, too.
        for colour in [SHADE, FAINT] {
            let [on_white, here] = [contrast(colour, GROUND), contrast(colour.on_dark(), ground)];
            assert!(
                (on_white / here - 1.0).abs() < 0.3,
                "{colour:?}: {on_white} {here}"
            );
        }
    }

    /// A wake is as strong as it is far from the ground, on either, up to the colour itself.
    #[test]
    fn invariant_shades_keep_their_order_and_hue() {
        for shade in [|x| pen(x, 1.0).colour, dye] {
            let far = |k| contrast(shade(0.1 * f64::from(k)).on_dark(), NIGHT);
            let steps: Vec<f64> = (0..=10).map(far).collect();
            assert!(steps.windows(2).all(|w| w[1] > w[0]), "{steps:?}");
        }
        let Colour(r, g, b) = COLOURS[0].on_dark();
        assert!(b > g && g > r);
    }
}

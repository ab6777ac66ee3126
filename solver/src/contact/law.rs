//! Contact law of two rounded surfaces: numbers in, force out (docs/method.md, equations
//! 17–19).

use crate::method::METHOD;
use serde::{Deserialize, Serialize};

/// Hertz stiffness with damping and Coulomb friction for one kind of contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactLaw {
    /// k of F = k δ^1.5 [N/m^1.5].
    pub stiffness: f64,
    /// Damping number η of F = η √(m k) δ^¼ δ̇.
    pub damping: f64,
    /// Coulomb friction.
    pub friction: f64,
}

impl ContactLaw {
    /// Law of a contact modulus E* [Pa], an equivalent radius R* [m], a
    /// restitution coefficient and a friction coefficient.
    pub fn hertz(contact_modulus: f64, radius: f64, restitution: f64, friction: f64) -> Self {
        Self::damped(
            contact_modulus,
            radius,
            damping_number(restitution),
            friction,
        )
    }

    /// Law with a known damping number.
    pub fn damped(contact_modulus: f64, radius: f64, damping: f64, friction: f64) -> Self {
        Self {
            stiffness: 4.0 / 3.0 * contact_modulus * radius.sqrt(),
            damping,
            friction,
        }
    }

    /// Normal force [N] at the overlap δ [m] and its rate [m/s] for an
    /// effective mass [kg]; never attractive.
    pub fn normal_force(&self, overlap: f64, rate: f64, mass: f64) -> f64 {
        if overlap <= 0.0 {
            return 0.0;
        }
        (self.elastic_force(overlap) + self.damping_coefficient(overlap, mass) * rate).max(0.0)
    }

    /// k δ^1.5 [N].
    pub fn elastic_force(&self, overlap: f64) -> f64 {
        self.stiffness * overlap * overlap.sqrt()
    }

    /// Elastic energy of the overlap, 2/5 k δ^2.5 [J].
    pub fn elastic_energy(&self, overlap: f64) -> f64 {
        0.4 * self.elastic_force(overlap) * overlap
    }

    /// η √(m k) δ^¼ [N s/m].
    pub fn damping_coefficient(&self, overlap: f64, mass: f64) -> f64 {
        self.damping * (mass * self.stiffness * overlap.sqrt()).sqrt()
    }

    /// dF/dδ of the elastic part [N/m].
    pub fn tangent_stiffness(&self, overlap: f64) -> f64 {
        1.5 * self.stiffness * overlap.max(0.0).sqrt()
    }

    /// k_t = 0.82 · 1.5 k √δ [N/m].
    pub fn tangential_stiffness(&self, overlap: f64) -> f64 {
        METHOD.stiffness.tangential_ratio * self.tangent_stiffness(overlap)
    }

    /// c_t = 0.82 η √(m k) δ^¼ [N s/m].
    pub fn tangential_damping(&self, overlap: f64, mass: f64) -> f64 {
        METHOD.stiffness.tangential_ratio * self.damping_coefficient(overlap, mass)
    }

    /// Law of the contacts of two bodies from those of each on a rigid wall, with
    /// their sphero radii [m]: both yield, 1/E* = 1/E_a + 1/E_b; both are round,
    /// 1/R* = 1/r_a + 1/r_b (equation 45). The friction is the geometric mean,
    /// so that a smooth body is smooth on any other; the damping number the mean,
    /// which is nearly the geometric mean of the restitutions.
    pub fn of_pair([a, b]: [&Self; 2], radii: [f64; 2]) -> Self {
        let modulus = |law: &Self, radius: f64| 0.75 * law.stiffness / radius.sqrt();
        let moduli = [modulus(a, radii[0]), modulus(b, radii[1])];
        // Zero where nothing presses: no gravity and no speed.
        let in_series = |[a, b]: [f64; 2]| if a > 0.0 { a * b / (a + b) } else { 0.0 };
        Self {
            stiffness: 4.0 / 3.0 * in_series(moduli) * in_series(radii).sqrt(),
            damping: 0.5 * (a.damping + b.damping),
            friction: (a.friction * b.friction).sqrt(),
        }
    }

    /// Time scale √(m/k') of a contact this deep [s].
    pub fn time_scale(&self, overlap: f64, mass: f64) -> f64 {
        (mass / self.tangent_stiffness(overlap)).sqrt()
    }
}

/// Effective contact mass [kg] of the contact of an elastic `force` [N], when all the contacts
/// of a pair part it there with `acceleration` [m/s²]: its own share of the mass, if others
/// push along; at most all of the mass, `most` [kg].
pub fn effective_contact_mass(force: f64, acceleration: f64, most: f64) -> f64 {
    if force < most * acceleration {
        force / acceleration
    } else {
        most
    }
}

/// Damping number η whose *clamped* impact returns the given restitution.
///
/// The impact of a unit mass with unit stiffness, ẍ = −max(0, x^1.5 + η x^¼ ẋ), is independent
/// of the impact speed except for scale (Tsuji 1992), so one search serves every contact: the
/// Illinois variant of regula falsi, which halves the weight of a retained end. Restitutions
/// below that of `METHOD.contact.largest_damping` (about 0.008) get that.
pub fn damping_number(restitution: f64) -> f64 {
    /// Tolerance of the restitution.
    const CLOSE: f64 = 1e-12;
    /// Far more evaluations than are needed.
    const MOST: u32 = 100;
    let excess = |damping| rebound_speed(damping) - restitution;
    let (mut low, mut high) = (
        (0.0, 1.0 - restitution),
        (
            METHOD.contact.largest_damping,
            excess(METHOD.contact.largest_damping),
        ),
    );
    if low.1 <= 0.0 {
        return low.0;
    }
    if high.1 >= 0.0 {
        return high.0;
    }
    let mut before = None;
    for _ in 0..MOST {
        let middle = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let at_middle = excess(middle);
        if at_middle.abs() < CLOSE {
            return middle;
        }
        let too_weak = at_middle > 0.0;
        let (moves, stays) = if too_weak {
            (&mut low, &mut high)
        } else {
            (&mut high, &mut low)
        };
        *moves = (middle, at_middle);
        if before == Some(too_weak) {
            stays.1 *= 0.5;
        }
        before = Some(too_weak);
    }
    0.5 * (low.0 + high.0)
}

/// Damping numbers found so far, by their restitutions: each takes some 2 ms to find.
#[derive(Debug, Default)]
pub struct Dampings(Vec<(f64, f64)>);

impl Dampings {
    /// The damping number of a restitution.
    pub fn of(&mut self, restitution: f64) -> f64 {
        let known = self.0.iter().find(|(asked, _)| *asked == restitution);
        if let Some(&(_, number)) = known {
            return number;
        }
        let number = damping_number(restitution);
        self.0.push((restitution, number));
        number
    }
}

/// Speed after an impact at unit speed of unit mass and stiffness.
fn rebound_speed(damping: f64) -> f64 {
    // The undamped contact lasts 3.2 units; 1e-3 resolves the strongest
    // damping twelvefold.
    const STEP: f64 = 1e-3;
    let acceleration = |x: f64, v: f64| {
        // Square roots take an eighth of the time of general powers.
        let x = x.max(0.0);
        let root = x.sqrt();
        -(x * root + damping * root.sqrt() * v).max(0.0)
    };
    let (mut x, mut v) = (0.0f64, 1.0f64);
    for _ in 0..1_000_000 {
        // Midpoint rule.
        let half = v + 0.5 * STEP * acceleration(x, v);
        let a = acceleration(x + 0.5 * STEP * v, half);
        x += STEP * half;
        v += STEP * a;
        let force_is_over = v < 0.0 && acceleration(x, v) == 0.0;
        if force_is_over {
            break;
        }
    }
    -v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Drops a mass on a plane and returns the rebound speed, independent of the product's own
    /// unit-impact integration: real units, another scheme.
    fn impact(restitution: f64, speed: f64) -> f64 {
        let law = ContactLaw::hertz(1e8, 0.01, restitution, 0.0);
        let (mass, dt) = (0.0642, 1e-8);
        let (mut overlap, mut rate) = (0.0, speed);
        loop {
            overlap += dt * rate;
            rate -= dt * law.normal_force(overlap, rate, mass) / mass;
            if rate < 0.0 && law.normal_force(overlap, rate, mass) == 0.0 {
                return -rate;
            }
        }
    }

    // docs/accuracy.md, case 4: the restitution is the given one within 2 %, at two speeds.
    #[test]
    fn restitution_asked_is_restitution_got() {
        for restitution in [0.1, 0.3, 0.5, 0.8, 1.0] {
            for speed in [0.3, 3.0] {
                let got = impact(restitution, speed) / speed;
                assert!((got - restitution).abs() < 0.02 * restitution, "{got}");
            }
        }
    }

    #[test]
    fn the_damping_found_rebounds_as_asked() {
        for hundredths in 1..=100 {
            let asked = f64::from(hundredths) / 100.0;
            let got = rebound_speed(damping_number(asked));
            assert!((got - asked).abs() < 1e-9, "{asked}: {got}");
        }
        assert_eq!(damping_number(0.0), METHOD.contact.largest_damping);
    }

    // docs/accuracy.md, case 3: δ_max = (5 m v²/4k)^0.4 = 0.51499 mm, 155.83 N.
    #[test]
    fn an_undamped_impact_is_that_of_hertz() {
        let law = ContactLaw::hertz(1e8, 0.01, 1.0, 0.0);
        let (mass, dt) = (0.0642, 1e-8);
        let (mut overlap, mut rate, mut deepest, mut strongest) = (0.0, 1.0, 0.0f64, 0.0f64);
        while overlap >= 0.0 {
            overlap += dt * rate;
            let force = law.normal_force(overlap, rate, mass);
            rate -= dt * force / mass;
            deepest = deepest.max(overlap);
            strongest = strongest.max(force);
        }
        assert!((deepest / 0.514_99e-3 - 1.0).abs() < 1e-3, "{deepest}");
        assert!((strongest / 155.83 - 1.0).abs() < 1e-3, "{strongest}");
        assert!((rate + 1.0).abs() < 1e-3, "{rate}");
    }

    // Two equal bodies: E*/2 and r/2; friction and damping of each.
    #[test]
    fn two_equal_bodies_are_softer_than_one_on_a_wall() {
        let law = ContactLaw::hertz(1e6, 0.01, 0.5, 0.4);
        let pair = ContactLaw::of_pair([&law, &law], [0.01, 0.01]);
        assert!((pair.stiffness * 8f64.sqrt() / law.stiffness - 1.0).abs() < 1e-14);
        assert_eq!(pair.damping, law.damping);
        assert!((pair.friction - 0.4).abs() < 1e-15);
        let smooth = ContactLaw {
            friction: 0.0,
            ..law
        };
        let on_smooth = ContactLaw::of_pair([&law, &smooth], [0.01, 0.01]);
        assert_eq!(on_smooth.friction, 0.0);
    }
}

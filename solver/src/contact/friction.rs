//! Friction of a contact: a tangential spring that slides where Coulomb's cap binds
//! (docs/method.md, equations 18 and 18a).

use crate::math::Vec3;
use serde::{Deserialize, Serialize};

/// The tangential spring of a contact, or its spring against rolling.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// Stretch ξ [m].
    pub stretch: Vec3,
    /// k_t, with the contact's share [N/m]; 0 for a new contact.
    pub stiffness: f64,
}

impl Spring {
    /// The spring of a new contact.
    pub const NEW: Self = Self {
        stretch: Vec3::new(0.0, 0.0, 0.0),
        stiffness: 0.0,
    };

    /// ½ k_t ξ² [J].
    pub fn energy(&self) -> f64 {
        0.5 * self.stiffness * self.stretch.norm_squared()
    }

    /// Sets another stiffness. A softer spring keeps its stretch, so that its force falls; a
    /// stiffer one keeps its force, so that its stretch falls (Thornton & Randall 1988). In both
    /// cases the energy falls.
    pub fn stiffen(&mut self, stiffness: f64) {
        if stiffness > self.stiffness {
            self.stretch *= self.stiffness / stiffness;
        }
        self.stiffness = stiffness;
    }

    /// Energy dissipated while the contact slid by `way` [m] and the spring changed from `before`
    /// to its present state [J]: the energy stored before, plus the work of the mean of both
    /// forces, less the energy stored now.
    fn lost_since(&self, before: &Self, way: &Vec3) -> f64 {
        let force = before.stretch * before.stiffness + self.stretch * self.stiffness;
        (before.energy() + 0.5 * force.dot(way) - self.energy()).max(0.0)
    }

    /// Turns with the bodies for `dt`, and stays in the plane across `normal`; the
    /// stretch does not grow.
    pub fn turn(&mut self, spin: &Vec3, normal: &Vec3, dt: f64) {
        let before = self.stretch.norm();
        self.stretch += spin.cross(&self.stretch) * dt;
        self.stretch -= normal * self.stretch.dot(normal);
        let after = self.stretch.norm();
        if after > before {
            self.stretch *= before / after;
        }
    }

    /// Resists sliding at a `velocity` [m/s] for `dt` [s] (equation 18); `before` is the spring
    /// before its change by stiffness or turning.
    pub fn resist(
        &mut self,
        before: &Self,
        velocity: &Vec3,
        damping: f64,
        cap: f64,
        dt: f64,
    ) -> Resistance {
        let way = velocity * dt;
        let elastic = self.slide(&way, cap);
        Resistance {
            elastic,
            viscous: viscous_part(&elastic, damping, velocity, cap),
            lost: self.lost_since(before, &way),
        }
    }

    /// Slides by `way` [m]; returns the elastic force [N], at most `cap`. Where the cap binds the
    /// contact slips, and the stretch is that of the cap.
    fn slide(&mut self, way: &Vec3, cap: f64) -> Vec3 {
        self.stretch += way;
        let size = self.stiffness * self.stretch.norm();
        if size > cap {
            self.stretch *= cap / size;
        }
        -self.stretch * self.stiffness
    }
}

/// Part that damping adds to an elastic friction force no larger than `cap` [N]: −c v, or
/// as much of it as the cap leaves room for. Its power is never positive, since the nearest force
/// within the cap is taken.
fn viscous_part(elastic: &Vec3, damping: f64, velocity: &Vec3, cap: f64) -> Vec3 {
    let trial = elastic - velocity * damping;
    let size = trial.norm();
    if size > cap {
        trial * (cap / size) - elastic
    } else {
        -velocity * damping
    }
}

/// Forces of a spring and its damping in a sub-step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resistance {
    /// Force of the spring [N].
    pub elastic: Vec3,
    /// Force of damping, before its share is taken [N].
    pub viscous: Vec3,
    /// Energy that the spring dissipated [J].
    pub lost: f64,
}

/// Stiffness and energy of several springs together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Held {
    /// Σ k_t [N/m].
    stiffness: f64,
    /// Σ ½ k_t ξ² [J].
    energy: f64,
}

impl Held {
    /// Total of these springs.
    pub fn by<'a>(springs: impl Iterator<Item = &'a Spring>) -> Self {
        springs.fold(Self::default(), |sum, spring| Self {
            stiffness: sum.stiffness + spring.stiffness,
            energy: sum.energy + spring.energy(),
        })
    }

    /// Factor on every stretch of springs that have the totals `self` now and had `before` until
    /// their stiffnesses changed and features took over springs of others: 1 where they got softer,
    /// the ratio of stiffnesses where they got stiffer together, and never so large that they store
    /// more energy.
    pub fn relaxed(&self, before: &Self) -> f64 {
        let ratio = |before: f64, now: f64| if now > before { before / now } else { 1.0 };
        let of_energy = ratio(before.energy, self.energy).sqrt();
        ratio(before.stiffness, self.stiffness).min(of_energy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stretched(along_x: f64, stiffness: f64) -> Spring {
        Spring {
            stretch: Vec3::x() * along_x,
            stiffness,
        }
    }

    #[test]
    fn friction_is_capped_and_the_spring_forgets_what_slid() {
        let mut spring = stretched(0.0, 100.0);
        let force = spring.slide(&Vec3::x(), 2.0);
        assert_eq!(force, Vec3::x() * -2.0);
        assert_eq!(spring.slide(&Vec3::zeros(), 2.0), force);
        let back = spring.slide(&(Vec3::x() * -0.01), 2.0);
        assert!((back.x + 1.0).abs() < 1e-12, "{back}");
    }

    #[test]
    fn no_change_of_stiffness_makes_energy() {
        let mut spring = stretched(1e-3, 100.0);
        let mut before = spring.energy();
        for stiffness in [200.0, 150.0, 600.0, 0.0, 50.0] {
            spring.stiffen(stiffness);
            assert!(spring.energy() <= before * (1.0 + 1e-15), "{stiffness}");
            before = spring.energy();
        }
        let (one, other) = (stretched(1e-3, 100.0), stretched(-2e-3, 50.0));
        let held = Held::by([one, other].iter());
        for stiffnesses in [[300.0, 10.0], [10.0, 300.0], [10.0, 60.0], [99.0, 49.0]] {
            let mut springs = [one, other];
            for (spring, stiffness) in springs.iter_mut().zip(stiffnesses) {
                spring.stiffness = stiffness;
            }
            let factor = Held::by(springs.iter()).relaxed(&held);
            springs
                .iter_mut()
                .for_each(|spring| spring.stretch *= factor);
            let now = Held::by(springs.iter());
            assert!(now.energy <= held.energy * (1.0 + 1e-15), "{stiffnesses:?}");
        }
    }

    // For any elastic force and cap: it dissipates energy, and its force is at most c v.
    #[test]
    fn viscous_friction_takes_energy() {
        let elastic = Vec3::new(0.3, -0.4, 0.0);
        for cap in [0.5, 0.7, 3.0] {
            for velocity in [Vec3::x(), -Vec3::x(), Vec3::y(), Vec3::new(-3.0, 4.0, 0.0)] {
                let part = viscous_part(&elastic, 2.0, &velocity, cap);
                assert!(part.dot(&velocity) <= 0.0, "{cap} {velocity}");
                assert!(part.norm() <= 2.0 * velocity.norm() + 1e-15);
                assert!((elastic + part).norm() <= cap + 1e-15);
            }
        }
    }

    #[test]
    fn turning_makes_no_stretch() {
        let mut spring = stretched(1e-3, 100.0);
        for _ in 0..1000 {
            spring.turn(&Vec3::new(0.3, 0.2, 50.0), &Vec3::z(), 1e-3);
            assert_eq!(spring.stretch.z, 0.0);
        }
        assert!(spring.stretch.norm() <= 1e-3 * (1.0 + 1e-13));
        assert!(spring.stretch.norm() > 0.99e-3, "{}", spring.stretch);
    }
}

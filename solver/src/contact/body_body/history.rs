//! Contact history of two bodies: the springs of their contacts, passed on from one body sub-step
//! to the next (docs/method.md, equation 18a).

use super::contact_points::{Contact, FeaturePair};
use crate::contact::friction::{Held, Spring};
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use serde::{Deserialize, Serialize};

/// The springs of one contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct FeatureSprings {
    pub(super) between: FeaturePair,
    /// Position of the contact, from the first body's centre [m].
    place: Vec3,
    /// Spring against sliding of the second body on the first.
    pub(super) sliding: Spring,
    /// Spring against rolling; its stretch is an angle × the equivalent radius.
    pub(super) rolling: Spring,
}

/// Energy stored in springs [J].
pub(super) fn energy_of(springs: &[FeatureSprings]) -> f64 {
    let of_contact = |springs: &FeatureSprings| springs.sliding.energy() + springs.rolling.energy();
    springs.iter().map(of_contact).sum()
}

/// Puts the springs of the contacts found into `springs`, from those `before`. A contact that
/// appears within `reach` of the place of another, as when a vertex slides over a rim, takes over
/// its stretch. Together they store no more energy than those before.
pub(super) fn carry_history(
    before: &[FeatureSprings],
    contacts: &[Contact],
    reach: f64,
    law: &ContactLaw,
    springs: &mut Vec<FeatureSprings>,
) {
    springs.clear();
    springs.extend(contacts.iter().map(|contact| {
        let history_of = history_of(before, contact, reach);
        let stiffness = law.tangential_stiffness(contact.near.overlap);
        let spring = |of: fn(&FeatureSprings) -> Spring| Spring {
            stretch: history_of.map_or_else(Vec3::zeros, |spring| of(spring).stretch),
            stiffness: contact.share * stiffness,
        };
        FeatureSprings {
            between: contact.between,
            place: contact.near.place,
            sliding: spring(|springs| springs.sliding),
            rolling: spring(|springs| springs.rolling),
        }
    }));
    let factor = |of: fn(&FeatureSprings) -> &Spring| {
        let held = Held::by(before.iter().map(of));
        Held::by(springs.iter().map(of)).relaxed(&held)
    };
    let (sliding, rolling) = (factor(|of| &of.sliding), factor(|of| &of.rolling));
    for spring in springs {
        spring.sliding.stretch *= sliding;
        spring.rolling.stretch *= rolling;
    }
}

/// The springs that a contact takes over: its own, or the nearest within `reach`.
fn history_of<'a>(
    before: &'a [FeatureSprings],
    contact: &Contact,
    reach: f64,
) -> Option<&'a FeatureSprings> {
    let distance = |springs: &FeatureSprings| (springs.place - contact.near.place).norm();
    let own = before
        .iter()
        .find(|springs| springs.between == contact.between);
    own.or_else(|| {
        let near = before.iter().filter(|springs| distance(springs) < reach);
        near.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    })
}

//! Members of a valid study.

use super::pointer::Pointer;
use super::{MemberId, Study, Violation, levels};
use crate::correlation::Copula;
use crate::design::Point;
use serde_json::Value;
use thiserror::Error;

/// Members of a study without violations: their inputs and scenarios.
#[derive(Debug, Clone)]
pub struct Ensemble<'a> {
    study: &'a Study,
    pointers: Vec<Pointer>,
    cell_size: Pointer,
    copula: Copula,
}

/// Index of a member that the design does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("there is no member {index}: the design has {members}")]
pub struct NoSuchMember {
    /// Index asked for.
    pub index: u64,
    /// Number of members of the design.
    pub members: u64,
}

impl<'a> Ensemble<'a> {
    /// Ensemble of a study.
    ///
    /// # Errors
    /// All violations of the study.
    pub fn of(study: &'a Study) -> Result<Self, Vec<Violation>> {
        let found = study.violations();
        if !found.is_empty() {
            return Err(found);
        }
        let unlikely = |message: String| vec![Violation::new("", message)];
        let inputs = study.inputs.iter();
        let pointers = inputs.map(|input| Pointer::parse(&input.pointer));
        let copula = Copula::new(study.inputs.len(), &study.correlations);
        Ok(Self {
            study,
            pointers: pointers.collect::<Result<_, _>>().map_err(unlikely)?,
            cell_size: Pointer::parse(levels::CELL_SIZE).map_err(unlikely)?,
            copula: copula.map_err(|wrong| unlikely(wrong.to_string()))?,
        })
    }

    /// The study.
    pub fn study(&self) -> &'a Study {
        self.study
    }

    /// Number of members.
    pub fn members(&self) -> u64 {
        self.study.members()
    }

    /// Number of inputs.
    pub(crate) fn inputs(&self) -> usize {
        self.study.inputs.len()
    }

    /// Values of a member's inputs, in the order of the inputs. They depend on the study and the
    /// index alone.
    ///
    /// # Errors
    /// An index that is not below the number of members.
    pub fn values(&self, index: u64) -> Result<Vec<Value>, NoSuchMember> {
        let members = self.members();
        if index >= members {
            return Err(NoSuchMember { index, members });
        }
        Ok(match self.study.design.point(index, self.inputs()) {
            Point::Values(values) => values.to_vec(),
            Point::Unit(point) => self.quantiles(&self.copula.correlated(&point)),
        })
    }

    /// Functions of a member's inputs whose mean over the inputs' distribution is 0, whatever that is:
    /// Legendre polynomials of first and second degree of each input's probability, of variance 1.
    /// None of a design whose members aren't at probabilities that are uniform.
    pub(crate) fn centred_functions(&self, index: u64) -> Vec<f64> {
        let design = &self.study.design;
        let point = match design.point(index, self.inputs()) {
            Point::Unit(point) if design.is_uniform() => self.copula.correlated(&point),
            _ => return Vec::new(),
        };
        let functions = point.iter().flat_map(|probability| {
            let x = 2.0 * probability - 1.0;
            [
                3.0_f64.sqrt() * x,
                5.0_f64.sqrt() * 0.5 * (3.0 * x * x - 1.0),
            ]
        });
        functions.collect()
    }

    /// Scenario of a member: the study's with the member's values at the inputs' places.
    ///
    /// # Errors
    /// An index that is not below the number of members.
    pub fn scenario(&self, index: u64) -> Result<Value, NoSuchMember> {
        Ok(self.scenario_of(self.values(index)?))
    }

    /// Scenario of a member on a level: on a finer one with the level's cells.
    ///
    /// # Errors
    /// An index that is not below the number of members of the design.
    pub fn scenario_on(&self, id: MemberId) -> Result<Value, NoSuchMember> {
        Ok(self.on_level(id.level, self.scenario(id.index)?))
    }

    /// Scenario with the cells of a finer level.
    pub(super) fn on_level(&self, level: u32, mut scenario: Value) -> Value {
        if let Some(size) = self.study.cell_size_m(level).filter(|_| level > 0) {
            self.cell_size.set(&mut scenario, size.into());
        }
        scenario
    }

    /// Values of the inputs at a point; null of an input without distribution, which only an
    /// explicit design has.
    pub(super) fn quantiles(&self, point: &[f64]) -> Vec<Value> {
        let quantile = |(input, probability): (&super::Input, &f64)| {
            let distribution = input.distribution.as_ref();
            distribution.map_or(Value::Null, |one| one.quantile(*probability))
        };
        self.study.inputs.iter().zip(point).map(quantile).collect()
    }

    /// Scenario with values at the inputs' places.
    pub(super) fn scenario_of(&self, values: Vec<Value>) -> Value {
        let mut scenario = self.study.scenario.clone();
        for (pointer, value) in self.pointers.iter().zip(values) {
            pointer.set(&mut scenario, value);
        }
        scenario
    }
}

use super::NodeAccess;
use crate::grid::BlockKey;
use crate::grid::fixture::PlainGrid;
use crate::kernel::Lattice;
use crate::math::{Sym3, Vec3};

impl NodeAccess for PlainGrid {
    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    fn blocks(&self) -> &[BlockKey] {
        self.layout.node_blocks()
    }

    fn place_of(&self, index: [i32; 3]) -> Option<usize> {
        self.layout.place_of(index)
    }

    fn mass(&self, place: usize) -> f64 {
        self.nodes[place].mass
    }

    fn velocity(&self, place: usize) -> Vec3 {
        self.nodes[place].velocity
    }

    fn displacement(&self, place: usize, _: f64) -> Vec3 {
        self.nodes[place].displacement
    }

    fn set_velocity(&mut self, place: usize, velocity: &Vec3, _: f64) {
        self.nodes[place].velocity = *velocity;
    }

    fn volume_fraction(&self, place: usize) -> f64 {
        self.nodes[place].volume_fraction
    }

    fn set_volume_fraction(&mut self, place: usize, volume_fraction: f64) {
        self.nodes[place].volume_fraction = volume_fraction;
    }

    fn strain_rate(&self, place: usize) -> Sym3 {
        self.nodes[place].strain_rate
    }

    fn set_strain_rate(&mut self, place: usize, strain_rate: &Sym3) {
        self.nodes[place].strain_rate = *strain_rate;
    }

    fn compressive_strain(&self, place: usize) -> f64 {
        self.nodes[place].compressive_strain
    }

    fn set_compressive_strain(&mut self, place: usize, strain: f64) {
        self.nodes[place].compressive_strain = strain;
    }
}

//! Machine on which a measurement was made.

pub(super) use scree::machine::cores;
use scree_solver::Instructions;
use serde::Serialize;
use std::fs;

/// Properties of the machine that affect the measurements.
#[derive(Debug, Serialize)]
pub(super) struct Machine {
    /// Model of the processor, if the system reports it.
    pub(super) processor: Option<String>,
    /// Number of hardware threads.
    pub(super) cores: usize,
    /// Best instruction set for which the kernels have code.
    pub(super) instructions: String,
    /// True if the program was built without optimisation.
    pub(super) debug_build: bool,
}

impl Machine {
    /// The machine that runs this program.
    pub(super) fn here() -> Self {
        let described = fs::read_to_string("/proc/cpuinfo").ok();
        Self {
            processor: described.as_deref().and_then(model),
            cores: cores(),
            instructions: Instructions::detected().to_string(),
            debug_build: cfg!(debug_assertions),
        }
    }

    /// Description in one line.
    pub(super) fn in_words(&self) -> String {
        let processor = self.processor.as_deref().unwrap_or("unknown processor");
        let warning = if self.debug_build {
            ", a debug build: not to be quoted"
        } else {
            ""
        };
        format!(
            "{processor}, {} cores, {}{warning}",
            self.cores, self.instructions
        )
    }
}

/// One thread and all; one number if both are the same.
pub(super) fn one_and_all() -> Vec<usize> {
    let mut threads = vec![1, cores()];
    threads.dedup();
    threads
}

/// Instruction sets that are present.
pub(super) fn instruction_sets() -> impl Iterator<Item = Instructions> {
    let all = [
        Instructions::Baseline,
        Instructions::Avx2,
        Instructions::Avx512,
    ];
    let best = Instructions::detected();
    all.into_iter().filter(move |set| *set <= best)
}

fn model(described: &str) -> Option<String> {
    let line = described
        .lines()
        .find(|line| line.starts_with("model name"))?;
    let (_, model) = line.split_once(':')?;
    Some(model.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_is_read_from_what_linux_tells() {
        let told = "processor\t: 0\nmodel name\t: Some CPU @ 2 GHz\nprocessor\t: 1\n";
        assert_eq!(model(told).as_deref(), Some("Some CPU @ 2 GHz"));
        assert_eq!(model("processor\t: 0\n"), None);
    }
}

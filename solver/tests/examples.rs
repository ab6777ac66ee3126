//! The examples, each run as a test.

#[path = "../examples/cube_in_flow.rs"]
mod cube_in_flow;
#[path = "../examples/heap.rs"]
mod heap;
#[path = "../examples/plan.rs"]
mod plan;
#[path = "../examples/records.rs"]
mod records;
#[path = "../examples/step_by_step.rs"]
mod step_by_step;
#[path = "../examples/violations.rs"]
mod violations;

#[test]
fn cube_in_flow_runs() -> Result<(), Box<dyn std::error::Error>> {
    cube_in_flow::main()
}

#[test]
fn heap_runs() -> Result<(), Box<dyn std::error::Error>> {
    heap::main()
}

#[test]
fn plan_runs() -> Result<(), Box<dyn std::error::Error>> {
    plan::main()
}

#[test]
fn records_runs() -> Result<(), Box<dyn std::error::Error>> {
    records::main()
}

#[test]
fn step_by_step_runs() -> Result<(), Box<dyn std::error::Error>> {
    step_by_step::main()
}

#[test]
fn violations_runs() -> Result<(), Box<dyn std::error::Error>> {
    violations::main()
}

-- Keys of outcomes and plans that misled got other names; what was stored before follows, so
-- that a job reads the same whenever it ended. In JSON no text holds a quotation mark that is
-- not escaped, and no text in them is a single one of these words, so each is a key or one of
-- the values meant.

-- An ended job is not changed but by this.
DROP TRIGGER jobs_final_states_are_sinks;

UPDATE jobs SET outcome =
    replace(replace(replace(replace(replace(replace(replace(replace(replace(outcome,
        '"mass_left_kg":', '"outflow_mass_kg":'),
        '"volume_left_out_m3":', '"excluded_volume_m3":'),
        '"points_put_back":', '"penetration_corrections":'),
        '"points_left":', '"points_outflow":'),
        '"angular_momentum_spread":', '"angular_momentum_from_shifting":'),
        '"audit":', '"conservation":'),
        '"companions":', '"refinement_runs":'),
        '"one_companion"', '"one_refinement_run"'),
        '"softer"', '"reduced_stiffness"')
WHERE outcome IS NOT NULL;

UPDATE jobs SET plan =
    replace(replace(plan,
        '"companions":', '"refinement_runs":'),
        '"softer"', '"reduced_stiffness"')
WHERE plan IS NOT NULL;

-- A final state is a sink: whatever asks for it, the job never leaves it, and
-- how and when it ended stays as it was.
CREATE TRIGGER jobs_final_states_are_sinks
BEFORE UPDATE OF status, finished_ms, outcome, problem ON jobs
WHEN OLD.status IN ('successful', 'failed', 'dismissed')
BEGIN
    SELECT RAISE(ABORT, 'the job has ended');
END;

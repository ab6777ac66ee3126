-- Keys of the outcome that misled got other names; outcomes stored before follow, so that a
-- job reads the same whenever it ended. In JSON no text holds a quotation mark that is not
-- escaped, so each of these is a key.

-- An ended job is not changed but by this.
DROP TRIGGER jobs_final_states_are_sinks;

UPDATE jobs SET outcome =
    replace(replace(replace(replace(replace(replace(outcome,
        '"mass_left_kg":', '"outflow_mass_kg":'),
        '"volume_left_out_m3":', '"excluded_volume_m3":'),
        '"points_put_back":', '"penetration_corrections":'),
        '"points_left":', '"points_outflow":'),
        '"angular_momentum_spread":', '"angular_momentum_from_shifting":'),
        '"audit":', '"conservation":')
WHERE outcome IS NOT NULL;

-- A final state is a sink: whatever asks for it, the job never leaves it, and
-- how and when it ended stays as it was.
CREATE TRIGGER jobs_final_states_are_sinks
BEFORE UPDATE OF status, finished_ms, outcome, problem ON jobs
WHEN OLD.status IN ('successful', 'failed', 'dismissed')
BEGIN
    SELECT RAISE(ABORT, 'the job has ended');
END;

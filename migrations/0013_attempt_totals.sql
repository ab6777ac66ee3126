-- Ended attempts by kind of end, those of removed jobs included: a counter never falls.
CREATE TABLE attempt_totals (
    ending TEXT    NOT NULL PRIMARY KEY,
    total  INTEGER NOT NULL CHECK (total >= 0)
) STRICT;

INSERT INTO attempt_totals (ending, total)
SELECT ending, count(*) FROM attempts WHERE ending IS NOT NULL GROUP BY ending;

CREATE TRIGGER ended_attempts_are_counted
AFTER UPDATE OF ending ON attempts
WHEN OLD.ending IS NULL AND NEW.ending IS NOT NULL
BEGIN
    INSERT OR IGNORE INTO attempt_totals (ending, total) VALUES (NEW.ending, 0);
    UPDATE attempt_totals SET total = total + 1 WHERE ending = NEW.ending;
END;

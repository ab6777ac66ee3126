import { useEffect, useState } from "preact/hooks";

/** Time in which a second press confirms the first [ms]. */
const PATIENCE_MS = 5_000;

/** Button for what can't be undone: its first press asks, its second one does it. */
export function ConfirmButton({ label, question, act }: { label: string; question: string; act: () => void }) {
  const [isAsking, setIsAsking] = useState(false);
  useEffect(() => {
    if (!isAsking) return;
    const timer = setTimeout(() => setIsAsking(false), PATIENCE_MS);
    return () => clearTimeout(timer);
  }, [isAsking]);
  const press = () => {
    setIsAsking(!isAsking);
    if (isAsking) act();
  };
  return (
    <button type="button" onClick={press} aria-live="polite">
      {isAsking ? question : label}
    </button>
  );
}

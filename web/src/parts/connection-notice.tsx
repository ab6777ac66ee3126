import { useEffect, useState } from "preact/hooks";
import { onConnection } from "../events/events";

/** Time for which a break is not worth a word [ms]. */
const PATIENCE_MS = 2_500;

/** Notice that the service does not tell what happens, for as long as it does not. */
export function ConnectionNotice() {
  const [isLost, setIsLost] = useState(false);
  const [isShown, setIsShown] = useState(false);
  useEffect(() => onConnection(setIsLost), []);
  useEffect(() => {
    if (!isLost) return setIsShown(false);
    const timer = setTimeout(() => setIsShown(true), PATIENCE_MS);
    return () => clearTimeout(timer);
  }, [isLost]);
  return (
    <div role="status">
      {isShown && (
        <p class="notice warning connection">
          The service does not answer. What is shown may be out of date; it is brought up to date once the service is
          back.
        </p>
      )}
    </div>
  );
}

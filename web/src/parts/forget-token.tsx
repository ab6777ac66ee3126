import { useEffect, useState } from "preact/hooks";
import { onTokenChange, setToken, token } from "../api/token";

/** Button that forgets the access token of this tab, if there is one. */
export function ForgetToken() {
  const [isKept, setIsKept] = useState(token() !== null);
  useEffect(() => onTokenChange(() => setIsKept(token() !== null)), []);
  if (!isKept) return null;
  return (
    <button type="button" onClick={() => setToken(null)}>
      Forget the token
    </button>
  );
}

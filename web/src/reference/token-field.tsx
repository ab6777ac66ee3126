import { useEffect, useState } from "preact/hooks";
import { onTokenChange, setToken, token } from "../api/token";

/** Field for the access token with which this page tries requests. */
export function TokenField() {
  const [has, setHas] = useState(token() !== null);
  useEffect(() => onTokenChange(() => setHas(token() !== null)), []);
  const submit = (event: SubmitEvent) => {
    event.preventDefault();
    const form = event.currentTarget as HTMLFormElement;
    setToken(String(new FormData(form).get("token")).trim());
    form.reset();
  };
  return (
    <form class="actions" onSubmit={submit} aria-label="Access token">
      <label>
        Access token <input name="token" type="password" autocomplete="off" required />
      </label>
      <button type="submit">Use it</button>
      {has && (
        <button type="button" onClick={() => setToken(null)}>
          Forget it
        </button>
      )}
      <span role="status">
        {has ? "Requests from this tab show a token." : "No token: enough for a service that asks for none."}
      </span>
    </form>
  );
}

import { useEffect, useRef, useState } from "preact/hooks";
import { onUnauthorized } from "../api/client";
import { setToken, token } from "../api/token";

/** Question for an access token, asked once the service wants one. */
export function TokenDialog() {
  const dialog = useRef<HTMLDialogElement>(null);
  const [wasRefused, setWasRefused] = useState(false);
  useEffect(
    () =>
      onUnauthorized(() => {
        setWasRefused(token() !== null);
        if (dialog.current && !dialog.current.open) dialog.current.showModal();
      }),
    [],
  );
  const submit = (event: SubmitEvent) => {
    event.preventDefault();
    const given = new FormData(event.target as HTMLFormElement).get("token");
    dialog.current?.close();
    setToken(String(given).trim());
  };
  return (
    <dialog ref={dialog} aria-labelledby="token-title">
      <form onSubmit={submit}>
        <h2 id="token-title">This service needs an access token</h2>
        <p>
          {wasRefused ? "The token was not accepted. " : ""}
          Its operator makes one with <code>scree token</code>. It is kept in this tab until it is closed.
        </p>
        <label>
          Access token
          <input name="token" type="password" autocomplete="off" required />
        </label>
        <div class="actions">
          <button type="submit" class="primary">
            Use it
          </button>
          <button type="button" onClick={() => dialog.current?.close()}>
            Not now
          </button>
        </div>
      </form>
    </dialog>
  );
}

import { useRef, useState } from "preact/hooks";
import { ROOT, type Scenario } from "../../api/client";
import { token } from "../../api/token";
import { copyText } from "../../parts/copy-text";
import { curlRecipe, pythonRecipe } from "./recipes";

/** Command and program that make the same job. */
export function Recipes({ scenario }: { scenario: Scenario }) {
  const service = location.origin + ROOT;
  const needsToken = token() !== null;
  return (
    <section aria-labelledby="recipes">
      <h2 id="recipes">The same job without this page</h2>
      {needsToken && (
        <p>
          Both take the access token from the environment variable <code>SCREE_TOKEN</code>.
        </p>
      )}
      <div class="columns">
        <Recipe title="curl" text={curlRecipe(service, scenario, needsToken)} />
        <Recipe title="Python" text={pythonRecipe(service, scenario, needsToken)} />
      </div>
    </section>
  );
}

function Recipe({ title, text }: { title: string; text: string }) {
  const [said, setSaid] = useState("");
  const lines = useRef<HTMLPreElement>(null);
  const copy = async () => setSaid((await copyText(text, lines.current)) ? "Copied" : "Selected: copy it with Ctrl+C");
  return (
    <div class="card">
      <div class="actions">
        <h3>{title}</h3>
        <button type="button" aria-label={`Copy the lines for ${title}`} onClick={() => void copy()}>
          Copy
        </button>
        <span role="status">{said}</span>
      </div>
      <pre ref={lines} class="recipe" tabIndex={0} role="region" aria-label={`Lines for ${title}`}>
        {text}
      </pre>
    </div>
  );
}

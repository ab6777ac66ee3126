import { ROOT } from "../api/client";
import minimal from "../../../configs/scenarios/minimal.json";
import { shellWord } from "../parts/shell";
import { CopyLine } from "./copy-line";

/** Five steps from a scenario to its results. */
export function Beginning() {
  const root = location.origin + ROOT;
  const steps = [
    {
      name: "Submit a scenario",
      link: "submit",
      text: "The answer has the job's id. The job is on disk when it is sent.",
      line: `curl -H 'Content-Type: application/json' --data ${shellWord(JSON.stringify(minimal))} ${shellWord(`${root}v1/jobs`)}`,
    },
    {
      name: "Wait for the job",
      link: "show",
      text: "The answer comes when the job has ended, at the latest after 60 s.",
      line: `curl "${root}v1/jobs/$ID?wait=60s"`,
    },
    {
      name: "Read the outcome",
      link: "show",
      text: "The same document has the outcome: where each body ended up, and how far to trust it.",
      line: `curl "${root}v1/jobs/$ID" | jq .outcome`,
    },
    {
      name: "Read a trajectory",
      link: "trajectory",
      text: "Place, speed and forces of a body at each sample; also as JSON, NDJSON and NPZ.",
      line: `curl "${root}v1/jobs/$ID/trajectory.csv?body=0"`,
    },
    {
      name: "Read the flow",
      link: "flow",
      text: "The snapshot nearest to a time; flow.zip has all of them for ParaView.",
      line: `curl "${root}v1/jobs/$ID/flow?time_s=0.5"`,
    },
  ];
  return (
    <section aria-labelledby="beginning">
      <h2 id="beginning">To begin with</h2>
      <ol class="steps">
        {steps.map(({ name, link, text, line }) => (
          <li key={name}>
            <a href={`#${link}`}>{name}</a>. {text}
            <CopyLine line={line} name={name} />
          </li>
        ))}
      </ol>
      <p>
        Where the service has access tokens, add <code>-H "Authorization: Bearer $SCREE_TOKEN"</code> to each line.
      </p>
    </section>
  );
}

import { useState } from "preact/hooks";
import { type Job, request } from "../../api/client";
import { size } from "../../parts/format";
import { ProblemNotice } from "../../parts/problem-notice";
import { saveFile } from "../../parts/save-file";
import { groundOf } from "../../scenario/ground";

interface Download {
  /** Path below the service's root; of a document of this page none. */
  path?: string;
  document?: unknown;
  file: string;
  about: string;
}

/** Maps of a flow on a terrain. */
const MAPS = {
  flow_height_max: "largest flow height",
  flow_speed_max: "largest speed",
  arrival_time: "first time at which the flow was there",
  deposit: "flow height at the end",
};

/** Maps and tracks of a job on a terrain, for QGIS and other programs. */
function mapsOf(root: string, hasFlow: boolean): Download[] {
  const formats = { tif: "GeoTIFF", asc: "ESRI ASCII grid" };
  const maps = Object.entries(MAPS).flatMap(([name, about]) =>
    Object.entries(formats).map(([ending, format]) => ({
      path: `${root}/maps/${name}.${ending}`,
      file: `${name}.${ending}`,
      about: `${about}, ${format}`,
    })),
  );
  const tracks = `${root}/tracks.geojson`;
  return [
    ...(hasFlow ? maps : []),
    {
      path: `${tracks}?coordinates=wgs84`,
      file: "tracks.geojson",
      about: "outlines and tracks by longitude and latitude",
    },
    {
      path: `${tracks}?coordinates=map`,
      file: "tracks-map.geojson",
      about: "the same in the height map's coordinates",
    },
  ];
}

/** All records of a job as files. */
export function Downloads({ job }: { job: Job }) {
  const [body, setBody] = useState(0);
  const root = `v1/jobs/${job.id}`;
  const hasFlow = job.scenario.flow !== null;
  const bodies = job.scenario.bodies.length;
  const files: Download[] = [
    { document: job.scenario, file: "scenario.json", about: "scenario with every default" },
    ...(job.outcome ? [{ document: job.outcome, file: "outcome.json", about: "outcome" }] : []),
    ...(bodies > 0 ? [{ path: `${root}/motion.svg`, file: "motion.svg", about: "displacement and speed, drawn" }] : []),
    { path: `${root}/aerial.svg`, file: "aerial.svg", about: "from above, drawn" },
    ...(hasFlow || bodies > 0
      ? [{ path: `${root}/flow.zip`, file: "flow.zip", about: "flow and bodies for ParaView" }]
      : []),
    ...(hasFlow ? [{ path: `${root}/flow.bin`, file: "flow.bin", about: "frames of the flow, binary" }] : []),
    ...(job.outcome && groundOf(job.scenario) === "terrain" ? mapsOf(root, hasFlow) : []),
  ];
  const trajectories: Download[] = [".csv", ".npz", ".ndjson", ""].map((ending) => ({
    path: `${root}/trajectory${ending}?body=${body}`,
    file: `trajectory-${body}${ending || ".json"}`,
    about: { ".csv": "table", ".npz": "NumPy", ".ndjson": "a sample a line", "": "columns" }[ending] ?? "",
  }));
  return (
    <section aria-labelledby="downloads">
      <h2 id="downloads">Files</h2>
      <ul class="downloads">
        {files.map((file) => (
          <DownloadItem key={file.file} download={file} />
        ))}
      </ul>
      {bodies > 0 && (
        <>
          <label class="inline">
            Trajectory of body{" "}
            <select value={body} onChange={(event) => setBody(Number(event.currentTarget.value))}>
              {job.scenario.bodies.map((_, place) => (
                <option key={place} value={place}>
                  {place}
                </option>
              ))}
            </select>
          </label>
          <ul class="downloads">
            {trajectories.map((file) => (
              <DownloadItem key={file.file} download={file} />
            ))}
          </ul>
        </>
      )}
    </section>
  );
}

function DownloadItem({ download }: { download: Download }) {
  const [read, setRead] = useState<number>();
  const [problem, setProblem] = useState<unknown>();
  const start = async () => {
    setProblem(undefined);
    try {
      saveFile(await fetched(download, setRead), download.file);
    } catch (error) {
      setProblem(error);
      setRead(undefined);
    }
  };
  return (
    <li>
      <button type="button" onClick={() => void start()}>
        {download.file}
      </button>{" "}
      <span class="quiet">
        {download.about}
        {read !== undefined && `, ${size(read)}`}
      </span>
      {problem ? <ProblemNotice problem={problem} /> : null}
    </li>
  );
}

/** A file's content, read with the token, which a plain link would not show. */
async function fetched({ path, document }: Download, tell: (bytes: number) => void): Promise<Blob> {
  if (path === undefined) {
    const blob = new Blob([`${JSON.stringify(document, null, 2)}\n`], { type: "application/json" });
    tell(blob.size);
    return blob;
  }
  const response = await request(path);
  const pieces: Uint8Array<ArrayBuffer>[] = [];
  let bytes = 0;
  const reader = response.body?.getReader();
  for (;;) {
    const piece = await reader?.read();
    if (!piece || piece.done) break;
    pieces.push(piece.value);
    bytes += piece.value.length;
    tell(bytes);
  }
  return new Blob(pieces, { type: response.headers.get("Content-Type") ?? "application/octet-stream" });
}

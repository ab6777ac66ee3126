import { useRef, useState } from "preact/hooks";
import { type Schemas, request } from "../api/client";
import { figure } from "../parts/format";
import { tokens } from "../parts/json-document";
import { ProblemNotice } from "../parts/problem-notice";
import { useAnswer } from "../parts/use-answer";
import type { PlainProps } from "./field";
import { useForm } from "./form-context";
import { labelOf } from "./words";

/** A stored map. */
type StoredMap = Schemas["TerrainDescription"] & { hash: string };

/** What the values of a map are, by the key of the field that names it. */
const PURPOSES: Record<string, Schemas["TerrainPurpose"]> = {
  height_map: "height-map",
  base_friction_map: "friction",
  thickness_map: "thickness",
  surface_map: "surface",
};

/** Select of a stored map, and the means to upload one. */
export function MapInput({ pointer, value, input, isRequired }: PlainProps) {
  const { edit } = useForm();
  const key = tokens(pointer).at(-1) ?? "";
  const purpose = PURPOSES[key] ?? "height-map";
  const stored = useAnswer(readMaps, []);
  const upload = useUpload(purpose, (hash) => {
    edit(pointer, hash);
    stored.again();
  });
  const hash = typeof value === "string" ? value : "";
  const maps = (stored.value ?? []).filter((map) => map.purpose === purpose || map.hash === hash);
  const { "aria-required": _, ...attributes } = input;
  return (
    <div class="map">
      <select
        {...attributes}
        required={isRequired}
        value={hash}
        onChange={({ currentTarget }) => edit(pointer, currentTarget.value === "" ? undefined : currentTarget.value)}
      >
        <option value="">{isRequired ? "choose one" : "none"}</option>
        {hash !== "" && !maps.some((map) => map.hash === hash) && <option value={hash}>{hash.slice(0, 12)}</option>}
        {maps.map((map) => (
          <option key={map.hash} value={map.hash}>
            {mapText(map)}
          </option>
        ))}
      </select>
      <Upload label={labelOf(key).toLowerCase()} isBusy={upload.isBusy} onFile={upload.send} />
      {stored.problem !== undefined && <p class="notice warning">The list of stored maps could not be read.</p>}
      {upload.problem !== undefined && <ProblemNotice problem={upload.problem} />}
    </div>
  );
}

function Upload({ label, isBusy, onFile }: { label: string; isBusy: boolean; onFile: (file: File) => void }) {
  const file = useRef<HTMLInputElement>(null);
  return (
    <>
      <button type="button" disabled={isBusy} onClick={() => file.current?.click()}>
        {isBusy ? "Uploading …" : "Upload a map …"}
        <span class="hidden"> as {label}</span>
      </button>
      <input
        ref={file}
        class="hidden"
        type="file"
        accept=".tif,.tiff,.asc,.txt,image/tiff,text/plain"
        aria-label={`File of the ${label}, a GeoTIFF or an ESRI ASCII grid`}
        tabIndex={-1}
        onChange={({ currentTarget }) => {
          const [chosen] = currentTarget.files ?? [];
          if (chosen) onFile(chosen);
          currentTarget.value = "";
        }}
      />
    </>
  );
}

/** Upload of a file as a map. */
function useUpload(purpose: Schemas["TerrainPurpose"], onHash: (hash: string) => void) {
  const [isBusy, setIsBusy] = useState(false);
  const [problem, setProblem] = useState<unknown>();
  const send = (file: File) => {
    setIsBusy(true);
    setProblem(undefined);
    const headers = { "Content-Type": "application/octet-stream" };
    request(`v1/terrains?purpose=${purpose}`, { method: "POST", headers, body: file })
      .then(async (answer) => onHash(((await answer.json()) as StoredMap).hash))
      .catch(setProblem)
      .finally(() => setIsBusy(false));
  };
  return { isBusy, problem, send };
}

/** The newest of the stored maps. */
async function readMaps(signal: AbortSignal): Promise<StoredMap[]> {
  const answer = await request("v1/terrains?limit=100", { signal });
  return ((await answer.json()) as { terrains: StoredMap[] }).terrains;
}

/** Size and heights of a map, and the beginning of its name. */
function mapText({ hash, columns, rows, cell_size_m: cell, lowest_m: lowest, highest_m: highest }: StoredMap): string {
  const heights = lowest === null ? "" : `, ${figure(lowest, 4)} to ${figure(highest, 4)} m`;
  return `${columns} × ${rows} cells of ${figure(cell)} m${heights} (${hash.slice(0, 8)})`;
}

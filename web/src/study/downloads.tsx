import { useState } from "preact/hooks";
import { ProblemNotice } from "../parts/problem-notice";
import { saveAnswer } from "../parts/save-file";
import type { StudyQuestion } from "./documents";

/** A file of a study: its name behind the study's address, and what it is. */
interface StudyFile {
  path: string;
  name: string;
  label: string;
}

/** Files of the whole study. */
export function StudyFiles({ id }: { id: string }) {
  const files = [
    { path: "members.csv", name: "members.csv", label: "Members as CSV" },
    { path: "members.npz", name: "members.npz", label: "Members as NPZ (NumPy)" },
    { path: "scatter.svg", name: "scatter.svg", label: "Quantities against inputs (SVG)" },
    { path: "answers", name: "answers.json", label: "Answers as JSON" },
  ];
  return <Files id={id} files={files} name="Files of the study" />;
}

/** Files of the answer to one question. */
export function AnswerFiles({ id, place, question }: { id: string; place: number; question: StudyQuestion }) {
  const file = (kind: string, ending: string, label: string): StudyFile => ({
    path: `${kind}.${ending}?question=${place}`,
    name: `${kind}-${place}.${ending}`,
    label,
  });
  if ("rest" in question) {
    const files = [
      file("rest", "svg", "Picture (SVG)"),
      file("rest", "geojson", "Regions (GeoJSON)"),
      file("rest", "tif", "Density (GeoTIFF)"),
    ];
    return <Files id={id} files={files} name="Files of this map" />;
  }
  if ("sensitivity" in question)
    return <Files id={id} files={[file("sensitivity", "svg", "Picture (SVG)")]} name="Files of this answer" />;
  return null;
}

function Files({ id, files, name }: { id: string; files: StudyFile[]; name: string }) {
  const [problem, setProblem] = useState<unknown>();
  const save = ({ path, name }: StudyFile) => {
    setProblem(undefined);
    saveAnswer(`v1/studies/${id}/${path}`, `study-${id.slice(0, 8)}-${name}`).catch(setProblem);
  };
  return (
    <>
      <div class="actions" role="group" aria-label={name}>
        {files.map((file) => (
          <button key={file.path} type="button" onClick={() => save(file)}>
            {file.label}
          </button>
        ))}
      </div>
      {problem !== undefined && <ProblemNotice problem={problem} />}
    </>
  );
}

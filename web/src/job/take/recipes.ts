/** Command and program that make the same job, for those who go on without this page. */

import type { Scenario } from "../../api/client";
import { shellWord } from "../../parts/shell";

/** A shell command that submits a scenario to a service. The token is never written out. */
export function curlRecipe(service: string, scenario: Scenario, needsToken: boolean): string {
  const lines = [`curl ${shellWord(`${service}v1/jobs`)}`, `-H 'Content-Type: application/json'`];
  if (needsToken) lines.push(`-H "Authorization: Bearer $SCREE_TOKEN"`);
  lines.push(`--data-binary ${shellWord(JSON.stringify(scenario))}`);
  return lines.join(" \\\n  ");
}

/** A Python program that submits a scenario to a service and waits for the outcome. */
export function pythonRecipe(service: string, scenario: Scenario, needsToken: boolean): string {
  const token = needsToken ? `, token=os.environ["SCREE_TOKEN"]` : "";
  return [
    ...(needsToken ? ["import os", ""] : []),
    "import scree",
    "",
    `scenario = ${pythonLiteral(scenario)}`,
    `job = scree.run(scenario, url=${JSON.stringify(service.replace(/\/$/, ""))}${token})`,
    "print(job.outcome)",
  ].join("\n");
}

/** A JSON value as a Python literal. */
export function pythonLiteral(value: unknown, indent = ""): string {
  if (value === null || value === undefined) return "None";
  if (value === true) return "True";
  if (value === false) return "False";
  if (typeof value !== "object") return JSON.stringify(value);
  const deeper = `${indent}    `;
  const isList = Array.isArray(value);
  const parts = isList
    ? value.map((item) => pythonLiteral(item, deeper))
    : Object.entries(value).map(([key, item]) => `${JSON.stringify(key)}: ${pythonLiteral(item, deeper)}`);
  const [open, close] = isList ? "[]" : "{}";
  if (parts.length === 0) return `${open}${close}`;
  const isShort = isList && value.every((item) => typeof item === "number");
  if (isShort) return `${open}${parts.join(", ")}${close}`;
  return `${open}\n${parts.map((part) => `${deeper}${part},\n`).join("")}${indent}${close}`;
}

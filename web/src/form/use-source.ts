import { api, data } from "../api/client";
import { type Answer, useAnswer } from "../parts/use-answer";
import type { JsonObject } from "../parts/json-document";
import { type Schemas, resolved, withoutDefaults } from "../scenario/schema";
import { type Draft, readDraft } from "./draft";
import { PRESETS, presetOf } from "./presets";

/** Scenario that the form of an address begins with: its draft, or what the address names. */
export function useSource(search: string, schemas: Schemas): Answer<{ search: string; draft: Draft }> {
  return useAnswer(async () => {
    return { search, draft: readDraft(search) ?? (await sourceOf(new URLSearchParams(search), schemas)) };
  }, [search]);
}

async function sourceOf(query: URLSearchParams, schemas: Schemas): Promise<Draft> {
  const job = query.get("job");
  if (job !== null) return { ...whole(await scenarioOf(job, schemas)), from: `job ${job.slice(0, 8)}` };
  const name = query.get("preset");
  const preset = name === null ? PRESETS[0] : presetOf(name);
  if (!preset)
    throw new Error(`There is no example "${name}". Choose one of the list, or begin with an empty address.`);
  return { ...whole(preset.scenario), from: "the example" };
}

const whole = (document: JsonObject) => ({ document, original: document, isOfFile: false });

/** Scenario of a job without the defaults that the service has filled in. */
async function scenarioOf(id: string, schemas: Schemas): Promise<JsonObject> {
  const job = await data(api.GET("/v1/jobs/{id}", { params: { path: { id } } }));
  const scenario = resolved({ $ref: "#/components/schemas/Scenario" }, schemas);
  return withoutDefaults(job.scenario as unknown as JsonObject, scenario, schemas) as JsonObject;
}

import { expect, test } from "@playwright/test";
import { readFile } from "node:fs/promises";
import { curlLine, pathOf } from "../src/reference/asking";
import { type Document, type Request, changesSomething, interfaceOf } from "../src/reference/contract";
import { factsOf, kindOf, rangeOf } from "../src/reference/schema-text";
import { holds } from "../src/reference/search";

const whole = interfaceOf(JSON.parse(await readFile("../api/openapi.json", "utf8")) as Document);

function request(id: string): Request {
  const found = whole.groups.flatMap(({ requests }) => requests).find((request) => request.id === id);
  if (!found) throw new Error(`no request ${id}`);
  return found;
}

const HERE = { root: "http://here", hasToken: false };

test("every request of the contract is in a group, in the order of the tags", async () => {
  const { paths, tags } = JSON.parse(await readFile("../api/openapi.json", "utf8")) as Document;
  const requests = Object.values(paths).flatMap((methods) => Object.keys(methods));
  expect(whole.groups.map(({ name }) => name)).toEqual(tags.map(({ name }) => name));
  const ids = whole.groups.flatMap(({ requests }) => requests.map(({ id }) => id));
  expect(ids).toHaveLength(requests.length);
  expect(new Set(ids).size).toBe(ids.length);
});

test("paths and queries are made of the parameters", () => {
  const values = { "path id": "a b", "query body": "1", "query fields": "time_s,mode", "query stride": " " };
  expect(pathOf(request("trajectory"), values)).toBe("/v1/jobs/a%20b/trajectory?body=1&fields=time_s,mode");
  expect(pathOf(request("submit"), { "query label": "one, two" })).toBe("/v1/jobs?label=one&label=two");
  expect(pathOf(request("show"), {})).toBe("/v1/jobs/{id}");
});

test("curl lines can be pasted into a shell", () => {
  expect(curlLine(request("list"), {}, "", HERE)).toBe("curl 'http://here/v1/jobs'");
  expect(curlLine(request("dismiss"), { "path id": "1" }, "", HERE)).toBe("curl -X DELETE 'http://here/v1/jobs/1'");
  expect(curlLine(request("submit"), {}, '{\n  "title": "it\'s"\n}', HERE)).toBe(
    `curl -H 'Content-Type: application/json' --data '{"title":"it'\\''s"}' 'http://here/v1/jobs'`,
  );
  expect(curlLine(request("events"), {}, "", { ...HERE, hasToken: true })).toBe(
    `curl -N -H "Authorization: Bearer $SCREE_TOKEN" 'http://here/v1/events'`,
  );
  expect(curlLine(request("health"), {}, "", { ...HERE, hasToken: true })).not.toContain("Authorization");
});

test("requests that change something are told from those that do not", () => {
  const changing = whole.groups.flatMap(({ requests }) => requests.filter(changesSomething).map(({ id }) => id));
  expect(changing).toEqual(
    expect.arrayContaining([
      "submit",
      "submit_batch",
      "dismiss",
      "submit_study",
      "enlarge_study",
      "dismiss_study",
      "execute",
    ]),
  );
  expect(changing).not.toContain("plan");
  expect(changing).not.toContain("plan_study");
  expect(changing).not.toContain("list");
});

test("schemas are told in words", () => {
  expect(kindOf({ type: "array", items: { $ref: "#/components/schemas/Body" } })).toBe("list of Body");
  expect(kindOf({ type: ["string", "null"] })).toBe("string or null");
  expect(rangeOf({ minimum: 0, maximum: 89 })).toBe("0 ≤ x ≤ 89");
  expect(rangeOf({ exclusiveMinimum: 0 })).toBe("0 < x");
  expect(rangeOf({ minItems: 3, maxItems: 3 })).toBe("3 entries");
  expect(factsOf({ type: "number", "x-unit": "m", default: 0.2 })).toEqual(["unit m", "default 0.2"]);
});

test("a search finds what holds all its words", () => {
  expect(holds("GET /v1/jobs List jobs, newest first", "jobs LIST")).toBe(true);
  expect(holds("GET /v1/jobs", "jobs studies")).toBe(false);
  expect(holds("anything", "")).toBe(true);
});

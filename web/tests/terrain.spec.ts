/** Scenarios and jobs on a terrain, in every view. */

import { readFile } from "node:fs/promises";
import type { Page } from "@playwright/test";
import type { Contract } from "../src/api/client";
import { hasOther, onGround, schemasOn, withoutOther } from "../src/form/ground";
import { regionOf } from "../src/job/region";
import { sentencesOf } from "../src/job/outcome/sentences";
import { flowQuantities } from "../src/job/outcome/quantities";
import { documentOf, plan } from "./form-page";
import { QUICK, type Service, expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";
import { finished } from "./study-scenes";

/** An ESRI ASCII grid of 12 × 12 cells of 1 m: a plane that falls eastwards. */
const GRID = [
  "ncols 12\nnrows 12\nxllcorner 0\nyllcorner 0\ncellsize 1",
  ...Array.from({ length: 12 }, () =>
    Array.from({ length: 12 }, (_, column) => (6 - 0.4 * column).toFixed(3)).join(" "),
  ),
].join("\n");

/** A scene on the map of this name. */
const sceneOn = (map: string) => ({
  title: "Plane",
  terrain: { height_map: map, coordinates: "local" },
  flow: {
    releases: [
      {
        polygon_m: [
          [2, 4],
          [5, 4],
          [5, 8],
          [2, 8],
        ],
        thickness_m: 0.5,
      },
    ],
  },
  bodies: [{ shape: { cube: { side_m: 0.8 } }, position: { east_m: 6.5, north_m: 6 } }],
  duration_s: 1,
  numerics: { cell_size_m: 0.35 },
});

async function upload(service: Service): Promise<string> {
  const headers = { "Content-Type": "text/plain" };
  const answer = await fetch(`${service.url}/v1/terrains`, { method: "POST", headers, body: GRID });
  return ((await answer.json()) as { hash: string }).hash;
}

let map = "";
let job = "";
test.beforeAll(async ({ service }) => {
  map = await upload(service);
  job = await service.run(sceneOn(map));
});

test("a job on a terrain says what happened in words of a terrain", async ({ page }) => {
  await page.goto(`/#/jobs/${job}`);
  await expect(page.getByText(/front of the flow came [\d.]+ m from the middle of its release/)).toBeVisible();
  await expect(page.getByRole("rowheader", { name: "Final position, east" })).toBeVisible();
  await expect(page.getByText("Positions are local")).toBeVisible();
  await expect(page.getByRole("row", { name: /^Points that left/ })).toContainText("over the edge of the map");
  await expect(page.locator("article")).not.toContainText(/incline|downstream|open end/);
});

test("maps and tracks are among the files", async ({ page, service }) => {
  await page.goto(`/#/jobs/${job}`);
  for (const [file, path] of [
    ["deposit.tif", "maps/deposit.tif"],
    ["arrival_time.asc", "maps/arrival_time.asc"],
    ["tracks-map.geojson", "tracks.geojson?coordinates=map"],
  ] as const) {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: file }).click(),
    ]);
    const expected = Buffer.from(await (await fetch(`${service.url}/v1/jobs/${job}/${path}`)).arrayBuffer());
    expect(expected.equals(await readFile(await download.path())), file).toBe(true);
  }
  // The map names no coordinate reference system.
  await page.getByRole("button", { name: "tracks.geojson" }).click();
  await expect(page.getByText(/coordinate reference system/).first()).toBeVisible();
});

test("the replay shows a terrain in three dimensions and from above", async ({ page }) => {
  await page.goto(`/#/jobs/${job}`);
  const scene = page.getByRole("img", { name: /three dimensions/ });
  await expect.poll(() => scene.getAttribute("data-frames")).not.toBeNull();
  for (const camera of ["Side", "Above", "Along", "Oblique"])
    await page.getByRole("button", { name: camera, exact: true }).click();
  await expect(page.getByText("The terrain itself is not drawn.")).toBeVisible();
  await page.getByRole("button", { name: "From above" }).click();
  await expect(page.getByRole("img", { name: /from above, east to the right and north up/ })).toBeVisible();
  await expect.poll(() => shareOfFlow(page)).toBeGreaterThan(0.1);
});

/** Share of the picture from above that the flow takes, which is dark violet at the start. */
async function shareOfFlow(page: Page): Promise<number> {
  return page.locator(".aerial canvas").evaluate((canvas: HTMLCanvasElement) => {
    const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
    let flow = 0;
    for (let at = 0; at < data.length; at += 4) {
      if (data[at]! < 90 && data[at + 1]! < 40 && data[at + 2]! > 60) flow += 1;
    }
    return flow / (data.length / 4);
  });
}

test("jobs on terrains are compared, with each other and with one in a channel", async ({ page, service }) => {
  const other = await service.run({ ...sceneOn(map), title: "Shorter", duration_s: 0.5 });
  await page.goto(`/#/compare/${job}/${other}`);
  await expect(page.getByRole("region", { name: "Comparison: Flow" })).toContainText("from the middle of the release");
  await expect(page.locator(".aerial canvas")).toHaveCount(2);
  await expectAccessible(page);
  const channel = await service.run({ ...QUICK, duration_s: 0.1 });
  await page.goto(`/#/compare/${channel}/${job}`);
  await expect(page.getByText("One job is in a channel, the other on a terrain")).toBeVisible();
  await expect(page.locator(".aerial canvas")).toHaveCount(2);
  await page.goto("/#/");
  await expect(page.getByRole("link", { name: "Plane", exact: true })).toBeVisible();
});

test("the form edits a scenario on a terrain, and only its fields", async ({ page }) => {
  await page.goto(`/#/new?job=${job}`);
  await expect(page.getByText("A terrain is not drawn here.")).toBeVisible();
  await expect(page.getByLabel("Height map", { exact: false }).first()).toHaveValue(map);
  await expect(page.getByLabel(/^(Volume|Downstream|Lateral|Inclination)/)).toHaveCount(0);
  await page.getByLabel(/^Polygon/).fill("[[2, 4], [5, 4], [5, 7]]");
  await page.getByLabel(/^East/).fill("7");
  await page.getByRole("button", { name: "Duplicate Body 0" }).click();
  const document = await documentOf(page);
  expect(document["flow"].releases[0].polygon_m).toEqual([
    [2, 4],
    [5, 4],
    [5, 7],
  ]);
  const east = document["bodies"].map(({ position }: { position: { east_m: number } }) => position.east_m);
  expect(east[0]).toBe(7);
  expect(east[1]).toBeGreaterThan(7.8);
  await expect(plan(page).getByText(/material points in cells of 350 mm/)).toBeVisible();
  await page.getByRole("button", { name: "Run it" }).click();
  await expect(page).toHaveURL(/#\/jobs\//);
});

test("the ground is chosen, never both at once, and comes back as it was", async ({ page }) => {
  await page.goto("/#/new?preset=source_paper");
  const before = await documentOf(page);
  await page.getByRole("button", { name: "Terrain", exact: true }).click();
  const onTerrain = await documentOf(page);
  expect(onTerrain["channel"]).toBeUndefined();
  expect(onTerrain["flow"]).not.toHaveProperty("volume_m3");
  expect(onTerrain["terrain"]).toEqual({});
  await page.getByLabel(/^Height map/).selectOption(map);
  await page.getByRole("checkbox", { name: "There is a flow" }).uncheck();
  await page.getByRole("checkbox", { name: "There is a flow" }).check();
  expect((await documentOf(page))["flow"].releases).toEqual([{}]);
  await page.getByRole("button", { name: "Channel", exact: true }).click();
  expect(await documentOf(page)).toEqual(before);
  await page.getByRole("button", { name: "Terrain", exact: true }).click();
  expect((await documentOf(page))["terrain"]).toEqual({ height_map: map });
});

test("a map is uploaded in the form, or refused with its reason", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByRole("button", { name: "Terrain", exact: true }).click();
  const file = page.getByLabel(/^File of the height map/);
  const send = (text: string) =>
    file.setInputFiles({ name: "map.asc", mimeType: "text/plain", buffer: Buffer.from(text) });
  await send("no grid");
  await expect(page.getByRole("alert")).toBeVisible();
  await send(GRID.replaceAll("6.000", "6.100"));
  await expect(page.getByRole("alert")).toHaveCount(0);
  await expect(page.getByLabel(/^Height map/)).not.toHaveValue("");
  expect((await documentOf(page))["terrain"].height_map).toMatch(/^[0-9a-f]{64}$/);
});

test("a form whose list of maps cannot be read keeps the map of its scenario", async ({ page }) => {
  await page.route("**/v1/terrains?limit=100", (route) => route.fulfill({ status: 500, body: "{}" }));
  await page.goto(`/#/new?job=${job}`);
  await expect(page.getByText("The list of stored maps could not be read.").first()).toBeVisible();
  await expect(page.getByLabel(/^Height map/)).toHaveValue(map);
});

for (const colorScheme of ["light", "dark"] as const) {
  test(`views of a terrain are accessible in the ${colorScheme} theme and fit a narrow window`, async ({ page }) => {
    await page.emulateMedia({ colorScheme });
    for (const [path, sign] of [
      [`/#/jobs/${job}`, "May I trust it?"],
      [`/#/new?job=${job}`, "What the run will take"],
    ] as const) {
      await page.setViewportSize({ width: 1280, height: 800 });
      await page.goto(path);
      await expect(page.getByRole("heading", { name: sign })).toBeVisible();
      await expectAccessible(page);
      await page.setViewportSize({ width: 360, height: 740 });
      await expect(() => expectNoSidewaysScroll(page)).toPass();
    }
  });
}

test("the map of a study has the axes of a terrain", async ({ page, service }) => {
  const body = { ...sceneOn(map).bodies[0], friction: 0.9 };
  const study = await finished(service, {
    title: "Plane",
    scenario: { ...sceneOn(map), flow: null, bodies: [body], duration_s: 0.3 },
    inputs: [{ pointer: "/bodies/0/position/north_m", distribution: { uniform: { from: 4, to: 8 } } }],
    design: { sobol: { members: 8, seed: 1 } },
    questions: [{ rest: { body: 0, regions: [0.5] } }],
  });
  await page.goto(`/#/studies/${study}`);
  const picture = page.getByRole("group", { name: /^Map of where body 0/ });
  await expect(picture).toContainText("x east [m]");
  await expect(picture.locator(".ground .start")).toHaveCount(1);
  await expect(picture.locator(".wall")).toHaveCount(0);
});

test("a document keeps what both grounds have, and what was there before", async () => {
  const { schemas } = (JSON.parse(await readFile("../api/openapi.json", "utf8")) as Contract).components;
  const channel = {
    channel: { inclination_deg: 30 },
    flow: { volume_m3: 1, material: { static_friction: 0.5 } },
    bodies: [{ shape: { cube: { side_m: 1 } }, position: { downstream_m: 2 } }],
  };
  const terrain = onGround(channel, "terrain", undefined, schemas);
  expect(terrain).toEqual({
    terrain: {},
    flow: { material: { static_friction: 0.5 }, releases: [{}] },
    bodies: [{ shape: { cube: { side_m: 1 } } }],
  });
  expect(onGround(terrain, "channel", channel, schemas)).toEqual(channel);
  expect(onGround({ ...channel, flow: null, bodies: [] }, "terrain", terrain, schemas)).toEqual({
    terrain: {},
    flow: null,
    bodies: [],
  });
  const both = { ...channel, ...terrain };
  expect(hasOther(both, "terrain")).toBe(true);
  expect(withoutOther(both, "terrain", schemas)).toEqual(terrain);
  const own = schemasOn("terrain", schemas);
  expect(Object.keys(own["Position"]?.properties ?? {}).sort()).toEqual(["east_m", "elevation_m", "north_m"]);
  expect(own["Flow"]?.required).toContain("releases");
});

test("a flow that has left the map has no front, but an outflow", () => {
  const flow = { front_m: null, runout_m: null, outflow_mass_kg: 20, excluded_volume_m3: 0, error_bars: null };
  const scenario = { ...sceneOn(""), bodies: [] };
  const gone = { outcome: { flow, bodies: [] }, scenario } as unknown as Parameters<typeof sentencesOf>[0];
  expect(sentencesOf(gone)).toEqual(["20 kg of the flow left the map, so that its front is not known."]);
  const outcome = gone.outcome!;
  expect(flowQuantities(outcome, "terrain").map(({ key }) => key)).toEqual(["outflow_mass_kg", "excluded_volume_m3"]);
});

test("a region on a terrain holds flow and bodies, and is never empty", () => {
  const scenario = sceneOn("") as unknown as Parameters<typeof regionOf>[0];
  const frame = { origin: [100, 50, 3], extent: [10, 5, 2], kept: 1 } as unknown as Parameters<typeof regionOf>[2][0];
  expect(regionOf(scenario, [], [frame])).toEqual({ low: [99.6, 49.6, 3], high: [110.4, 55.4, 5] });
  const { low, high } = regionOf(scenario, [], []);
  for (const axis of [0, 1, 2] as const) expect(high[axis]).toBeGreaterThan(low[axis]);
});

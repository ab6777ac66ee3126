/**
 * Pictures of every view for the documents: `PICTURES=../docs/pictures/page npm test -- document-pictures`, with the
 * binary of a release build.
 */

import type { Page } from "@playwright/test";
import { readFile } from "node:fs/promises";
import { QUICK, SLOW, type Service, expect, scenario, test } from "./service";

const FOLDER = process.env["PICTURES"];
const WIDE = { width: 1280, height: 1600 };
const NARROW = { width: 360, height: 1200 };

/** Views by the names of their pictures: where they are, and when they are there. */
interface View {
  name: string;
  address: string;
  isThere: (page: Page) => Promise<unknown>;
}

test.skip(FOLDER === undefined, "made on demand");
test.setTimeout(600_000);

test("pictures of every view", async ({ page, service }) => {
  const shown = await views(service);
  for (const view of shown) {
    // Last, since they take all that the machine has.
    if (view.name === "jobs") for (const title of ["Slow", "Waits"]) await service.submit({ ...SLOW, title });
    for (const colorScheme of ["light", "dark"] as const) {
      for (const [width, viewport] of [
        ["wide", WIDE],
        ["narrow", NARROW],
      ] as const) {
        await page.emulateMedia({ colorScheme });
        await page.setViewportSize(viewport);
        await page.goto("about:blank");
        await page.goto(view.address);
        await view.isThere(page);
        const path = `${FOLDER}/${view.name}-${colorScheme}-${width}.jpg`;
        await page.screenshot({ path, type: "jpeg", quality: 70 });
      }
    }
  }
});

/** The views of a service on which some jobs and a study were computed. */
async function views(service: Service): Promise<View[]> {
  const study = JSON.parse(await readFile("../configs/studies/source_paper.json", "utf8")) as { design: unknown };
  study.design = { sobol: { members: 64, seed: 1 } };
  const studyId = (await service.post<{ id: string }>("/v1/studies", study)).id;
  const status = () => service.get<{ status: string }>(`/v1/studies/${studyId}`);
  await expect.poll(async () => (await status()).status, { timeout: 400_000, intervals: [1_000] }).toBe("successful");
  const paper = await service.run({ ...(await scenario("source_paper")), flow_snapshots: 61 });
  const other = await service.run({ ...(await scenario("minimal")), title: "The smallest scenario" });
  const deep = await service.run(await scenario("cube_in_thin_flow"));
  const cubes = await service.run(await scenario("ten_cubes"));
  await service.post("/v1/jobs?label=barrier", QUICK);
  const seen = (text: string | RegExp) => (page: Page) =>
    expect(page.getByText(text).filter({ visible: true }).first()).toBeVisible();
  const drawn = async (page: Page) => {
    await expect(page.locator("canvas").first()).toBeVisible();
    await page.waitForTimeout(3_000);
  };
  return [
    { name: "form", address: "/#/new?preset=source_paper", isThere: seen(/of computing/) },
    { name: "job", address: `/#/jobs/${paper}`, isThere: drawn },
    { name: "job-ten-cubes", address: `/#/jobs/${cubes}`, isThere: drawn },
    { name: "compare", address: `/#/compare/${deep}/${other}`, isThere: drawn },
    { name: "studies", address: "/#/studies", isThere: seen(/cube of the source paper/) },
    { name: "study", address: `/#/studies/${studyId}`, isThere: drawn },
    {
      name: "reference",
      address: "/docs",
      isThere: (page) => expect(page.getByRole("heading", { name: "To begin with" })).toBeVisible(),
    },
    { name: "jobs", address: "/", isThere: seen("The smallest scenario") },
  ];
}

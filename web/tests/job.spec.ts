import type { Page } from "@playwright/test";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { QUICK, SLOW, Service, expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";

/** A scenario with so many small cubes in rows across the channel. */
function withCubes(count: number) {
  const bodies = Array.from({ length: count }, (_, k) => ({
    shape: { cube: { side_m: 0.01 } },
    position: { downstream_m: 0.05 + 0.02 * Math.floor(k / 8), lateral_m: -0.042 + 0.012 * (k % 8) },
  }));
  const channel = { ...QUICK.channel, runout_length_m: 0.9 };
  return { ...QUICK, title: "Many", channel, bodies, numerics: { cell_size_m: 0.02 }, duration_s: 0.1 };
}

async function open(page: Page, id: string, title: string) {
  await page.goto(`/#/jobs/${id}`);
  await expect(page.getByRole("heading", { level: 1 })).toContainText(title);
}

test.describe("a successful job", () => {
  let id = "";
  test.beforeAll(async ({ service }) => {
    id = await service.run({ ...QUICK, accuracy: { error_bars: true } });
  });

  for (const colorScheme of ["light", "dark"] as const) {
    test(`is accessible in the ${colorScheme} theme`, async ({ page }) => {
      await page.emulateMedia({ colorScheme });
      await open(page, id, "Quick");
      await expect(page.getByRole("heading", { name: "What happened" })).toBeVisible();
      await expect(page.getByText(/stored at \d+ instants/)).toBeVisible();
      await expect(page.getByRole("region", { name: "Values at the time of the replay" })).toBeVisible();
      await expectAccessible(page);
    });
  }

  test("tells what happened, with intervals and a verdict", async ({ page, service }) => {
    await open(page, id, "Quick");
    const { outcome } = await service.get<{
      outcome: { bodies: { displacement_m: number; error_bars: { displacement_m: { low: number } } }[] };
    }>(`/v1/jobs/${id}`);
    await expect(page.getByText(/^Body 0 began to move at .* submerged\.$/)).toBeVisible();
    const row = page.getByRole("region", { name: "Quantities: Body 0" }).getByRole("row", { name: /^Displacement/ });
    await expect(row).toContainText(String(Number(outcome.bodies[0]?.displacement_m.toPrecision(4))));
    await expect(row).toContainText(`${Number(outcome.bodies[0]?.error_bars.displacement_m.low.toPrecision(4))} to`);
    await expect(page.getByText(/^Yes, as far as the audit tells/)).toBeVisible();
    await expect(page.getByRole("row", { name: /^Mass balance/ })).toContainText("fine");
    await expect(page.getByText("Fingerprint of the records")).toBeVisible();
  });

  test("shows the values of a time that the slider or a click sets", async ({ page }) => {
    await open(page, id, "Quick");
    const table = page.getByRole("region", { name: "Values at the time of the replay" });
    await expect(table).toContainText("At 0.000 s");
    await page.getByRole("slider", { name: "Simulated time" }).fill("0.3");
    await expect(table).toContainText(/At 0\.(299|300|301) s/);
    const plot = page.locator(".plot .u-over").first();
    await plot.click({ position: { x: 200, y: 50 } });
    await expect(table).not.toContainText(/At 0\.(299|300|301) s/);
    const line = page.locator(".clock-line").nth(1);
    expect((await line.boundingBox())?.x).toBeCloseTo(
      ((await page.locator(".plot .u-over").nth(1).boundingBox())?.x ?? 0) + 199,
      -1,
    );
  });

  test("zooms all plots by dragging in one, and goes back", async ({ page }) => {
    await open(page, id, "Quick");
    await expect(page.getByRole("region", { name: "Values at the time of the replay" })).toBeVisible();
    await expect(page.getByText(/stored at \d+ instants/)).toBeVisible();
    const zoomed = page.getByText(/^0\.\d{3} s to 0\.\d{3} s$/);
    // A plot is made again when more comes, and then loses a drag that has begun.
    await expect(async () => {
      const plot = page.locator(".plot .u-over").nth(1);
      await plot.evaluate((element) => element.scrollIntoView({ block: "center" }));
      const box = await plot.boundingBox();
      if (!box) throw new Error("no plot");
      await page.mouse.move(box.x + 100, box.y + 60);
      await page.mouse.down();
      await page.mouse.move(box.x + 200, box.y + 60, { steps: 4 });
      await page.mouse.up();
      await expect(zoomed).toBeVisible({ timeout: 1_000 });
    }).toPass();
    await page.getByRole("button", { name: "Whole run" }).click();
    await expect(page.getByText(/^Drag across a plot/)).toBeVisible();
    await page.getByRole("button", { name: "Zoom in" }).focus();
    await page.keyboard.press("Enter");
    await expect(zoomed).toBeVisible();
  });

  test("hands out its files, as the service has them", async ({ page, service }) => {
    await open(page, id, "Quick");
    for (const [file, path] of [
      ["flow.bin", "flow.bin"],
      ["trajectory-0.csv", "trajectory.csv?body=0"],
      ["aerial.svg", "aerial.svg"],
    ] as const) {
      const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.getByRole("button", { name: file }).click(),
      ]);
      expect(download.suggestedFilename()).toBe(file);
      const expected = Buffer.from(await (await fetch(`${service.url}/v1/jobs/${id}/${path}`)).arrayBuffer());
      expect(expected.equals(await readFile(await download.path()))).toBe(true);
    }
    const [scenario] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "scenario.json" }).click(),
    ]);
    expect(JSON.parse((await readFile(await scenario.path())).toString())).toMatchObject({ title: "Quick" });
  });

  test("is made again by the copied lines", async ({ page, context, service }) => {
    await context.grantPermissions(["clipboard-read", "clipboard-write"]);
    await open(page, id, "Quick");
    await page.getByRole("button", { name: "Copy the lines for curl" }).click();
    await expect(page.getByText("Copied", { exact: true })).toBeVisible();
    const lines = await page.evaluate(() => navigator.clipboard.readText());
    expect(lines).toContain(`${service.url}/v1/jobs`);
    const body = /--data-binary '(.*)'$/s.exec(lines)?.[1] ?? "";
    expect((await service.post<{ status: string }>("/v1/jobs", JSON.parse(body))).status).toMatch(/accepted|running/);
  });

  test("fits a narrow window", async ({ page }) => {
    await page.setViewportSize({ width: 360, height: 740 });
    await open(page, id, "Quick");
    await expect(page.getByText(/stored at \d+ instants/)).toBeVisible();
    await expectNoSidewaysScroll(page);
    await page.getByRole("button", { name: "From above" }).click();
    await expectNoSidewaysScroll(page);
  });
});

test("a running job shows its progress as it comes, and can be dismissed and removed", async ({ page, service }) => {
  const id = await service.submit(SLOW);
  await open(page, id, "Slow");
  const progress = page.locator(".job-progress p").first();
  await expect(progress).toContainText("point-steps/s");
  const before = await progress.textContent();
  await expect(progress).not.toHaveText(before ?? "");
  await expect(page.getByText(/so far, up to/)).toBeVisible();
  await expectAccessible(page);
  await page.getByRole("button", { name: "Dismiss" }).click();
  await page.getByRole("button", { name: "Really stop it?" }).click();
  await expect(page.getByText(/without an outcome; what it had recorded/)).toBeVisible();
  await expect(page.locator("h1")).toContainText("dismissed");
  await page.getByRole("button", { name: "Remove …" }).click();
  await page.getByRole("button", { name: "Keep it" }).click();
  await page.getByRole("button", { name: "Remove …" }).click();
  await page.getByRole("button", { name: "Remove it" }).click();
  await expect(page).toHaveURL(/#\/$/);
  expect((await fetch(`${service.url}/v1/jobs/${id}`)).status).toBe(404);
});

test("a job removed elsewhere says so", async ({ page, service }) => {
  const id = await service.run({ ...QUICK, title: "Short-lived", duration_s: 0.05 });
  await open(page, id, "Short-lived");
  await expect(page.getByRole("heading", { name: "What happened" })).toBeVisible();
  await fetch(`${service.url}/v1/jobs/${id}?remove=ended`, { method: "DELETE" });
  await expect(page.getByRole("heading", { name: "This job has been removed" })).toBeVisible();
});

test("an unknown job is a problem in words", async ({ page }) => {
  await page.goto("/#/jobs/01890000-0000-7000-8000-000000000000");
  await expect(page.getByRole("alert")).toBeVisible();
  await expect(page.getByRole("heading", { level: 1, name: "Job" })).toBeVisible();
  await page.getByRole("link", { name: "All jobs" }).click();
  await expect(page.getByRole("heading", { level: 1, name: "Jobs" })).toBeVisible();
});

test("a failed job tells why and what to do", async ({ page }) => {
  const folder = await mkdtemp(join(tmpdir(), "scree-limits-"));
  const config = join(folder, "service.toml");
  await writeFile(config, "[limits]\njob_wall_time_s = 1\n");
  const service = await Service.start(["--config", config]);
  try {
    const id = await service.submit(SLOW);
    await service.get(`/v1/jobs/${id}?wait=30s`);
    await page.goto(`${service.url}/#/jobs/${id}`);
    await expect(page.getByRole("heading", { name: "Too much wall time" })).toBeVisible();
    await expect(page.getByText(/Larger cells, a shorter duration/)).toBeVisible();
    await expectAccessible(page);
  } finally {
    await service.stop();
    await rm(folder, { recursive: true });
  }
});

test("a job without flow has no scale of speed, one without bodies no curves", async ({ page, service }) => {
  const noFlow = await service.run({ ...QUICK, title: "No flow", flow: null, duration_s: 0.2 });
  await open(page, noFlow, "No flow");
  await expect(page.getByText("This scenario has no flow.")).toBeVisible();
  await expect(page.getByText("speed of the flow")).toHaveCount(0);
  const noBodies = await service.run({ ...QUICK, title: "No bodies", bodies: [], duration_s: 0.2 });
  await open(page, noBodies, "No bodies");
  await expect(page.getByRole("region", { name: "Quantities: Flow" })).toBeVisible();
  await expect(page.getByRole("heading", { name: "Against time" })).toHaveCount(0);
  await expectAccessible(page);
});

test("hundreds of bodies are shown, six of them as curves at first", async ({ page, service }) => {
  const id = await service.run(withCubes(250));
  await open(page, id, "Many");
  const boxes = page.getByRole("group", { name: "Bodies" }).getByRole("checkbox");
  await expect(boxes).toHaveCount(250);
  await expect(page.getByRole("group", { name: "Bodies" }).getByRole("checkbox", { checked: true })).toHaveCount(6);
  await expect(page.getByText("242 more bodies are in the table below.")).toBeVisible();
  await boxes.nth(200).check();
  await expect(
    page.getByRole("region", { name: "Values at the time of the replay" }).getByRole("rowheader", { name: "200" }),
  ).toBeVisible();
  await expect(page.getByRole("region", { name: /^Quantities: Body/ })).toHaveCount(3);
  await expect(page.locator(".scene canvas")).toHaveAttribute("data-frames", /\d+/);
  await page.getByRole("button", { name: "Show all 250 bodies" }).click();
  await expect(page.getByRole("region", { name: /^Quantities: Body/ })).toHaveCount(250);
});

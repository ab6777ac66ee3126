import type { Page } from "@playwright/test";
import { readFile } from "node:fs/promises";
import { QUICK, type Service, expect, test } from "./service";

/** A scene that is computed for some seconds, so that its page sees it grow. */
const SECONDS = { ...QUICK, title: "Seconds", numerics: { cell_size_m: 0.006 } };

async function open(page: Page, id: string, title: string) {
  await page.goto(`/#/jobs/${id}`);
  await expect(page.getByRole("heading", { level: 1 })).toContainText(title);
}

/** Waits until the page of a job that has ended shows all that is stored of it. */
async function untilAllIsRead(page: Page, service: Service, id: string) {
  await expect(page.getByRole("heading", { name: "What happened" })).toBeVisible({ timeout: 40_000 });
  const head = Buffer.from(await (await fetch(`${service.url}/v1/jobs/${id}/flow.bin`)).arrayBuffer());
  await expect(page.getByText(`stored at ${head.readUInt32LE(12)} instants`)).toBeVisible();
  const trajectory = await service.get<{ columns: { time_s: number[] } }>(`/v1/jobs/${id}/trajectory`);
  await expect(page.getByRole("slider", { name: "Simulated time" })).toHaveAttribute(
    "max",
    String(trajectory.columns.time_s.at(-1)),
  );
}

test("a flow without material points is no error", async ({ page, service }) => {
  const id = await service.run({ ...QUICK, title: "Empty flow", flow: { volume_m3: 0 }, duration_s: 0.1 });
  await open(page, id, "Empty flow");
  await expect(page.getByText("The flow has no material points.")).toBeVisible();
  await expect(page.locator(".scene canvas")).toHaveAttribute("data-frames", /\d+/);
  await page.getByRole("button", { name: "From above" }).click();
  await expect(page.getByRole("img", { name: /from above/ })).toBeVisible();
});

test("a flow stored once is not said to be interpolated", async ({ page, service }) => {
  const id = await service.run({ ...QUICK, title: "Once", flow_snapshots: 1, duration_s: 0.1 });
  await open(page, id, "Once");
  await expect(page.getByText("The flow is stored at one instant, 0 s.")).toBeVisible();
});

test("the page of a running job reads what is new, and in the end has all", async ({ page, service }) => {
  const asked: URL[] = [];
  page.on("request", (request) => asked.push(new URL(request.url())));
  const id = await service.submit(SECONDS);
  await open(page, id, "Seconds");
  await untilAllIsRead(page, service, id);
  for (const name of ["flow.bin", "trajectory"]) {
    const requests = asked.filter(({ pathname }) => pathname.endsWith(`/${name}`));
    const last = Number(requests.at(-1)?.searchParams.get("from_s"));
    expect(last, name).toBeGreaterThan(0.3);
    const fields = new Set(requests.map(({ searchParams }) => searchParams.get("fields")));
    const whole = requests.filter(({ searchParams }) => !searchParams.has("from_s"));
    // The first ones may have come too early to bring anything.
    expect(whole.length, name).toBeLessThanOrEqual(2 * fields.size);
  }
});

test("the last sample is shown, also if not all samples are read", async ({ page, service }) => {
  const id = await service.run({ ...QUICK, title: "Fine", sample_interval_s: 1e-4, duration_s: 0.55 });
  await open(page, id, "Fine");
  const { columns } = await service.get<{ columns: { time_s: number[]; submerged_fraction: number[] } }>(
    `/v1/jobs/${id}/trajectory?fields=time_s,submerged_fraction`,
  );
  await expect(page.getByRole("region", { name: "Values at the time of the replay" })).toBeVisible();
  const slider = page.getByRole("slider", { name: "Simulated time" });
  await expect(slider).toHaveAttribute("max", String(columns.time_s.at(-1)));
  const submergence = String(Number((100 * (columns.submerged_fraction.at(-1) ?? NaN)).toPrecision(3)));
  await slider.focus();
  await page.keyboard.press("End");
  const cells = page.getByRole("region", { name: "Values at the time of the replay" }).getByRole("cell");
  await expect(cells.nth(2)).toHaveText(submergence);
});

test("a drag that zooms outlasts new samples", async ({ page, service }) => {
  await open(page, await service.submit(SECONDS), "Seconds");
  const plot = page.locator(".plot .u-over").nth(1);
  await expect(page.getByText(/stored at \d+ instants/)).toBeVisible();
  await plot.evaluate((element) => element.scrollIntoView({ block: "center" }));
  const box = await plot.boundingBox();
  if (!box) throw new Error("no plot");
  await page.mouse.move(box.x + 60, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 120, box.y + 60, { steps: 4 });
  await expect(page.getByRole("heading", { name: "What happened" })).toBeVisible({ timeout: 40_000 });
  // The sentences above have moved the plot.
  const moved = await plot.boundingBox();
  await page.mouse.move(box.x + 160, (moved?.y ?? 0) + 60, { steps: 4 });
  await page.mouse.up();
  await expect(page.getByText(/^0\.\d{3} s to 0\.\d{3} s$/)).toBeVisible();
});

test("the picture of a running job keeps all that happens in view, and its time is not read out", async ({
  page,
  service,
}) => {
  const id = await service.submit(SECONDS);
  await open(page, id, "Seconds");
  await expect(page.getByText(/stored at \d+ instants/)).toBeVisible();
  await expect(page.locator("[aria-live]:has(.time), [role=status]:has(.time), output.time")).toHaveCount(0);
  await untilAllIsRead(page, service, id);
  const picture = async () => {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "Save picture" }).click(),
    ]);
    return (await readFile(await download.path())).toString("base64");
  };
  const followed = await picture();
  await page.getByRole("button", { name: "Oblique" }).click();
  expect((await picture()) === followed).toBe(true);
  await page.getByRole("button", { name: "Above", exact: true }).click();
  expect((await picture()) === followed).toBe(false);
});

/**
 * Figures of docs/page.md: `MEASURE=1 npm test -- measured`, on a machine that does nothing else, with the binary
 * of a release build.
 */

import type { Browser } from "@playwright/test";
import { encoded, sliding } from "./job-frames";
import { QUICK, Service, expect, test } from "./service";

test.skip(process.env["MEASURE"] === undefined, "measured on demand");
test.setTimeout(600_000);

/** Jobs that are computed while pages are open. */
const JOBS = 300;

/** A job of some milliseconds: the service's own work counts. */
const SMALL = { ...QUICK, flow: null, duration_s: 0.05 };

test("cost of open pages for the service", async ({ browser }) => {
  for (const pages of [0, 1, 10, 0, 1, 10]) {
    const { seconds, requests } = await costOf(browser, pages);
    console.log(`${pages} pages: ${seconds.toFixed(2)} s of processor time and ${requests} requests for ${JOBS} jobs`);
  }
});

/** Processor time and requests of a service while it computes jobs, with so many pages open. */
async function costOf(browser: Browser, pages: number) {
  const service = await Service.start();
  try {
    const context = await browser.newContext({ baseURL: service.url });
    for (let opened = 0; opened < pages; opened += 1) {
      const page = await context.newPage();
      await page.goto("/");
      await expect(page.getByRole("heading", { name: "Jobs" })).toBeVisible();
    }
    const before = [await service.processorTime(), await service.requests()] as const;
    const jobs = Array.from({ length: 100 }, () => ({ scenario: SMALL }));
    for (let sent = 0; sent < JOBS; sent += jobs.length) await service.post("/v1/batches", { jobs });
    const waiting = () => service.get<{ jobs: unknown[] }>("/v1/jobs?status=accepted&status=running&limit=1");
    await expect.poll(async () => (await waiting()).jobs.length, { timeout: 120_000, intervals: [1_000] }).toBe(0);
    const result = {
      seconds: (await service.processorTime()) - before[0],
      requests: (await service.requests()) - before[1],
    };
    await context.close();
    return result;
  } finally {
    await service.stop();
  }
}

test("pictures a second of the flow in three dimensions", async ({ page, service }) => {
  const id = await service.run(QUICK);
  for (const points of [1_000, 5_000, 20_000]) {
    const body = encoded(sliding(points, 61, 0.6));
    await page.route("**/flow.bin*", (route) => route.fulfill({ body, contentType: "application/vnd.scree.flow" }));
    await page.goto("about:blank");
    await page.goto(`/#/jobs/${id}`);
    const canvas = page.locator(".scene canvas");
    const frames = async () => Number(await canvas.getAttribute("data-frames"));
    await expect(canvas).toHaveAttribute("data-frames", /\d+/);
    await page.getByRole("combobox", { name: "Speed" }).selectOption("0.1");
    await page.getByRole("checkbox", { name: "Loop" }).check();
    await page.getByRole("button", { name: "Play" }).click();
    await page.waitForTimeout(3_000);
    const start = await frames();
    await page.waitForTimeout(10_000);
    const rate = ((await frames()) - start) / 10;
    const size = await canvas.evaluate((drawn: HTMLCanvasElement) => `${drawn.width} × ${drawn.height} pixels`);
    console.log(`${points} points: ${rate.toFixed(1)} pictures a second, ${size}`);
    await page.unroute("**/flow.bin*");
  }
});

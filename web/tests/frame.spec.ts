import { type Browser, type Page } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { writeFile } from "node:fs/promises";
import { BINARY, QUICK, Service, expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";

/** Largest size of the first view [bytes], and the time in which it must be there [ms]. */
const LARGEST_BYTES = 1_500_000;
const LONGEST_MS = 1_000;

test("the first view is small and soon there", async ({ page }) => {
  const client = await page.context().newCDPSession(page);
  await client.send("Network.enable");
  let bytes = 0;
  client.on("Network.loadingFinished", (finished) => (bytes += finished.encodedDataLength));
  await page.goto("/");
  await expect(page.locator(".jobs, .card").first()).toBeVisible();
  const painted = await page.waitForFunction(
    () => performance.getEntriesByName("first-contentful-paint")[0]?.startTime,
  );
  const shown = (await painted.jsonValue()) ?? NaN;
  const listed = await page.evaluate(() =>
    Math.max(...performance.getEntriesByType("resource").map((one) => (one as PerformanceResourceTiming).responseEnd)),
  );
  console.log(`first view: ${shown.toFixed(0)} ms, last answer after ${listed.toFixed(0)} ms, ${bytes} bytes`);
  expect(bytes).toBeGreaterThan(1_000);
  expect(bytes).toBeLessThan(LARGEST_BYTES);
  expect(Math.max(shown, listed)).toBeLessThan(LONGEST_MS);
});

test("all views are reached by the keyboard", async ({ page }) => {
  await page.goto("/");
  await page.keyboard.press("Tab");
  await expect(page.getByText("Skip to the content")).toBeFocused();
  await page.keyboard.press("Enter");
  await expect(page.locator("#main")).toBeFocused();
  for (const [link, address] of [
    ["New scenario", "#/new"],
    ["Studies", "#/studies"],
    ["Jobs", "#/"],
  ] as const) {
    await page.getByRole("navigation").getByRole("link", { name: link }).press("Enter");
    await expect(page).toHaveURL(new RegExp(`${address}$`));
    await expect(page.locator("#main")).toBeFocused();
  }
});

test("an address without a view says so", async ({ page }) => {
  await page.goto("/#/nowhere");
  await expect(page.getByRole("heading", { name: "There is no such view" })).toBeVisible();
  await page.setViewportSize({ width: 360, height: 740 });
  await expectNoSidewaysScroll(page);
});

test("a service with tokens is used with one, which is kept in the tab alone", async ({ browser }, info) => {
  const config = info.outputPath("service.toml");
  const section = execFileSync(BINARY, ["token", "page", "--scope", "submit", "--scope", "read"], { encoding: "utf8" });
  await writeFile(config, section);
  const token = /scree_[0-9a-f]+/.exec(section)?.[0] ?? "";
  const service = await Service.start(["--config", config]);
  try {
    const context = await browser.newContext({ baseURL: service.url });
    const page = await context.newPage();
    await page.goto("/");
    const dialog = page.getByRole("dialog");
    await dialog.getByLabel("Access token").fill("wrong");
    await dialog.getByRole("button", { name: "Use it" }).click();
    await expect(dialog.getByText("The token was not accepted.")).toBeVisible();
    await expectAccessible(page);
    await dialog.getByLabel("Access token").fill(token);
    await page.keyboard.press("Enter");
    await expect(page.getByText("There are no jobs yet.")).toBeVisible();
    await page.reload();
    await expect(page.getByText("There are no jobs yet.")).toBeVisible();
    expect(await page.evaluate(() => [sessionStorage.length > 0, localStorage.length, document.cookie])).toEqual([
      true,
      0,
      "",
    ]);
    await page.getByRole("button", { name: "Forget the token" }).click();
    await expect(dialog).toBeVisible();
    expect(await page.evaluate(() => sessionStorage.length)).toBe(0);
    const other = await context.newPage();
    await other.goto("/");
    await expect(other.getByRole("dialog")).toBeVisible();
    await context.close();
  } finally {
    await service.stop();
  }
});

/** Pages that each show the list of jobs. */
async function openPages(browser: Browser, service: Service, count: number): Promise<Page[]> {
  const context = await browser.newContext({ baseURL: service.url });
  const pages = [];
  for (let opened = 0; opened < count; opened += 1) {
    const page = await context.newPage();
    await page.goto("/");
    await expect(page.getByRole("heading", { name: "Jobs" })).toBeVisible();
    pages.push(page);
  }
  return pages;
}

test("ten pages share one stream of events", async ({ browser }) => {
  // A second stream would be refused.
  const service = await Service.start([], { SCREE_LIMITS__STREAMS_PER_CALLER: "1" });
  try {
    const pages = await openPages(browser, service, 10);
    const id = await service.submit(QUICK);
    for (const page of pages) {
      await page.bringToFront();
      await expect(page.locator(`[data-job="${id}"]`).getByText("successful")).toBeVisible();
    }
    await pages[0]?.context().close();
  } finally {
    await service.stop();
  }
});

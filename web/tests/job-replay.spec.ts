import type { Page } from "@playwright/test";
import { readFile } from "node:fs/promises";
import { encoded, sliding } from "./job-frames";
import { QUICK, expect, expectAccessible, test } from "./service";

let id = "";
test.beforeAll(async ({ service }) => {
  id = await service.run(QUICK);
});

/** Opens the job with synthetic frames of so many points. */
async function openWith(page: Page, points: number) {
  const body = encoded(sliding(points, 13, 0.6));
  await page.route("**/flow.bin", (route) => route.fulfill({ body, contentType: "application/vnd.scree.flow" }));
  await page.goto(`/#/jobs/${id}`);
  await expect(page.getByText(/stored at 13 instants/)).toBeVisible();
  await page.getByRole("heading", { name: "Replay" }).evaluate((heading) => heading.scrollIntoView());
  await expect(scene(page)).toHaveAttribute("data-frames", /\d+/);
}

const scene = (page: Page) => page.locator(".scene canvas");
const frames = async (page: Page) => Number(await scene(page).getAttribute("data-frames"));

/** Mean differences of two pictures' bytes tell nothing, but whether they are equal does. */
const picture = (page: Page) => scene(page).screenshot();

test("the scene plays, and is drawn only when something changes", async ({ page }) => {
  await openWith(page, 20_000);
  await page.getByRole("combobox", { name: "Speed" }).selectOption("0.1");
  const before = await picture(page);
  await page.getByRole("button", { name: "Play" }).click();
  const start = await frames(page);
  const seconds = 3;
  await page.waitForTimeout(1000 * seconds);
  const rate = ((await frames(page)) - start) / seconds;
  console.log(`20,000 points at 1280×800: ${rate.toFixed(1)} pictures a second`);
  expect(rate).toBeGreaterThan(3);
  await page.getByRole("button", { name: "Pause" }).click();
  expect(before.equals(await picture(page))).toBe(false);
  await page.waitForTimeout(500);
  const still = await frames(page);
  await page.waitForTimeout(1000);
  expect(await frames(page)).toBe(still);
  await page.getByRole("checkbox", { name: "Frame rate" }).check();
  await page.getByRole("slider", { name: "Simulated time" }).fill("0.1");
  await expect(page.locator(".frame-rate")).toContainText(/\d+ \/s/);
});

test("the scene is seen from four places, turned by keys, and saved", async ({ page }) => {
  await openWith(page, 2_000);
  const seen = new Set<string>();
  for (const place of ["Side", "Above", "Along", "Oblique"]) {
    await page.getByRole("button", { name: place, exact: true }).click();
    await page.waitForTimeout(600);
    seen.add((await picture(page)).toString("base64"));
  }
  await scene(page).focus();
  for (const key of ["+", "ArrowLeft"]) {
    await page.keyboard.press(key);
    await page.waitForTimeout(600);
    seen.add((await picture(page)).toString("base64"));
  }
  expect(seen.size).toBe(6);
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save picture" }).click(),
  ]);
  const png = await readFile(await download.path());
  expect(png.subarray(1, 4).toString()).toBe("PNG");
  expect(png.length).toBeGreaterThan(5_000);
});

test("the view from above follows the clock, and is accessible", async ({ page }) => {
  await openWith(page, 2_000);
  await page.getByRole("button", { name: "From above" }).click();
  const canvas = page.locator(".aerial canvas");
  await expect(canvas).toBeVisible();
  const before = await canvas.screenshot();
  await page.getByRole("slider", { name: "Simulated time" }).fill("0.5");
  await expect.poll(async () => before.equals(await canvas.screenshot())).toBe(false);
  await expectAccessible(page);
});

test("without WebGL the view from above stands in", async ({ page }) => {
  await page.addInitScript(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
      return kind.startsWith("webgl") ? null : Reflect.apply(original, this, [kind, ...rest]);
    } as typeof original;
  });
  // The library says so on the console, which is no fault of the page.
  page.removeAllListeners("console");
  await page.goto(`/#/jobs/${id}`);
  await expect(page.getByText(/shows no 3D pictures/)).toBeVisible();
  await expect(page.locator(".aerial canvas")).toBeVisible();
});

test("frames that cannot be read are a problem in words, and the rest stays", async ({ page }) => {
  const body = encoded(sliding(500, 3, 0.6)).subarray(0, 4_000);
  await page.route("**/flow.bin", (route) => route.fulfill({ body, contentType: "application/vnd.scree.flow" }));
  await page.goto(`/#/jobs/${id}`);
  await expect(page.getByRole("alert")).toContainText("broke off after");
  await expect(page.getByRole("heading", { name: "What happened" })).toBeVisible();
});

test("leaving the view ends the scene", async ({ page }) => {
  await openWith(page, 2_000);
  await page.getByRole("checkbox", { name: "Loop" }).check();
  await page.getByRole("button", { name: "Play" }).click();
  const canvas = await scene(page).elementHandle();
  await page.getByRole("link", { name: "Studies" }).click();
  await expect(scene(page)).toHaveCount(0);
  const drawn = await canvas?.getAttribute("data-frames");
  await page.waitForTimeout(500);
  expect(await canvas?.getAttribute("data-frames")).toBe(drawn);
});

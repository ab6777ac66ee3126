import { QUICK, expect, test } from "./service";

/**
 * Pictures of the flow as computed by the service, against those in `tests/pictures`. After an intended change:
 * `npm test -- job-picture --update-snapshots`, and look at them.
 */

let id = "";
test.beforeAll(async ({ service }) => {
  id = await service.run(QUICK);
});

test.use({ contextOptions: { reducedMotion: "reduce" } });

test("flow and cube look as they should in three dimensions and from above", async ({ page }) => {
  await page.goto(`/#/jobs/${id}`);
  await expect(page.locator(".scene canvas")).toHaveAttribute("data-frames", /\d+/);
  await page.getByRole("button", { name: "Side", exact: true }).click();
  await page.getByRole("slider", { name: "Simulated time" }).fill("0.3");
  await expect(page.locator(".scene canvas")).toHaveScreenshot("side.png");
  await page.getByRole("button", { name: "From above" }).click();
  await expect(page.locator(".aerial canvas")).toHaveScreenshot("above.png");
});

test("the picture is that of its time", async ({ page }) => {
  await page.goto(`/#/jobs/${id}`);
  await expect(page.locator(".scene canvas")).toHaveAttribute("data-frames", /\d+/);
  await page.getByRole("button", { name: "Side", exact: true }).click();
  await page.getByRole("slider", { name: "Simulated time" }).fill("0.05");
  // The comparison is able to fail.
  await expect(page.locator(".scene canvas")).not.toHaveScreenshot("side.png", { timeout: 3_000 });
});

/** Bodies in the form and in its drawings. */

import { above, body, choose, documentOf, plan, side } from "./form-page";
import { expect, expectNoSidewaysScroll, scenario, test } from "./service";

test("bodies are added, copied, reshaped and removed", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByLabel("Shape").selectOption({ label: "Capsule" });
  await expect(page.getByRole("textbox", { name: "Radius", exact: false }).first()).toHaveValue("0.01");
  await expect(side(page).getByRole("button", { name: /capsule 0.04 m/ })).toBeVisible();
  await page.getByRole("button", { name: "Duplicate Body 0" }).click();
  await page.getByRole("button", { name: "Add a body" }).click();
  await expect(page.getByText("Bodies (3)")).toBeVisible();
  await expect(plan(page).getByText(/of computing/)).toBeVisible();
  await page.getByRole("button", { name: "Remove Body 0" }).click();
  const { bodies } = await documentOf(page);
  expect(bodies.map(({ shape }: { shape: object }) => Object.keys(shape)[0])).toEqual(["capsule", "cube"]);
  await page.getByRole("button", { name: "Remove Body 1" }).click();
  await page.getByRole("button", { name: "Remove Body 0" }).click();
  await expect(page.getByText("There are none yet.")).toBeVisible();
  expect((await documentOf(page))["bodies"]).toEqual([]);
});

test("a body is dragged with the mouse in both views", async ({ page }) => {
  await page.goto("/#/new");
  const cube = above(page).getByRole("button", body(0));
  const { x, y, width, height } = (await cube.boundingBox())!;
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + 60, y + height / 2 - 8, { steps: 5 });
  await page.mouse.up();
  const [moved] = (await documentOf(page))["bodies"];
  expect(moved.position.downstream_m).toBeGreaterThan(0.2);
  expect(moved.position.lateral_m).toBeGreaterThan(0.02);
  expect((moved.position.downstream_m * 1000) % 5).toBeCloseTo(0, 6);
  await expect(page.getByLabel("Downstream")).toHaveValue(String(moved.position.downstream_m));
  const inSide = (await side(page).getByRole("button", body(0)).boundingBox())!;
  await page.mouse.move(inSide.x + inSide.width / 2, inSide.y + inSide.height / 2);
  await page.mouse.down();
  await page.mouse.move(inSide.x, inSide.y - 30, { steps: 5 });
  await page.mouse.up();
  expect((await documentOf(page))["bodies"][0].position).not.toHaveProperty("elevation_m");
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByRole("button", { name: "Undo" }).click();
  expect((await documentOf(page))["bodies"][0]).not.toHaveProperty("position");
});

test("a body is dragged with a finger", async ({ page }) => {
  await page.goto("/#/new");
  const cube = above(page).getByRole("button", body(0));
  const { x, y, width, height } = (await cube.boundingBox())!;
  const client = await page.context().newCDPSession(page);
  const touch = (type: "touchStart" | "touchMove" | "touchEnd", dx: number) =>
    client.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: type === "touchEnd" ? [] : [{ x: x + width / 2 + dx, y: y + height / 2 }],
    });
  await touch("touchStart", 0);
  for (const dx of [20, 50, 80]) await touch("touchMove", dx);
  await touch("touchEnd", 80);
  expect((await documentOf(page))["bodies"][0].position.downstream_m).toBeGreaterThan(0.3);
});

test("a body is moved with keys, and lifted", async ({ page }) => {
  await page.goto("/#/new");
  const cube = side(page).getByRole("button", body(0));
  await cube.focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("ArrowUp");
  expect((await documentOf(page))["bodies"][0].position).toEqual({ downstream_m: 0.095 });
  await cube.focus();
  await page.keyboard.press("PageUp");
  await page.keyboard.press("ArrowUp");
  expect((await documentOf(page))["bodies"][0].position).toEqual({ downstream_m: 0.095, elevation_m: 0.03 });
  await above(page).getByRole("button", body(0)).focus();
  await page.keyboard.press("ArrowUp");
  await expect(page.locator("[aria-live]").filter({ hasText: "lateral 0.005 m" })).toBeAttached();
  await page.keyboard.press("Enter");
  await expect(page.locator('[id="field:/bodies/0"]')).toBeFocused();
});

test("a scenario without a flow and one without bodies are shown", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByLabel("There is a flow").uncheck();
  await expect(page.locator("figcaption")).toContainText("There is no flow.");
  await expect(plan(page).getByText(/Bodies alone/)).toBeVisible();
  expect((await documentOf(page))["flow"]).toBeNull();
  await page.getByLabel("There is a flow").check();
  await expect(page.getByLabel("Volume")).toHaveValue("0.01");
  await page.getByRole("button", { name: "Remove Body 0" }).click();
  await expect(page.locator("figcaption")).toContainText("0 bodies");
  await expect(
    plan(page)
      .getByText(/material points/)
      .first(),
  ).toBeVisible();
});

test("hundreds of bodies stay quick", async ({ page }) => {
  const bodies = Array.from({ length: 256 }, (_, index) => ({
    shape: { cube: { side_m: 0.01 } },
    position: { downstream_m: 0.1 + 0.02 * Math.floor(index / 8), lateral_m: -0.07 + 0.02 * (index % 8) },
  }));
  await page.goto("/#/new");
  await choose(page, "many.json", JSON.stringify({ ...(await scenario("minimal")), bodies }));
  await expect(page.getByText("Bodies (256)")).toBeVisible();
  await expect(page.getByRole("button", { name: "Add a body" })).toBeDisabled();
  const began = Date.now();
  await page.getByLabel("Inclination").pressSequentially("12345");
  expect(Date.now() - began).toBeLessThan(3000);
  await expectNoSidewaysScroll(page);
});

test("drawings and their words are seen as a whole in a low window", async ({ page }) => {
  await page.setViewportSize({ width: 1280, height: 500 });
  await page.goto("/#/new");
  const figure = page.locator("figure.scene");
  await expect(figure.locator("figcaption")).toContainText("Drag a body");
  const { inner, outer } = await figure.evaluate((figure) => ({
    inner: figure.scrollHeight,
    outer: figure.clientHeight,
  }));
  expect(inner).toBeLessThanOrEqual(outer);
});

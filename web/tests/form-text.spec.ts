/** The form as text, its files and its history. */

import { choose } from "./form-page";
import { QUICK, expect, test } from "./service";

test("fields and text are two views of one scenario", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByLabel("Incline length").fill("1.50");
  await expect(page.getByLabel("Incline length")).toHaveValue("1.50");
  await page.getByRole("button", { name: "JSON", exact: true }).click();
  const text = page.getByLabel("The scenario as JSON");
  await expect(text).toHaveValue(/"incline_length_m": 1.5,/);
  await text.fill((await text.inputValue()).replace("1.5", "1.6"));
  await expect(page.locator("figcaption")).toContainText("1.6 m long");
  const good = await text.inputValue();
  await text.fill('{\n  "channel": {\n    "inclination_deg": 4 5\n  }\n}');
  await expect(page.getByText(/^Line 3, column 26: expected a comma/)).toBeVisible();
  await expect(text).toHaveAttribute("aria-invalid", "true");
  await expect(page.locator("figcaption")).toContainText("1.6 m long");
  await text.fill(good.replace("1.6", "1.7"));
  await page.getByRole("button", { name: "Fields", exact: true }).click();
  await expect(page.getByLabel("Incline length")).toHaveValue("1.7");
});

test("changes are undone, redone, and survive a reload", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByLabel("Inclination").fill("41");
  await page.getByLabel("Volume").fill("0.02");
  await page.getByRole("button", { name: "Undo" }).click();
  await expect(page.getByLabel("Volume")).toHaveValue("0.01");
  await page.getByRole("button", { name: "Undo" }).click();
  await expect(page.getByLabel("Inclination")).toHaveValue("40");
  await expect(page.getByRole("button", { name: "Undo" })).toBeDisabled();
  await page.getByRole("button", { name: "Redo" }).click();
  await page.getByRole("button", { name: "Redo" }).click();
  await expect(page.getByLabel("Volume")).toHaveValue("0.02");
  await page.reload();
  await expect(page.getByLabel("Inclination")).toHaveValue("41");
  await expect(page.getByLabel("Volume")).toHaveValue("0.02");
});

test("text is typed on while it is no JSON, and begun anew", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByRole("button", { name: "JSON", exact: true }).click();
  const text = page.getByLabel("The scenario as JSON");
  const before = await text.inputValue();
  await text.focus();
  await page.keyboard.press("Control+Home");
  await page.keyboard.type("x y");
  await expect(text).toBeFocused();
  await expect(text).toHaveValue(`x y${before}`);
  for (let typed = 0; typed < 3; typed += 1) await page.keyboard.press("Backspace");
  await expect(text).toBeFocused();
  await expect(text).toHaveValue(before);
  await page.keyboard.type("x");
  await page.getByRole("button", { name: "Start over" }).click();
  await expect(text).toHaveValue(before);
  await expect(page.getByRole("button", { name: "Run it" })).toBeEnabled();
});

test("text that can't be read is not run", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByRole("button", { name: "JSON", exact: true }).click();
  await page.getByLabel("The scenario as JSON").fill("{");
  await expect(page.getByRole("button", { name: "Run it" })).toBeDisabled();
  await page.getByLabel("The scenario as JSON").fill("[]");
  await expect(page.getByText(/a scenario is an object/)).toBeVisible();
  await page.getByRole("button", { name: "Fields", exact: true }).click();
  await expect(page.getByRole("button", { name: "Run it" })).toBeEnabled();
});

test("a file that is no JSON is shown with its error, a good one with its name", async ({ page }) => {
  await page.goto("/#/new");
  await choose(page, "broken.json", '{"channel": }');
  await expect(page.getByText(/Line 1, column 13/)).toBeVisible();
  await expect(page.getByLabel("The scenario as JSON")).toHaveValue('{"channel": }');
  await page.getByRole("button", { name: "Fields", exact: true }).click();
  const data = await page.evaluateHandle((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], "quick.json", { type: "application/json" }));
    return transfer;
  }, JSON.stringify(QUICK));
  await page.locator(".scenario-form").dispatchEvent("drop", { dataTransfer: data });
  await expect(page.getByLabel("Title")).toHaveValue("Quick");
  await page.getByLabel("Title").fill("Quicker");
  await expect(page.getByText("1 field differs from quick.json")).toBeVisible();
  await page.reload();
  await expect(page.getByLabel("Title")).toHaveValue("Quicker");
});

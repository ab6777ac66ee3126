/** The form of a new scenario, as tests use it. */

import type { Page } from "@playwright/test";

/** The scenario that the form holds. */
export async function documentOf(page: Page): Promise<Record<string, any>> {
  await page.getByRole("button", { name: "JSON", exact: true }).click();
  const text = await page.getByLabel("The scenario as JSON").inputValue();
  await page.getByRole("button", { name: "Fields", exact: true }).click();
  return JSON.parse(text);
}

export const side = (page: Page) => page.getByRole("group", { name: "View from the side" });
export const above = (page: Page) => page.getByRole("group", { name: "View from above" });
export const body = (index: number) => ({ name: new RegExp(`^Body ${index},`) });
export const plan = (page: Page) => page.getByRole("region", { name: /What the run will take/ });

/** Sets a file as if it were chosen. */
export async function choose(page: Page, name: string, text: string): Promise<void> {
  await page
    .getByLabel("Scenario file")
    .setInputFiles({ name, mimeType: "application/json", buffer: Buffer.from(text) });
}

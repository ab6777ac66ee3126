import { QUICK, expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";

let first = "";
let second = "";
test.beforeAll(async ({ service }) => {
  const accuracy = { error_bars: true };
  first = await service.run({ ...QUICK, title: "Light", accuracy });
  second = await service.run({
    ...QUICK,
    title: "Heavy",
    accuracy,
    bodies: [{ ...QUICK.bodies[0], density_kg_m3: 4000 }],
  });
});

test("another job is chosen and compared", async ({ page, service }) => {
  await page.goto(`/#/jobs/${first}`);
  await page.getByRole("button", { name: "Compare with …" }).click();
  await page.getByRole("combobox", { name: /^Successful job/ }).selectOption(second);
  await page.getByRole("button", { name: "Compare", exact: true }).click();
  await expect(page).toHaveURL(new RegExp(`#/compare/${first}/${second}$`));
  const fields = page.getByRole("region", { name: "Differing fields" });
  await expect(fields.getByRole("row", { name: "/bodies/0/density_kg_m3 2000 4000" })).toBeVisible();
  await expect(fields.getByRole("row")).toHaveCount(3);
  type Told = { outcome: { bodies: { displacement_m: number }[] } };
  const [a, b] = await Promise.all([first, second].map((id) => service.get<Told>(`/v1/jobs/${id}`)));
  const difference = (b?.outcome.bodies[0]?.displacement_m ?? 0) - (a?.outcome.bodies[0]?.displacement_m ?? 0);
  const row = page.getByRole("region", { name: "Comparison: Body 0" }).getByRole("row", { name: /^Displacement/ });
  await expect(row).toContainText(String(Number(difference.toPrecision(3))).replace("-", "−"));
  await expect(row).toContainText(/overlap|apart/);
  await expect(page.locator(".aerial canvas")).toHaveCount(2);
  await expect(page.locator(".plot canvas")).toHaveCount(5);
});

for (const colorScheme of ["light", "dark"] as const) {
  test(`a comparison is accessible in the ${colorScheme} theme and fits a narrow window`, async ({ page }) => {
    await page.emulateMedia({ colorScheme });
    await page.goto(`/#/compare/${first}/${second}`);
    await expect(page.locator(".aerial canvas")).toHaveCount(2);
    await expectAccessible(page);
    await page.setViewportSize({ width: 360, height: 740 });
    // Pictures take their new width with the next frame.
    await expect(() => expectNoSidewaysScroll(page)).toPass();
  });
}

test("a comparison with an unknown job, or of unequal scenes, does not break", async ({ page, service }) => {
  await page.goto(`/#/compare/${first}/01890000-0000-7000-8000-000000000000`);
  await expect(page.getByRole("alert")).toBeVisible();
  const none = await service.run({ ...QUICK, title: "None", bodies: [], duration_s: 0.1 });
  await page.goto(`/#/compare/${first}/${none}`);
  await expect(page.getByText(/has 1 bodies, the second 0|first job has 1/)).toBeVisible();
  await expect(page.getByRole("region", { name: "Comparison: Flow" })).toBeVisible();
});

test("a comparison of many bodies shows some of them first", async ({ page, service }) => {
  const bodies = (side_m: number) =>
    Array.from({ length: 30 }, (_, k) => ({
      shape: { cube: { side_m } },
      position: { downstream_m: 0.05 + 0.02 * Math.floor(k / 5), lateral_m: -0.04 + 0.02 * (k % 5) },
    }));
  const scene = { ...QUICK, flow: null, duration_s: 0.05 };
  const first = await service.run({ ...scene, bodies: bodies(0.01) });
  const second = await service.run({ ...scene, bodies: bodies(0.012) });
  await page.goto(`/#/compare/${first}/${second}`);
  const fields = page.getByRole("region", { name: "Differing fields" }).getByRole("row");
  await expect(fields).toHaveCount(21);
  await page.getByRole("button", { name: /^Show all \d+ differences$/ }).click();
  expect(await fields.count()).toBeGreaterThan(30);
  await expect(page.getByRole("region", { name: /^Comparison: Body/ })).toHaveCount(3);
  await page.getByRole("button", { name: "Show all 30 bodies" }).click();
  await expect(page.getByRole("region", { name: /^Comparison: Body/ })).toHaveCount(30);
});

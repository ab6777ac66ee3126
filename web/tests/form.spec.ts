/** The form of a new scenario. */

import { body, choose, documentOf, plan, side } from "./form-page";
import { QUICK, expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";

test("a first visit begins with an example, and one click runs it", async ({ page, service }) => {
  await page.goto("/#/new");
  await expect(page.getByLabel("Inclination")).toHaveValue("40");
  await expect(page.getByLabel("Width")).toHaveAttribute("placeholder", "default: 0.2");
  await expect(side(page).getByRole("button", body(0))).toBeVisible();
  await expect(plan(page).getByText(/of computing/)).toBeVisible();
  await expect(plan(page).getByText(/material points in cells of/)).toBeVisible();
  await page.getByLabel("Duration").fill("0.01");
  await page.getByLabel("Label").fill("first-visit");
  const submitted = page.waitForRequest((request) => request.method() === "POST" && request.url().includes("/v1/jobs"));
  await page.getByRole("button", { name: "Run it" }).click();
  const request = await submitted;
  expect(request.headers()["idempotency-key"]).toMatch(/^[\da-f]{32}$/);
  await expect(page).toHaveURL(/#\/jobs\/[\da-f-]{36}$/);
  const id = page.url().split("/").at(-1);
  expect(await service.get(`/v1/jobs/${id}`)).toMatchObject({
    labels: ["first-visit"],
    scenario: { duration_s: 0.01 },
  });
  await page.goto("/#/new");
  await expect(page.getByLabel("Duration")).toHaveValue("");
});

test("examples are reached by address and by choice, each keeps its draft", async ({ page }) => {
  await page.goto("/#/new?preset=baffles");
  await expect(page.getByLabel("Title")).toHaveValue(/baffles/);
  await expect(side(page).getByRole("button")).toHaveCount(3);
  await page.getByLabel("Title").fill("Mine");
  await page.getByLabel("Begin with").selectOption("ten_cubes");
  await expect(page).toHaveURL(/#\/new\?preset=ten_cubes$/);
  await expect(side(page).getByRole("button")).toHaveCount(10);
  await page.getByLabel("Begin with").selectOption("baffles");
  await expect(page.getByLabel("Title")).toHaveValue("Mine");
  await page.getByRole("button", { name: "Start over" }).click();
  await expect(page.getByLabel("Title")).toHaveValue(/baffles/);
  await page.goto("/#/new?preset=moon");
  await expect(page.getByRole("alert")).toContainText('no example "moon"');
  await page.getByRole("link", { name: "Begin with an example" }).click();
  await expect(page.getByLabel("Inclination")).toHaveValue("40");
});

test("all examples can be planned", async ({ page }) => {
  test.setTimeout(180_000);
  await page.goto("/#/new");
  await expect(page.getByLabel("Begin with")).toBeVisible();
  const names = await page
    .getByLabel("Begin with")
    .locator("option")
    .evaluateAll((options) => options.map((option) => (option as HTMLOptionElement).value));
  expect(names.length).toBe(12);
  for (const name of names) {
    await page.goto(`/#/new?preset=${name}`);
    await expect(plan(page).getByText(/of computing/)).toBeVisible();
    await expect(page.getByText(/not drawn/i)).toHaveCount(0);
  }
});

test("a job is run again with changes, which are shown", async ({ page, service }) => {
  const id = await service.submit({ ...QUICK, duration_s: 0.02 });
  await page.goto(`/#/new?job=${id}`);
  await expect(page.getByLabel("Duration")).toHaveValue("0.02");
  await expect(page.getByText(/differ/)).toHaveCount(0);
  await page.getByLabel("Volume").fill("0.0005");
  await page.getByText(`1 field differs from job ${id.slice(0, 8)}`).click();
  await expect(page.getByRole("listitem").filter({ hasText: "0.0006 m³ → 0.0005 m³" })).toBeVisible();
  await page.getByRole("button", { name: "Restore Volume" }).click();
  await expect(page.getByLabel("Volume")).toHaveValue("0.0006");
  await page.goto("/#/new?job=00000000-0000-4000-8000-000000000000");
  await expect(page.getByRole("alert")).toBeVisible();
});

test("violations are at their fields, and links lead to folded ones", async ({ page }) => {
  await page.goto("/#/new");
  await choose(
    page,
    "bad.json",
    JSON.stringify({
      ...QUICK,
      channel: { ...QUICK.channel, inclination_deg: 95, depth: 1 },
      numerics: { courant: 2 },
    }),
  );
  const inclination = page.getByLabel("Inclination");
  await expect(inclination).toHaveAttribute("aria-invalid", "true");
  await expect(inclination).toHaveAccessibleDescription(/inclination_deg is 95, outside/);
  await expect(page.getByText("3 rules are broken")).toBeVisible();
  await expect(page.getByText("channel.depth is not a known field.")).toBeVisible();
  await expect(page.getByText("1 violation", { exact: true })).toBeVisible();
  await expectAccessible(page);
  await page.getByRole("button", { name: "Numerics › Courant" }).click();
  await expect(page.getByLabel("Courant", { exact: true })).toBeFocused();
  await page.getByRole("button", { name: "Channel › Inclination" }).click();
  await expect(inclination).toBeFocused();
  await inclination.fill("4x");
  await expect(page.getByText(/inclination_deg must be a number/).first()).toBeVisible();
  await page.getByRole("button", { name: "JSON", exact: true }).click();
  await page.getByRole("button", { name: "Numerics › Courant" }).click();
  const text = page.getByLabel("The scenario as JSON");
  await expect(text).toBeFocused();
  expect(
    await text.evaluate((area: HTMLTextAreaElement) => area.value.slice(area.selectionStart, area.selectionEnd)),
  ).toBe("2");
});

test("a scenario that breaks rules is refused with them", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByLabel("Inclination").fill("95");
  await expect(page.getByText("It will be refused until no rule is broken.")).toBeVisible();
  await page.getByRole("button", { name: "Run it" }).click();
  await expect(page.getByRole("alert")).toContainText("outside 0 <= x <= 89");
  await expect(page).toHaveURL(/#\/new$/);
});

test("vectors, lists and prescribed motions can be entered", async ({ page }) => {
  await page.goto("/#/new");
  await page.getByText(/^More: density, sphero radius/).click();
  const velocity = page.getByRole("group", { name: "Velocity", exact: true });
  await velocity.getByLabel("x").fill("-2");
  expect((await documentOf(page))["bodies"][0].velocity_m_s).toEqual([-2, 0, 0]);
  await velocity.getByLabel("x").fill("");
  await velocity.getByLabel("y").fill("");
  await velocity.getByLabel("z").fill("");
  expect((await documentOf(page))["bodies"][0]).not.toHaveProperty("velocity_m_s");
  await page.getByLabel("Motion", { exact: true }).selectOption({ label: "Motion by a table" });
  await page.getByLabel("Times").fill("[0, 0.5");
  await expect(page.getByText(/Line 1, column 8/)).toBeVisible();
  await page.getByLabel("Times").fill("[0, 0.5]");
  expect((await documentOf(page))["bodies"][0].motion).toEqual({ times_s: [0, 0.5] });
  await page.getByLabel("Motion", { exact: true }).selectOption({ label: "Constant motion" });
  expect((await documentOf(page))["bodies"][0].motion).toEqual({});
  await page.getByLabel("Motion", { exact: true }).selectOption({ label: "none" });
  expect((await documentOf(page))["bodies"][0]).not.toHaveProperty("motion");
});

test("the slider asks for intervals and targets", async ({ page }) => {
  await page.goto("/#/new?preset=source_paper");
  await page.getByRole("heading", { name: "Accuracy" }).click();
  const slider = page.getByLabel("Accuracy of the answer");
  await expect(slider).toHaveAttribute("aria-valuetext", "no uncertainty");
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await expect(slider).toHaveAttribute("aria-valuetext", "uncertainty intervals");
  await expect(plan(page).getByText(/before that of the answer/)).toBeVisible();
  expect((await documentOf(page))["accuracy"]).toEqual({ error_bars: true });
  await slider.focus();
  await page.keyboard.press("End");
  await page.getByLabel("Quantity").selectOption("front_m");
  await expect(plan(page).getByText(/the first runs find the cells/)).toBeVisible();
  const document = await documentOf(page);
  expect(document["accuracy"]).toEqual({ target: 0.01, quantity: "front_m" });
  expect(document).not.toHaveProperty("numerics");
  await slider.focus();
  await page.keyboard.press("Home");
  expect(await documentOf(page)).not.toHaveProperty("accuracy");
});

test("a field that a later version adds appears by itself", async ({ page }) => {
  await page.route("**/openapi.json", async (route) => {
    const contract = await (await route.fetch()).json();
    const { Channel, Body, Shape, Scenario } = contract.components.schemas;
    Channel.properties.roughness_m = {
      type: "number",
      description: "Roughness of the bed [m].",
      default: 0.01,
      minimum: 0,
      maximum: 1,
      "x-unit": "m",
    };
    Body.properties.paint = { type: "string", enum: ["red", "green"], description: "Its paint." };
    Shape.oneOf.push({
      type: "object",
      required: ["cone"],
      properties: {
        cone: { type: "object", required: ["height_m"], properties: { height_m: { type: "number", "x-unit": "m" } } },
      },
    });
    Scenario.properties.weather = {
      type: "object",
      properties: { rain_m_s: { type: "number", "x-unit": "m/s" } },
      description: "Weather.",
    };
    await route.fulfill({ json: contract });
  });
  await page.goto("/#/new");
  await page.getByText(/^More: base friction/).click();
  await page.getByLabel("Roughness").fill("0.02");
  await expect(page.getByText("channel.roughness_m is not a known field.").first()).toBeVisible();
  await page.getByText(/^More: density, sphero radius/).click();
  await page.getByLabel("Paint").selectOption("green");
  await page.getByLabel("Shape").selectOption({ label: "Cone" });
  await page.getByLabel("Height").last().fill("0.5");
  await page.getByRole("heading", { name: "Weather" }).click();
  await page.getByLabel("Rain").fill("3");
  expect(await documentOf(page)).toMatchObject({
    channel: { roughness_m: 0.02 },
    bodies: [{ paint: "green", shape: { cone: { height_m: 0.5 } } }],
    weather: { rain_m_s: 3 },
  });
  await expect(page.getByText(/Not drawn, since its shape is incomplete: body 0/)).toBeVisible();
});

test("one plan is asked for at a time, and a busy service is asked again", async ({ page }) => {
  let asked = 0;
  let running = 0;
  let most = 0;
  page.on("requestfailed", (request) => (running -= request.url().endsWith("/v1/plans") ? 1 : 0));
  await page.route("**/v1/plans", async (route) => {
    asked += 1;
    running += 1;
    most = Math.max(most, running);
    if (asked === 1) {
      running -= 1;
      return route.fulfill({
        status: 429,
        headers: { "Retry-After": "1" },
        contentType: "application/problem+json",
        body: '{"title":"Busy","status":429,"detail":"too many"}',
      });
    }
    const answer = await route.fetch().catch(() => undefined);
    await new Promise((resolve) => setTimeout(resolve, 800));
    if (!answer) return;
    await route.fulfill({ response: answer }).then(
      () => (running -= 1),
      () => undefined,
    );
  });
  await page.goto("/#/new");
  await expect(page.getByText("asked again in 1 s")).toBeVisible();
  await expect(plan(page).getByText(/of computing/)).toBeVisible();
  expect(asked).toBe(2);
  for (const angle of ["41", "42", "43"]) {
    await page.getByLabel("Inclination").fill(angle);
    await page.waitForTimeout(700);
  }
  await expect(plan(page).getByText("being planned")).toHaveCount(0);
  expect(asked).toBe(5);
  expect(most).toBe(1);
});

test("a submission that got no answer is repeated under the same name", async ({ page, service }) => {
  const keys: (string | undefined)[] = [];
  await page.goto("/#/new");
  await choose(page, "quick.json", JSON.stringify({ ...QUICK, title: "Only once", duration_s: 0.01 }));
  await page.route("**/v1/jobs", async (route) => {
    if (route.request().method() !== "POST") return route.continue();
    keys.push(route.request().headers()["idempotency-key"]);
    const answer = await route.fetch();
    // The first answer is lost on its way.
    return keys.length === 1
      ? route.fulfill({ status: 503, headers: { "Retry-After": "2" }, body: "" })
      : route.fulfill({ response: answer });
  });
  await page.getByRole("button", { name: "Run it" }).click();
  await expect(page.getByText("Try again in 2 s.")).toBeVisible();
  await page.getByRole("button", { name: "Run it" }).click();
  await expect(page).toHaveURL(/#\/jobs\//);
  expect(keys.length).toBe(2);
  expect(keys[0]).toBe(keys[1]);
  const { jobs } = await service.get<{ jobs: { title?: string }[] }>("/v1/jobs?limit=100");
  expect(jobs.filter(({ title }) => title === "Only once").length).toBe(1);
});

for (const colorScheme of ["light", "dark"] as const) {
  test(`the form is accessible in ${colorScheme} colours`, async ({ page }) => {
    await page.emulateMedia({ colorScheme });
    await page.goto("/#/new?preset=baffles");
    await expect(plan(page).getByText(/of computing/)).toBeVisible();
    for (const name of ["Accuracy", "Numerics", "More settings"]) await page.getByRole("heading", { name }).click();
    await page.getByText("Body 2", { exact: true }).click();
    for (const more of await page.getByText(/^More: /).all()) await more.click();
    for (const more of await plan(page).locator("summary").all()) await more.click();
    await page.getByLabel("Accuracy of the answer").fill("3");
    await expect(plan(page).getByText(/the first runs find/)).toBeVisible();
    await expectAccessible(page);
    await page.getByRole("button", { name: "JSON", exact: true }).click();
    await expectAccessible(page);
  });
}

test("nothing scrolls sideways at 360 px", async ({ page }) => {
  await page.setViewportSize({ width: 360, height: 740 });
  await page.goto("/#/new?preset=boulder_cluster");
  await expect(plan(page).getByText(/of computing/)).toBeVisible();
  await page.getByText("Body 0", { exact: true }).click();
  for (const name of ["Accuracy", "Numerics", "More settings"]) await page.getByRole("heading", { name }).click();
  for (const more of await page.getByText(/^More: /).all()) await more.click();
  for (const more of await plan(page).locator("summary").all()) await more.click();
  await expectNoSidewaysScroll(page);
  const [figure, inclination] = [
    (await page.locator("figure").boundingBox())!,
    (await page.getByLabel("Inclination").boundingBox())!,
  ];
  expect(figure.y).toBeLessThan(inclination.y);
  await page.getByRole("button", { name: "JSON", exact: true }).click();
  await expectNoSidewaysScroll(page);
});

test("on a narrow window a button leads to what runs the scenario", async ({ page }) => {
  await page.setViewportSize({ width: 360, height: 740 });
  await page.goto("/#/new");
  await page.getByRole("button", { name: "Go to the run" }).click();
  const run = page.getByRole("button", { name: "Run it", exact: true });
  await expect(run).toBeFocused();
  await expect(run).toBeInViewport();
  await page.setViewportSize({ width: 1280, height: 800 });
  await expect(page.getByRole("button", { name: "Go to the run" })).toBeHidden();
});

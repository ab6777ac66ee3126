import { readFile } from "node:fs/promises";
import { QUICK, expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";

test("every request and document of the contract is there", async ({ page, service }) => {
  const contract = await service.get<{
    paths: Record<string, Record<string, { operationId: string }>>;
    components: { schemas: object };
  }>("/openapi.json");
  await page.goto("/docs");
  await expect(page.getByRole("heading", { level: 1, name: "Scree: the interface" })).toBeVisible();
  for (const [path, methods] of Object.entries(contract.paths))
    for (const [method, { operationId }] of Object.entries(methods)) {
      const summary = page.locator(`[id="${operationId}"] > summary`);
      await expect(summary).toContainText(method.toUpperCase());
      await expect(summary).toContainText(path);
    }
  await expect(page.locator('[id^="schema-"]')).toHaveCount(Object.keys(contract.components.schemas).length);
});

test("the contract is shown without a noticeable pause", async ({ page }) => {
  await page.goto("/docs");
  await expect(page.locator("#submit")).toBeVisible();
  const longest = await page.evaluate(
    () =>
      new Promise<number>((resolve) => {
        let most = 0;
        new PerformanceObserver((list) =>
          list.getEntries().forEach(({ duration }) => (most = Math.max(most, duration))),
        ).observe({ type: "longtask", buffered: true });
        setTimeout(() => resolve(most), 500);
      }),
  );
  expect(longest).toBeLessThan(400);
  // Contents are made when they are opened.
  await expect(page.locator(".entry .contents")).toHaveCount(0);
});

test("links lead to requests and documents, and open them", async ({ page }) => {
  await page.goto("/docs#trajectory");
  const entry = page.locator("#trajectory");
  await expect(entry).toHaveAttribute("open", "");
  await expect(entry).toBeInViewport();
  await expect(entry.getByText("One sample in how many, counted from the first in the range.")).toBeVisible();
  await entry.getByRole("link", { name: "Trajectory", exact: true }).first().click();
  await expect(page.locator("#schema-Trajectory")).toHaveAttribute("open", "");
  await expect(page.locator("#schema-Trajectory")).toBeInViewport();
  await page.locator("#schema-Trajectory > summary").click();
  await page.goBack();
  await page.goto("/docs#schema-Channel");
  const inclination = page.locator("#schema-Channel .fields > li").filter({ hasText: "inclination_deg" });
  await expect(inclination).toContainText("required");
  await expect(inclination).toContainText("unit °; 0 ≤ x ≤ 89");
});

test("a scenario is submitted, and its job is read", async ({ page, service }) => {
  await page.goto("/docs#submit");
  const submit = page.locator("#submit");
  await expect(submit.getByRole("button", { name: "Send: this changes something (POST)" })).toBeVisible();
  await submit.getByLabel("Body").fill(JSON.stringify({ ...QUICK, title: "From the reference" }));
  await expect(submit.getByLabel(/^curl line/)).toContainText('--data \'{"title":"From the reference"');
  await submit.getByRole("button", { name: /^Send/ }).click();
  await expect(submit.locator(".received")).toContainText("202");
  const { jobs } = await service.get<{ jobs: { id: string; title: string }[] }>("/v1/jobs");
  expect(jobs[0]?.title).toBe("From the reference");
  await service.get(`/v1/jobs/${jobs[0]?.id}?wait=30s`);
  await page.goto("/docs#show");
  const show = page.locator("#show");
  await show.getByLabel(/^id/).fill(jobs[0]?.id ?? "");
  await expect(show.getByLabel(/^curl line/)).toHaveText(`curl '${new URL(page.url()).origin}/v1/jobs/${jobs[0]?.id}'`);
  await show.getByRole("button", { name: "Send", exact: true }).click();
  await expect(show.getByLabel("Body of the answer")).toContainText('"status": "successful"');
  await show.getByText(/\d+ headers/).click();
  await expect(show.getByLabel("Headers of the answer")).toContainText("content-type: application/json");
});

test("answers that are no success are shown as they are", async ({ page }) => {
  await page.goto("/docs#show");
  const show = page.locator("#show");
  await show.getByLabel(/^id/).fill("nothing");
  await show.getByRole("button", { name: "Send", exact: true }).click();
  await expect(show.locator(".received")).toContainText("404");
  await expect(show.getByLabel("Body of the answer")).toContainText("urn:scree:problem");
  await page.goto("/docs#submit");
  const submit = page.locator("#submit");
  await submit.getByLabel("Body").fill('{"channel": {}}');
  await submit.getByRole("button", { name: /^Send/ }).click();
  await expect(submit.locator(".received")).toContainText("422");
});

test("binary answers are saved", async ({ page, service }) => {
  const id = await service.run(QUICK);
  await page.goto("/docs#trajectory_npz");
  const entry = page.locator("#trajectory_npz");
  await entry.getByLabel(/^id/).fill(id);
  await entry.getByRole("button", { name: "Send", exact: true }).click();
  await expect(entry).toContainText(/[\d.]+ kB of application\/zip/);
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    entry.getByRole("button", { name: "Save as trajectory.npz" }).click(),
  ]);
  expect((await readFile(await download.path())).subarray(0, 2).toString()).toBe("PK");
});

test("a stream tells its events until it is stopped", async ({ page, service }) => {
  await page.goto("/docs#events");
  const events = page.locator("#events");
  await events.getByRole("button", { name: "Send", exact: true }).click();
  await expect(events.getByText("The stream is open: 0 events so far.")).toBeVisible();
  const id = await service.submit(QUICK);
  await expect(events.getByLabel("Events", { exact: true })).toContainText(id);
  await events.getByRole("button", { name: "Stop" }).click();
  await expect(events.getByText(/^The stream is closed/)).toBeVisible();
  const told = await events.getByLabel("Events", { exact: true }).textContent();
  await service.run({ ...QUICK, title: "After the stop" });
  await expect(events.getByLabel("Events", { exact: true })).toHaveText(told ?? "");
});

test("a search narrows requests and documents", async ({ page }) => {
  await page.goto("/docs");
  await page.getByRole("searchbox").fill("trajectory npz");
  await expect(page.locator("#trajectory_npz")).toBeVisible();
  await expect(page.locator("#submit")).toHaveCount(0);
  await page.getByRole("searchbox").fill("nothing has this");
  await expect(page.getByText("0 requests, 0 documents")).toBeVisible();
});

test("the page is accessible and fits small windows in both themes", async ({ page }) => {
  for (const colorScheme of ["light", "dark"] as const) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.goto("/docs#submit");
    await page.reload();
    await page.locator("#submit").getByText("Fields of the body").click();
    await expect(page.locator("#submit").getByText("Fields of channel")).toBeVisible();
    await expectAccessible(page);
    await page.setViewportSize({ width: 360, height: 700 });
    await expectNoSidewaysScroll(page);
  }
});

test("lines are copied, or selected where the page may not copy", async ({ page, context }) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.goto("/docs");
  const copy = page.getByRole("button", { name: "Copy: Wait for the job" });
  await copy.click();
  await expect(page.getByText("Copied")).toBeVisible();
  expect(await page.evaluate(() => navigator.clipboard.readText())).toContain("/v1/jobs/$ID?wait=60s");
});

test("lines are copied on pages without a secure address, too", async ({ page, context }) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.goto("/docs");
  await page.evaluate(() => Object.defineProperty(navigator, "clipboard", { value: undefined, configurable: true }));
  await page.getByRole("button", { name: "Copy: Read the flow" }).click();
  await expect(page.getByText("Copied")).toBeVisible();
  expect(await page.evaluate(() => getSelection()?.toString())).toContain("/flow?time_s=0.5");
});

test("there are ways back to the page and to the contract", async ({ page }) => {
  await page.goto("/docs");
  await expect(page.getByRole("link", { name: "openapi.json" }).first()).toHaveAttribute("href", "/openapi.json");
  await page.getByRole("link", { name: "Back to the page" }).click();
  await expect(page).toHaveURL(/\/$/);
});

test("requests show the token of this tab, and it can be forgotten", async ({ page }) => {
  await page.goto("/docs#list");
  await page.getByRole("textbox", { name: "Access token" }).fill("abc");
  await page.getByRole("button", { name: "Use it" }).click();
  await expect(page.getByText("Requests from this tab show a token.")).toBeVisible();
  await expect(page.locator("#list").getByLabel(/^curl line/)).toContainText('-H "Authorization: Bearer $SCREE_TOKEN"');
  const [request] = await Promise.all([
    page.waitForRequest((request) => request.url().endsWith("/v1/jobs")),
    page.locator("#list").getByRole("button", { name: "Send", exact: true }).click(),
  ]);
  expect(request.headers()["authorization"]).toBe("Bearer abc");
  await page.getByRole("button", { name: "Forget it" }).click();
  expect(await page.evaluate(() => sessionStorage.getItem("scree-token"))).toBeNull();
});

import { QUICK, SLOW, Service, expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";
import { STUDY, finished } from "./study-scenes";

for (const colorScheme of ["light", "dark"] as const) {
  test(`the list is accessible, ${colorScheme}`, async ({ page, service }) => {
    await service.run(QUICK);
    await page.emulateMedia({ colorScheme });
    await page.goto("/");
    await expect(page.getByRole("link", { name: "Quick", exact: true }).first()).toBeVisible();
    await expectAccessible(page);
    await page.setViewportSize({ width: 360, height: 740 });
    await expectNoSidewaysScroll(page);
  });
}

test("a job is seen to come, to go on and to be dismissed and removed", async ({ page, service }) => {
  await page.goto("/");
  await expect(page.getByRole("heading", { name: "Jobs" })).toBeVisible();
  const id = await service.submit(SLOW);
  const row = page.locator(`[data-job="${id}"]`);
  // By events alone: nobody loads the page anew.
  await expect(row.getByText("running")).toBeVisible();
  await expect(row.getByText(/about .* left/)).toBeVisible();
  await row.getByRole("button", { name: "Dismiss" }).click();
  await row.getByRole("button", { name: "Really stop it?" }).click();
  await expect(row.getByText("dismissed")).toBeVisible();
  await row.getByRole("button", { name: "Remove" }).click();
  await row.getByRole("button", { name: "Really remove" }).click();
  await expect(row).toHaveCount(0);
  expect((await fetch(`${service.url}/v1/jobs/${id}`)).status).toBe(404);
});

test("a filter leaves out jobs of other states, and two successful jobs are compared", async ({ page, service }) => {
  const [one, other] = [await service.run(QUICK), await service.run(QUICK)];
  await page.goto("/");
  await page.getByLabel("failed").check();
  await expect(page.getByText("No job is like that.")).toBeVisible();
  await page.getByRole("button", { name: "Show all" }).click();
  await page.locator(`[data-job="${one}"]`).getByRole("checkbox").check();
  await page.locator(`[data-job="${other}"]`).getByRole("checkbox").check();
  await page.getByRole("link", { name: "Compare the two jobs" }).click();
  await expect(page).toHaveURL(new RegExp(`#/compare/${one}/${other}`));
});

test("a list of 1,000 jobs scrolls without stutter", async ({ browser }) => {
  const service = await Service.start();
  try {
    // The start alone: a thousand of them are soon computed.
    const start = { ...QUICK, flow: null, duration_s: 0 };
    const jobs = Array.from({ length: 100 }, (_, number) => ({ scenario: { ...start, title: `Start ${number}` } }));
    for (let batch = 0; batch < 10; batch += 1) await service.post("/v1/batches", { jobs });
    const waiting = () => service.get<{ jobs: unknown[] }>("/v1/jobs?status=accepted&status=running");
    await expect.poll(async () => (await waiting()).jobs.length, { timeout: 60_000 }).toBe(0);
    const page = await browser.newPage({ baseURL: service.url });
    await page.goto("/");
    const count = () => page.locator("[data-job]").count();
    await expect
      .poll(async () => {
        await page.mouse.wheel(0, 20_000);
        return count();
      })
      .toBe(1000);
    const late: number[] = [];
    // The best of three: others may use the machine.
    for (let scroll = 0; scroll < 3; scroll += 1) {
      const frames = (await page.evaluate(framesOfAScroll)).sort((a, b) => a - b);
      const quantile = (share: number) => frames[Math.ceil(share * frames.length) - 1] ?? NaN;
      const [middle, longest] = [quantile(0.5), quantile(1)];
      late.push(quantile(0.95));
      console.log(
        `frames of a scroll through 1,000 jobs: median ${middle}, 95 % ${late.at(-1)}, longest ${longest} ms`,
      );
    }
    // Less than four pictures of a screen with 60 a second.
    expect(Math.min(...late)).toBeLessThan(66);
    await page.close();
  } finally {
    await service.stop();
  }
});

/** Times between two frames while the page is scrolled from its end to its start [ms]. */
async function framesOfAScroll(): Promise<number[]> {
  const frame = () => new Promise<number>((resolve) => requestAnimationFrame(resolve));
  const times: number[] = [];
  let last = await frame();
  for (let place = document.body.scrollHeight; place > 0; place -= 600) {
    window.scrollTo(0, place);
    const now = await frame();
    times.push(now - last);
    last = now;
  }
  return times;
}

test("a list that cannot be read on is asked for again by its button alone", async ({ page, service }) => {
  const start = { ...QUICK, flow: null, duration_s: 0, title: "One of many" };
  await service.post("/v1/batches", { jobs: Array.from({ length: 100 }, () => ({ scenario: start })) });
  await service.run(start);
  // Events of jobs are a reason to ask again.
  const waiting = () => service.get<{ jobs: unknown[] }>("/v1/jobs?status=accepted&status=running");
  await expect.poll(async () => (await waiting()).jobs.length).toBe(0);
  // The last events are told within this time.
  await page.waitForTimeout(500);
  let asked = 0;
  await page.route(/cursor=/, (route) => {
    asked += 1;
    return route.fulfill({ status: 503, contentType: "application/problem+json", body: '{"title":"Busy"}' });
  });
  await page.goto("/");
  await page.getByRole("button", { name: "Show older jobs" }).scrollIntoViewIfNeeded();
  await expect(page.getByText("Busy").first()).toBeVisible();
  await page.waitForTimeout(1_000);
  expect(asked).toBe(1);
  await page.unroute(/cursor=/);
  await page.getByRole("button", { name: "Show older jobs" }).click();
  await expect(page.getByText("Busy")).toHaveCount(0);
});

test("a day that is being typed breaks nothing", async ({ page }) => {
  await page.goto("/");
  await page.getByLabel("Accepted from").fill("275760-12-31");
  await expect(page.getByRole("heading", { name: "Jobs" })).toBeVisible();
  await page.getByLabel("Accepted from").fill("2099-01-01");
  await expect(page.getByText("No job is like that.")).toBeVisible();
});

test("members of studies are listed when they are asked for", async ({ page, service }) => {
  const own = await service.run(QUICK);
  const study = await finished(service, { ...STUDY, design: { sobol: { members: 4, seed: 7 } }, questions: [] });
  await page.goto("/");
  await expect(page.locator(`[data-job="${own}"]`)).toBeVisible();
  const members = page.locator(".job-row", { has: page.locator(`a[href="#/studies/${study}"]`) });
  await expect(members).toHaveCount(0);
  await page.getByLabel("Members of studies").check();
  await expect(members).toHaveCount(4);
  await page.getByLabel("Members of studies").uncheck();
  await page.getByRole("textbox", { name: "Label" }).fill(`study:${study}`);
  await expect(members).toHaveCount(4);
});

/** The page while the service is busy, or does not answer. */
import type { Page, Route } from "@playwright/test";
import { QUICK, expect, expectAccessible, test } from "./service";

const BUSY = {
  status: 503,
  headers: { "Retry-After": "1" },
  contentType: "application/problem+json",
  body: JSON.stringify({ type: "about:blank", title: "Busy", status: 503, detail: "the service is busy" }),
};

/** Answers the first so many requests of an address as a busy service does. */
async function busyFor(page: Page, address: RegExp, count: number): Promise<void> {
  let left = count;
  await page.route(address, (route: Route) => (left-- > 0 ? route.fulfill(BUSY) : route.continue()));
}

test("a page says that the service does not answer, until it does", async ({ page }) => {
  // A page's routes do not reach a shared worker.
  await page.addInitScript(() => Reflect.deleteProperty(window, "SharedWorker"));
  await page.route(/v1\/events/, (route) => route.abort());
  await page.goto("/");
  const notice = page.getByText(/^The service does not answer/);
  await expect(notice).toBeVisible();
  await expectAccessible(page);
  await page.unroute(/v1\/events/);
  await expect(notice).toBeHidden();
});

test("what a busy service refused is asked for again", async ({ page, service }) => {
  const id = await service.run({ ...QUICK, title: "Wanted", duration_s: 0.1 });
  await busyFor(page, new RegExp(`v1/jobs/${id}$`), 3);
  await busyFor(page, /flow\.bin/, 1);
  await busyFor(page, /trajectory\?/, 2);
  await page.goto(`/#/jobs/${id}`);
  await expect(page.getByText("the service is busy").first()).toBeVisible();
  await expect(page.getByText(/stored at \d+ instants/)).toBeVisible();
  await expect(page.getByRole("region", { name: "Values at the time of the replay" })).toContainText("At 0.000 s");
  await expect(page.getByText("the service is busy")).toHaveCount(0);
});

test("older jobs that cannot be read are not asked for without a pause", async ({ page, service }) => {
  await service.run({ ...QUICK, title: "Listed", duration_s: 0.1 });
  let refused = 0;
  await page.route(/v1\/jobs\?/, async (route) => {
    if (/cursor=/.test(route.request().url())) {
      refused += 1;
      return route.fulfill(BUSY);
    }
    const answer = await route.fetch();
    return route.fulfill({ response: answer, json: { ...(await answer.json()), next_cursor: "older" } });
  });
  await page.goto("/");
  await page.getByRole("button", { name: "Show older jobs" }).scrollIntoViewIfNeeded();
  await expect(page.getByText("the service is busy")).toBeVisible();
  await page.waitForTimeout(2_500);
  expect(refused).toBeGreaterThan(0);
  expect(refused).toBeLessThan(8);
});

test("each view has a title of its own", async ({ page, service }) => {
  const id = await service.run({ ...QUICK, title: "Named", duration_s: 0.1 });
  for (const [address, title] of [
    ["/", "Jobs – Scree"],
    ["/new", "New scenario – Scree"],
    ["/studies", "Studies – Scree"],
    [`/jobs/${id}`, "Named – Scree"],
    [`/compare/${id}/${id}`, "Two jobs compared – Scree"],
  ] as const) {
    await page.goto(`/#${address}`);
    await expect(page).toHaveTitle(title);
  }
});

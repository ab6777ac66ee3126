import { readFile } from "node:fs/promises";
import { expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";
import { STUDY, finished } from "./study-scenes";

let small: string;
test.beforeAll(async ({ service }) => {
  small = await finished(service, STUDY);
});

test("every question has an answer with its interval", async ({ page }) => {
  await page.goto(`/#/studies/${small}`);
  await expect(page.getByRole("heading", { level: 1, name: "Small cube" })).toBeVisible();
  await expect(page.getByText("32 of 32 members finished, 0 failed.")).toBeVisible();
  await expect(page.getByText("So far")).toHaveCount(0);
  const answer = (name: string) => page.getByRole("region", { name, exact: true });
  await expect(answer("Where body 0 comes to rest").getByRole("row", { name: /^90 %/ })).toContainText(
    /% \(.* % to .* %\)/,
  );
  await expect(
    answer("How likely a threshold is exceeded: displacement of body 0").getByRole("row", { name: /^0.05/ }),
  ).toContainText("of 32");
  await expect(answer("Is body 0 buried deeper than 0 m?")).toContainText(/\d % \(0 % to [\d.]+ %\)/);
  await expect(answer("Quantiles: peak speed of body 0").getByRole("row", { name: /^50 %/ })).toContainText(" to ");
  await expect(answer("Mean: run-out of the flow")).toContainText(/m \([\d.]+ m to [\d.]+ m, 95 % interval\)/);
  await expect(
    answer("What it depends on: displacement of body 0").getByRole("row", { name: /channel, base friction/ }),
  ).toContainText("falls with it");
  await expect(page.getByText("Between 0.3 and 0.5, each value as likely.")).toBeVisible();
});

test("the views are accessible and fit small windows in both themes", async ({ page }) => {
  for (const colorScheme of ["light", "dark"] as const) {
    await page.emulateMedia({ colorScheme });
    for (const path of [`/studies/${small}`, "/studies", "/studies/new"]) {
      await page.setViewportSize({ width: 1280, height: 800 });
      await page.goto(`/#${path}`);
      await page.reload();
      await expect(page.getByText(/Files|Members ended|Allowed/).first()).toBeVisible();
      await expectAccessible(page);
      await page.setViewportSize({ width: 360, height: 700 });
      await expectNoSidewaysScroll(page);
      // Pictures are drawn anew for the width.
      const widest = () =>
        page.evaluate(() => {
          const pictures = [...document.querySelectorAll("figure svg")];
          return Math.max(0, ...pictures.map((picture) => picture.getBoundingClientRect().right));
        });
      await expect.poll(widest).toBeLessThanOrEqual(360);
    }
  }
});

test("the map shows every member at its place, to scale", async ({ page, service }) => {
  await page.goto(`/#/studies/${small}`);
  const map = page.getByRole("group", { name: /^Map of where body 0/ });
  await expect(map.locator(".dots a")).toHaveCount(32);
  const { members } = await service.get<{
    members: { member: number; outcome: { finished: { bodies: { rest_m: number[] }[] } } }[];
  }>(`/v1/studies/${small}/members?limit=100`);
  const places = new Map(members.map(({ member, outcome }) => [member, outcome.finished.bodies[0]?.rest_m ?? []]));
  const dots = await map.locator(".dots a").evaluateAll((links) =>
    links.map((link) => {
      const circle = link.querySelector(".place");
      return {
        member: Number(/Member (\d+)/.exec(link.getAttribute("aria-label") ?? "")?.[1]),
        at: ["cx", "cy"].map((name) => Number(circle?.getAttribute(name))),
      };
    }),
  );
  // Metres per pixel are the same along both axes, and y grows upwards.
  const [first, last] = [dots[0], dots.at(-1)];
  const scale =
    ((places.get(last?.member ?? 0)?.[0] ?? 0) - (places.get(first?.member ?? 0)?.[0] ?? 0)) /
    ((last?.at[0] ?? 0) - (first?.at[0] ?? 0));
  for (const { member, at } of dots) {
    const place = places.get(member) ?? [];
    const origin = places.get(first?.member ?? 0) ?? [];
    expect(((at[0] ?? 0) - (first?.at[0] ?? 0)) * scale).toBeCloseTo((place[0] ?? 0) - (origin[0] ?? 0), 4);
    expect(((first?.at[1] ?? 0) - (at[1] ?? 0)) * scale).toBeCloseTo((place[1] ?? 0) - (origin[1] ?? 0), 4);
  }
  await expect(map.locator(".region")).toHaveCount(2);
  await expect(map.locator(".start")).toHaveCount(1);
  const shade = await page.locator("canvas.under").evaluate((canvas: HTMLCanvasElement) =>
    canvas
      .getContext("2d")
      ?.getImageData(0, 0, canvas.width, canvas.height)
      .data.reduce((most, value, place) => (place % 4 === 3 ? Math.max(most, value) : most), 0),
  );
  expect(shade).toBeGreaterThan(150);
});

test("the dots of the map are reached by keyboard, and lead to their jobs", async ({ page }) => {
  await page.goto(`/#/studies/${small}`);
  const dots = page.locator(".dots a");
  await dots.first().focus();
  await page.keyboard.press("ArrowRight");
  await expect(dots.nth(1)).toBeFocused();
  await expect(dots.nth(1)).toHaveAttribute("tabindex", "0");
  await expect(dots.first()).toHaveAttribute("tabindex", "-1");
  await expect(page.locator(".map figcaption")).toContainText(/^Member \d+: x/);
  await page.keyboard.press("End");
  await expect(dots.last()).toBeFocused();
  await page.keyboard.press("Enter");
  await expect(page).toHaveURL(/#\/jobs\/[0-9a-f-]{36}$/);
});

test("the exceedance curve is read at any threshold", async ({ page }) => {
  await page.goto(`/#/studies/${small}`);
  const slider = page.getByRole("slider").first();
  await expect(slider).toBeVisible();
  await slider.press("Home");
  await expect(page.locator("output").first()).toContainText(/exceeds [\d.−]+ m: 100 %/);
  await slider.press("End");
  await expect(page.locator("output").first()).toContainText(/exceeds [\d.]+ m: 0 % \(0 % to/);
});

test("members are sorted by any column, and lead to their jobs", async ({ page }) => {
  await page.goto(`/#/studies/${small}`);
  const table = page.getByRole("region", { name: "Members of the study" });
  const values = () => table.locator("tbody tr td:nth-child(3)").allTextContents();
  await table.getByRole("button", { name: /base friction/ }).click();
  await expect(table.getByRole("columnheader", { name: /base friction/ })).toHaveAttribute("aria-sort", "ascending");
  const ascending = (await values()).map(Number);
  expect(ascending).toEqual([...ascending].sort((a, b) => a - b));
  await table.getByRole("button", { name: /base friction/ }).click();
  await expect(table.getByRole("columnheader", { name: /base friction/ })).toHaveAttribute("aria-sort", "descending");
  expect((await values()).map(Number)).toEqual(ascending.reverse());
  await expect(table.locator("tbody a").first()).toHaveAttribute("href", /#\/jobs\//);
});

test("files are saved by requests that show the token", async ({ page }) => {
  await page.goto(`/#/studies/${small}`);
  await page.evaluate(() => sessionStorage.setItem("scree-token", "anything"));
  for (const [button, beginning] of [
    ["Members as CSV", "member,"],
    ["Regions (GeoJSON)", '{"'],
    ["Quantities against inputs (SVG)", "<svg"],
  ] as const) {
    const [download, request] = await Promise.all([
      page.waitForEvent("download"),
      page.waitForRequest((request) => /members.csv|geojson|scatter/.test(request.url())),
      page.getByRole("button", { name: button }).click(),
    ]);
    expect(request.headers()["authorization"]).toBe("Bearer anything");
    expect(download.suggestedFilename()).toMatch(/^study-[0-9a-f]{8}-/);
    expect((await readFile(await download.path(), "utf8")).slice(0, 40)).toContain(beginning.slice(0, 6));
  }
});

test("hundreds of members are shown without a stutter", async ({ page, service }) => {
  const { members } = await service.get<{
    members: { member: number; outcome: { finished: { bodies: { rest_m: number[] }[] } } }[];
  }>(`/v1/studies/${small}/members?limit=32`);
  await page.route(/\/members\?/, async (route) => {
    const from = Number(new URL(route.request().url()).searchParams.get("from"));
    const page = Array.from({ length: 250 }, (_, place) => ({ ...members[place % 32], member: from + place }));
    await route.fulfill({ json: { members: page, next: from < 750 ? from + 250 : null } });
  });
  await page.goto(`/#/studies/${small}`);
  await expect(page.getByText("1 to 50 of 1000")).toBeVisible();
  await expect(page.locator(".dots a")).toHaveCount(1000);
  await page.evaluate(() => {
    const longest = { ms: 0 };
    Object.assign(window, { longest });
    new PerformanceObserver((list) =>
      list.getEntries().forEach(({ duration }) => (longest.ms = Math.max(longest.ms, duration))),
    ).observe({ type: "longtask" });
  });
  await page.getByRole("button", { name: /base friction/ }).click();
  await page.getByRole("button", { name: "Next" }).click();
  await expect(page.getByText("51 to 100 of 1000")).toBeVisible();
  await page.locator(".dots a").nth(500).hover({ force: true });
  await expect(page.locator(".map figcaption")).toContainText("Member");
  expect(await page.evaluate(() => (window as unknown as { longest: { ms: number } }).longest.ms)).toBeLessThan(300);
});

test("failed members are told with their reason", async ({ page, service }) => {
  const answers = await service.get<Record<string, unknown>>(`/v1/studies/${small}/answers`);
  const counts = { finished: 30, failed: 2, pending: 0, failures: [{ reason: "a body left the grid", members: 2 }] };
  await page.route(/\/answers$/, (route) => route.fulfill({ json: { ...answers, members: counts } }));
  const { members } = await service.get<{ members: Record<string, unknown>[] }>(
    `/v1/studies/${small}/members?limit=32`,
  );
  Object.assign(members[4] ?? {}, { status: "failed", outcome: { failed: { reason: "a body left the grid" } } });
  await page.route(/\/members\?/, (route) => route.fulfill({ json: { members, next: null } }));
  await page.goto(`/#/studies/${small}`);
  await expect(page.getByText("2 failed: a body left the grid")).toBeVisible();
  await expect(page.getByRole("row", { name: /^4 failed/ })).toContainText("a body left the grid");
  await expect(page.locator(".dots a")).toHaveCount(31);
});

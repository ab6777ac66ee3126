import type { Page } from "@playwright/test";
import { readFile } from "node:fs/promises";
import { QUICK, SLOW, type Service, expect, expectAccessible, expectNoSidewaysScroll, test } from "./service";

const SCENE = {
  ...QUICK,
  bodies: [{ shape: { cube: { side_m: 0.03 } }, position: { downstream_m: 0.03 } }],
  numerics: { cell_size_m: 0.02 },
};

const INPUTS = [
  { pointer: "/channel/base_friction", distribution: { uniform: { from: 0.3, to: 0.5 } } },
  { pointer: "/flow/volume_m3", distribution: { lognormal: { median: 0.0006, p95: 0.0008 } } },
  { pointer: "/bodies/0/position/lateral_m", distribution: { uniform: { from: -0.02, to: 0.02 } } },
];

const QUESTIONS = [
  { rest: { body: 0, regions: [0.5, 0.9] } },
  { exceeds: { quantity: "displacement_m", body: 0, thresholds: [0.05, 0.1] } },
  { buried: { body: 0, deeper_than_m: 0 } },
  { quantiles: { quantity: "peak_speed_m_s", body: 0, probabilities: [0.5] } },
  { mean: { quantity: "runout_m" } },
  { sensitivity: { quantity: "displacement_m", body: 0 } },
];

const STUDY = { title: "Small cube", scenario: SCENE, inputs: INPUTS, design: { sobol: { members: 32, seed: 1 } }, questions: QUESTIONS };

/** Submits a study, and waits for its end. */
async function finished(service: Service, study: unknown): Promise<string> {
  const { id } = await service.post<{ id: string }>("/v1/studies", study);
  await expect.poll(async () => (await service.get<{ status: string }>(`/v1/studies/${id}`)).status, { timeout: 50_000 }).toBe("successful");
  return id;
}

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
  await expect(answer("Where body 0 comes to rest").getByRole("row", { name: /^90 %/ })).toContainText(/% \(.* % to .* %\)/);
  await expect(answer("How likely a threshold is exceeded: displacement of body 0").getByRole("row", { name: /^0.05/ })).toContainText("of 32");
  await expect(answer("Is body 0 buried deeper than 0 m?")).toContainText(/\d % \(0 % to [\d.]+ %\)/);
  await expect(answer("Quantiles: peak speed of body 0").getByRole("row", { name: /^50 %/ })).toContainText(" to ");
  await expect(answer("Mean: run-out of the flow")).toContainText(/m \([\d.]+ m to [\d.]+ m, 95 % interval\)/);
  await expect(answer("What it depends on: displacement of body 0").getByRole("row", { name: /channel, base friction/ })).toContainText("falls with it");
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
    }
  }
});

test("the map shows every member at its place, to scale", async ({ page, service }) => {
  await page.goto(`/#/studies/${small}`);
  const map = page.getByRole("group", { name: /^Map of where body 0/ });
  await expect(map.locator(".dots a")).toHaveCount(32);
  const { members } = await service.get<{ members: { member: number; outcome: { finished: { bodies: { rest_m: number[] }[] } } }[] }>(`/v1/studies/${small}/members?limit=100`);
  const places = new Map(members.map(({ member, outcome }) => [member, outcome.finished.bodies[0]?.rest_m ?? []]));
  const dots = await map.locator(".dots a").evaluateAll((links) =>
    links.map((link) => {
      const circle = link.querySelector(".place");
      return { member: Number(/Member (\d+)/.exec(link.getAttribute("aria-label") ?? "")?.[1]), at: ["cx", "cy"].map((name) => Number(circle?.getAttribute(name))) };
    }),
  );
  // Metres per pixel are the same along both axes, and y grows upwards.
  const [first, last] = [dots[0], dots.at(-1)];
  const scale = ((places.get(last?.member ?? 0)?.[0] ?? 0) - (places.get(first?.member ?? 0)?.[0] ?? 0)) / ((last?.at[0] ?? 0) - (first?.at[0] ?? 0));
  for (const { member, at } of dots) {
    const place = places.get(member) ?? [];
    const origin = places.get(first?.member ?? 0) ?? [];
    expect(((at[0] ?? 0) - (first?.at[0] ?? 0)) * scale).toBeCloseTo((place[0] ?? 0) - (origin[0] ?? 0), 4);
    expect(((first?.at[1] ?? 0) - (at[1] ?? 0)) * scale).toBeCloseTo((place[1] ?? 0) - (origin[1] ?? 0), 4);
  }
  await expect(map.locator(".region")).toHaveCount(2);
  await expect(map.locator(".start")).toHaveCount(1);
  const shade = await page.locator("canvas.under").evaluate((canvas: HTMLCanvasElement) =>
    canvas.getContext("2d")?.getImageData(0, 0, canvas.width, canvas.height).data.reduce((most, value, place) => (place % 4 === 3 ? Math.max(most, value) : most), 0),
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

test("a running study is marked as such, follows its members, and is dismissed and removed", async ({ page, service }) => {
  const slow = { ...STUDY, title: "Slow members", scenario: { ...SLOW, bodies: SCENE.bodies, numerics: { cell_size_m: 0.006 } } };
  const { id } = await service.post<{ id: string }>("/v1/studies", slow);
  await page.goto(`/#/studies/${id}`);
  await expect(page.getByText("So far: 0 of 32 members. This is not the final answer.").first()).toBeVisible();
  await expect(page.getByText(/So far: [1-9]\d* of 32 members\. This/).first()).toBeVisible({ timeout: 40_000 });
  await page.getByRole("button", { name: "Dismiss …" }).click();
  await expect(page.getByRole("button", { name: "Yes, dismiss it" })).toBeFocused();
  await page.keyboard.press("Enter");
  await expect(page.locator("header .status")).toHaveText("dismissed");
  await expect(page.getByText("This is not the final answer")).toHaveCount(0);
  await page.getByRole("button", { name: "Remove …" }).click();
  await page.getByRole("button", { name: "Yes, remove it" }).click();
  await expect(page).toHaveURL(/#\/studies$/);
  await expect(page.getByRole("link", { name: "Slow members" })).toHaveCount(0);
});

test("a running study is asked for at most every two seconds, with its tag", async ({ page, service }) => {
  const asked: { at: number; tag: string | undefined }[] = [];
  page.on("request", (request) => {
    if (request.url().endsWith("/answers")) asked.push({ at: Date.now(), tag: request.headers()["if-none-match"] });
  });
  const { id } = await service.post<{ id: string }>("/v1/studies", { ...STUDY, title: "Busy", design: { sobol: { members: 64, seed: 7 } } });
  await page.goto(`/#/studies/${id}`);
  await expect(page.getByText("64 of 64 members finished, 0 failed.")).toBeVisible({ timeout: 50_000 });
  await expect(page.getByText("So far")).toHaveCount(0);
  expect(asked.length).toBeGreaterThan(2);
  for (const [place, { at, tag }] of asked.entries()) {
    if (place === 0) continue;
    expect(at - (asked[place - 1]?.at ?? 0)).toBeGreaterThan(1_900);
    expect(tag).toMatch(/^W\//);
  }
});

test("a study is enlarged, and a change that is not allowed is told", async ({ page, service }) => {
  const id = await finished(service, { ...STUDY, title: "Grows", design: { sobol: { members: 8, seed: 5 } } });
  await page.goto(`/#/studies/${id}`);
  await page.getByText("Enlarge or change this study").click();
  const number = page.getByRole("spinbutton", { name: /^Members/ });
  await number.fill("12");
  await page.getByRole("button", { name: "Enlarge", exact: true }).click();
  await expect(page.getByRole("alert")).toContainText("/design/sobol/members");
  await number.fill("16");
  await page.getByRole("button", { name: "Enlarge", exact: true }).click();
  await expect(page.getByText("16 of 16 members finished, 0 failed.")).toBeVisible({ timeout: 40_000 });
});

test("elementary effects have their size, spread and direction", async ({ page, service }) => {
  const design = { morris: { trajectories: 4, levels: 4, seed: 1 } };
  const id = await finished(service, { ...STUDY, title: "Screening", design, questions: [QUESTIONS[5]] });
  await page.goto(`/#/studies/${id}`);
  const row = page.getByRole("region", { name: "What displacement of body 0 depends on" }).getByRole("row", { name: /base friction/ });
  await expect(row).toContainText("falls with it");
  await expect(page.getByRole("columnheader", { name: /μ\*/ })).toBeVisible();
});

test("levels of cells are shown, and members on each", async ({ page, service }) => {
  const id = await finished(service, { ...STUDY, title: "Levels", design: { sobol: { members: 16, seed: 2 } }, finer_levels: [{ cell_size_m: 0.014, members: 8 }] });
  await page.goto(`/#/studies/${id}`);
  await expect(page.getByRole("region", { name: "Levels of cells", exact: true }).first().getByRole("row", { name: /^0.014/ })).toContainText("8");
  await expect(page.getByText("The dots are resting places in the coarsest cells")).toBeVisible();
  await page.getByRole("combobox", { name: "Level of cells" }).selectOption("1");
  await expect(page.getByText("1 to 8 of 8")).toBeVisible();
});

test("hundreds of members are shown without a stutter", async ({ page, service }) => {
  const { members } = await service.get<{ members: { member: number; outcome: { finished: { bodies: { rest_m: number[] }[] } } }[] }>(`/v1/studies/${small}/members?limit=32`);
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
    new PerformanceObserver((list) => list.getEntries().forEach(({ duration }) => (longest.ms = Math.max(longest.ms, duration)))).observe({ type: "longtask" });
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
  const { members } = await service.get<{ members: Record<string, unknown>[] }>(`/v1/studies/${small}/members?limit=32`);
  Object.assign(members[4] ?? {}, { status: "failed", outcome: { failed: { reason: "a body left the grid" } } });
  await page.route(/\/members\?/, (route) => route.fulfill({ json: { members, next: null } }));
  await page.goto(`/#/studies/${small}`);
  await expect(page.getByText("2 failed: a body left the grid")).toBeVisible();
  await expect(page.getByRole("row", { name: /^4 failed/ })).toContainText("a body left the grid");
  await expect(page.locator(".dots a")).toHaveCount(31);
});

test("what is not there is told", async ({ page }) => {
  await page.goto("/#/studies/01a22c1d-dc5d-75a3-bd57-c20d2c23ea3e");
  await expect(page.getByRole("alert")).toContainText("there is no study");
  await page.getByRole("link", { name: "All studies" }).click();
  await expect(page.getByRole("heading", { name: "Studies", level: 1 })).toBeVisible();
});

test("the list has pages, and a filter by state", async ({ page }) => {
  const asked: string[] = [];
  const study = (title: string) => ({ id: small, status: "running", title, created: "2026-01-01T00:00:00Z", finished: null, members: 8, members_made: 4, members_ended: 2 });
  await page.route(/\/v1\/studies\?/, (route) => {
    const { searchParams } = new URL(route.request().url());
    asked.push(searchParams.toString());
    const isSecond = searchParams.get("cursor") === "s1";
    return route.fulfill({ json: { studies: [study(isSecond ? "Older one" : "Newer one")], next_cursor: isSecond ? null : "s1" } });
  });
  await page.goto("/#/studies");
  await expect(page.getByRole("row", { name: /Newer one/ })).toContainText("2 of 8");
  await page.getByRole("button", { name: "Older" }).click();
  await expect(page.getByRole("link", { name: "Older one" })).toBeVisible();
  await expect(page.getByRole("button", { name: "Older" })).toBeDisabled();
  await page.getByRole("button", { name: "Newer" }).click();
  await expect(page.getByRole("link", { name: "Newer one" })).toBeVisible();
  await page.getByRole("combobox", { name: "State" }).selectOption("failed");
  await expect.poll(() => asked.at(-1)).toContain("status=failed");
});

async function write(page: Page, study: unknown): Promise<void> {
  await page.getByRole("textbox", { name: "The study, as JSON" }).fill(typeof study === "string" ? study : JSON.stringify(study, null, 2));
}

test("a new study is checked while it is written, and submitted once", async ({ page, service }) => {
  await page.goto("/#/studies/new");
  await expect(page.getByText("Allowed. Nothing is stored yet.")).toBeVisible();
  await expect(page.locator(".plan")).toContainText(/with 256 independent members/);
  await write(page, "{");
  await expect(page.getByText("This is not JSON yet")).toBeVisible();
  await expect(page.getByRole("button", { name: "Submit the study" })).toBeDisabled();
  await write(page, { ...STUDY, inputs: [{ pointer: "/channel/base_friction", distribution: { uniform: { from: 0.3, to: -1 } } }] });
  await page.getByRole("button", { name: /^\/inputs\/0/ }).first().click();
  const selected = await page.getByRole("textbox").evaluate((editor: HTMLTextAreaElement) => editor.value.slice(editor.selectionStart, editor.selectionEnd));
  expect(selected).toContain("-1");
  await write(page, { ...STUDY, title: "Written here", design: { sobol: { members: 8, seed: 9 } } });
  const [request] = await Promise.all([
    page.waitForRequest((request) => request.method() === "POST" && request.url().endsWith("/v1/studies")),
    page.getByRole("button", { name: "Submit the study" }).click(),
  ]);
  expect(request.headers()["idempotency-key"]).toMatch(/^[0-9a-f]{32}$/);
  await expect(page.getByRole("heading", { level: 1, name: "Written here" })).toBeVisible();
  const { studies } = await service.get<{ studies: { title: string }[] }>("/v1/studies");
  expect(studies.filter(({ title }) => title === "Written here")).toHaveLength(1);
});

test("a service that is too busy is told", async ({ page }) => {
  const problem = { type: "urn:scree:problem:studies-full", title: "Too many studies run", status: 429, detail: "8 studies run" };
  await page.route(/\/v1\/studies$/, (route) => route.fulfill({ status: 429, contentType: "application/problem+json", json: problem }));
  await page.goto("/#/studies/new");
  await page.getByRole("button", { name: "Submit the study" }).click();
  await expect(page.getByRole("alert")).toContainText("8 studies run");
  await expect(page.getByRole("button", { name: "Submit the study" })).toBeEnabled();
});

import type { Page } from "@playwright/test";
import { SLOW, expect, test } from "./service";
import { QUESTIONS, SCENE, STUDY, finished } from "./study-scenes";

test("a running study is marked as such, follows its members, and is dismissed and removed", async ({
  page,
  service,
}) => {
  const slow = {
    ...STUDY,
    title: "Slow members",
    scenario: { ...SLOW, bodies: SCENE.bodies, numerics: { cell_size_m: 0.006 } },
  };
  const { id } = await service.post<{ id: string }>("/v1/studies", slow);
  await page.goto(`/#/studies/${id}`);
  await expect(page.getByText("So far: 0 of 32 members. This is not the final answer.").first()).toBeVisible();
  await expect(page.getByText(/So far: [1-9]\d* of 32 members\. This/).first()).toBeVisible({ timeout: 40_000 });
  await expect(page.locator(".chart .line").first()).toBeVisible();
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
  const { id } = await service.post<{ id: string }>("/v1/studies", {
    ...STUDY,
    title: "Busy",
    design: { sobol: { members: 64, seed: 7 } },
  });
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
  const row = page
    .getByRole("region", { name: "What displacement of body 0 depends on" })
    .getByRole("row", { name: /base friction/ });
  await expect(row).toContainText("falls with it");
  await expect(page.getByRole("columnheader", { name: /μ\*/ })).toBeVisible();
});

test("levels of cells are shown, and members on each", async ({ page, service }) => {
  const id = await finished(service, {
    ...STUDY,
    title: "Levels",
    design: { sobol: { members: 16, seed: 2 } },
    finer_levels: [{ cell_size_m: 0.014, members: 8 }],
  });
  await page.goto(`/#/studies/${id}`);
  await expect(
    page
      .getByRole("region", { name: "Levels of cells", exact: true })
      .first()
      .getByRole("row", { name: /^0.014/ }),
  ).toContainText("8");
  await expect(page.getByText("The dots are resting places in the coarsest cells")).toBeVisible();
  await page.getByRole("combobox", { name: "Level of cells" }).selectOption("1");
  await expect(page.getByText("1 to 8 of 8")).toBeVisible();
});

test("what is not there is told", async ({ page }) => {
  await page.goto("/#/studies/01a22c1d-dc5d-75a3-bd57-c20d2c23ea3e");
  await expect(page.getByRole("alert")).toContainText("there is no study");
  await page.getByRole("link", { name: "All studies" }).click();
  await expect(page.getByRole("heading", { name: "Studies", level: 1 })).toBeVisible();
});

test("the list has pages, and a filter by state", async ({ page }) => {
  const asked: string[] = [];
  const study = (title: string) => ({
    id: "01a22c1d-dc5d-75a3-bd57-c20d2c23ea3e",
    status: "running",
    title,
    created: "2026-01-01T00:00:00Z",
    finished: null,
    members: 8,
    members_made: 4,
    members_ended: 2,
  });
  await page.route(/\/v1\/studies\?/, (route) => {
    const { searchParams } = new URL(route.request().url());
    asked.push(searchParams.toString());
    const isSecond = searchParams.get("cursor") === "s1";
    return route.fulfill({
      json: { studies: [study(isSecond ? "Older one" : "Newer one")], next_cursor: isSecond ? null : "s1" },
    });
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
  await page
    .getByRole("textbox", { name: "The study, as JSON" })
    .fill(typeof study === "string" ? study : JSON.stringify(study, null, 2));
}

test("a new study is checked while it is written, and submitted once", async ({ page, service }) => {
  await page.goto("/#/studies/new");
  await expect(page.getByText("Allowed. Nothing is stored yet.")).toBeVisible();
  await expect(page.locator(".plan")).toContainText(/with 256 independent members/);
  await write(page, "{");
  await expect(page.getByText("This is not JSON yet")).toBeVisible();
  await expect(page.getByRole("button", { name: "Submit the study" })).toBeDisabled();
  await write(page, {
    ...STUDY,
    inputs: [{ pointer: "/channel/base_friction", distribution: { uniform: { from: 0.3, to: -1 } } }],
  });
  await page
    .getByRole("button", { name: /^\/inputs\/0/ })
    .first()
    .click();
  const selected = await page
    .getByRole("textbox")
    .evaluate((editor: HTMLTextAreaElement) => editor.value.slice(editor.selectionStart, editor.selectionEnd));
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
  const problem = {
    type: "urn:scree:problem:studies-full",
    title: "Too many studies run",
    status: 429,
    detail: "8 studies run",
  };
  await page.route(/\/v1\/studies$/, (route) =>
    route.fulfill({ status: 429, contentType: "application/problem+json", json: problem }),
  );
  await page.goto("/#/studies/new");
  await page.getByRole("button", { name: "Submit the study" }).click();
  await expect(page.getByRole("alert")).toContainText("8 studies run");
  await expect(page.getByRole("button", { name: "Submit the study" })).toBeEnabled();
});

/** Tests of the page with a service of their own and a new database. */

import AxeBuilder from "@axe-core/playwright";
import { type Page, test as base, expect } from "@playwright/test";
import { type ChildProcess, spawn } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Program whose service is tested. */
export const BINARY = process.env["SCREE_BINARY"] ?? "../target/debug/scree";

/** A running service. */
export class Service {
  private constructor(
    readonly url: string,
    private readonly child: ChildProcess,
    private readonly folder: string,
  ) {}

  /** Starts a service with these options beside those of every test, and these settings (`SCREE_…`). */
  static async start(options: string[] = [], settings: Record<string, string> = {}): Promise<Service> {
    const folder = await mkdtemp(join(tmpdir(), "scree-page-"));
    const listen = ["--listen", "127.0.0.1:0", "--database", join(folder, "scree.db")];
    const child = spawn(BINARY, ["serve", ...listen, ...options], {
      stdio: ["ignore", "pipe", "ignore"],
      env: { ...process.env, ...settings },
    });
    const url = await new Promise<string>((resolve, reject) => {
      let text = "";
      child.stdout.on("data", (piece: Buffer) => {
        text += piece.toString();
        const found = /http:\/\/[\d.:]+/.exec(text);
        if (found) resolve(found[0]);
      });
      child.on("error", reject);
      child.on("exit", (code) => reject(new Error(`the service ended with code ${code}`)));
    });
    return new Service(url, child, folder);
  }

  /** Processor time that the service has used so far [s]. */
  async processorTime(): Promise<number> {
    const stat = await readFile(`/proc/${this.child.pid}/stat`, "utf8");
    const [user, system] = stat.slice(stat.lastIndexOf(")")).split(" ").slice(12, 14).map(Number);
    // In hundredths of a second, on every Linux.
    return ((user ?? NaN) + (system ?? NaN)) / 100;
  }

  /** Requests that the service has answered so far. */
  async requests(): Promise<number> {
    const text = await (await fetch(`${this.url}/metrics`)).text();
    return Number(/^scree_request_seconds_count (\d+)/m.exec(text)?.[1]);
  }

  async stop(): Promise<void> {
    const ended = new Promise((resolve) => this.child.once("exit", resolve));
    this.child.kill("SIGTERM");
    await ended;
    await rm(this.folder, { recursive: true });
  }

  /** Sends a document, and returns the answer's. */
  async post<T>(path: string, document: unknown): Promise<T> {
    const headers = { "Content-Type": "application/json" };
    const answer = await fetch(this.url + path, { method: "POST", headers, body: JSON.stringify(document) });
    if (!answer.ok) throw new Error(`${path}: ${answer.status} ${await answer.text()}`);
    return (await answer.json()) as T;
  }

  async get<T>(path: string): Promise<T> {
    const answer = await fetch(this.url + path);
    if (!answer.ok) throw new Error(`${path}: ${answer.status} ${await answer.text()}`);
    return (await answer.json()) as T;
  }

  /** Submits a scenario, and returns the identifier of its job. */
  async submit(scenario: unknown): Promise<string> {
    return (await this.post<{ id: string }>("/v1/jobs", scenario)).id;
  }

  /** Submits a scenario, and waits until its job has succeeded. */
  async run(scenario: unknown): Promise<string> {
    const id = await this.submit(scenario);
    for (;;) {
      const { status } = await this.get<{ status: string }>(`/v1/jobs/${id}?wait=30s`);
      if (status === "successful") return id;
      if (status === "failed" || status === "dismissed") throw new Error(`job ${id} ${status}`);
    }
  }
}

/** A scene that is computed within about a second: a cube hit by a small flow. */
export const QUICK = {
  title: "Quick",
  channel: { inclination_deg: 45, incline_length_m: 0.3, runout_length_m: 0.4, width_m: 0.1 },
  flow: { volume_m3: 0.0006, release: { height_m: 0.05, toe_distance_m: 0.02 } },
  bodies: [{ shape: { cube: { side_m: 0.03 } } }],
  duration_s: 0.6,
  numerics: { cell_size_m: 0.015 },
};

/** A scene that is computed for minutes, to be watched and dismissed. */
export const SLOW = { ...QUICK, title: "Slow", numerics: { cell_size_m: 0.002 } };

/** A scenario of `configs/scenarios`. */
export async function scenario(name: string): Promise<Record<string, unknown>> {
  return JSON.parse(await readFile(`../configs/scenarios/${name}.json`, "utf8")) as Record<string, unknown>;
}

/** Tests with a running service, whose page is the base of all addresses; a message of the
 * browser about an error or a refusal by the page's policy fails the test. */
export const test = base.extend<{ quiet: void }, { service: Service }>({
  service: [
    async ({}, use) => {
      const service = await Service.start();
      await use(service);
      await service.stop();
    },
    { scope: "worker" },
  ],
  baseURL: async ({ service }, use) => use(service.url),
  quiet: [
    async ({ page }, use) => {
      const errors: string[] = [];
      page.on("pageerror", (error) => errors.push(String(error)));
      page.on("console", (message) => {
        // An answer that is no success is shown by the page itself.
        if (message.type() === "error" && !message.text().startsWith("Failed to load resource"))
          errors.push(message.text());
      });
      page.on("request", (request) => {
        if (!/^(http:\/\/127\.0\.0\.1|data:|blob:)/.test(request.url())) errors.push(`asked ${request.url()}`);
      });
      await use();
      expect(errors).toEqual([]);
    },
    { auto: true },
  ],
});

export { expect };

/** Checks the shown view with axe-core: no serious or critical finding. */
export async function expectAccessible(page: Page): Promise<void> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
  expect(serious.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`)).toEqual([]);
}

/** Checks that nothing is wider than the window. */
export async function expectNoSidewaysScroll(page: Page): Promise<void> {
  const { scrollWidth, clientWidth } = await page.evaluate(() => {
    const { scrollWidth, clientWidth } = document.documentElement;
    return { scrollWidth, clientWidth };
  });
  expect(scrollWidth).toBeLessThanOrEqual(clientWidth);
}

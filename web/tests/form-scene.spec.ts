/** What is drawn lies where the service puts it. */

import type { Contract } from "../src/api/client";
import type { Json, JsonObject } from "../src/parts/json-document";
import { asking, editedDocument, withItem } from "../src/form/editing";
import { framesOf } from "../src/form/frame";
import { type Scene, sceneOf } from "../src/scenario/scene";
import { type Schemas, kindOf, resolved, schemaAt, withoutDefaults } from "../src/scenario/schema";
import { described, fieldName, labelOf, placeholderOf, rangeOf } from "../src/form/words";
import { QUICK, type Service, expect, scenario, test } from "./service";

async function schemasOf(service: Service): Promise<Schemas> {
  return (await service.get<Contract>("/openapi.json")).components.schemas;
}

const SHAPES: [string, JsonObject][] = [
  ["cube", { cube: { side_m: 0.1 } }],
  ["box", { box: { sides_m: [0.1, 0.06, 0.04] } }],
  ["ball", { ball: { radius_m: 0.05 } }],
  ["capsule", { capsule: { radius_m: 0.02, length_m: 0.1 } }],
  ...["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"].map((solid): [string, JsonObject] => [
    `regular ${solid}`,
    { regular: { solid, size_m: 0.05 } },
  ]),
];

/** Bodies over a channel of this inclination, none of which is where it may be. */
function bodies(inclination: number, position: JsonObject): JsonObject {
  const turns: JsonObject[] = [{}, { yaw_deg: 25 }, { orientation: [0.9, 0.3, 0.1, Math.sqrt(1 - 0.81 - 0.1)] }];
  const list = SHAPES.flatMap(([, shape]) => turns.map((turn) => ({ shape, position, ...turn })));
  return {
    channel: { inclination_deg: inclination, incline_length_m: 2, runout_length_m: 2, width_m: 4 },
    flow: null,
    bodies: list,
  };
}

/** Bounds that the service gives for a field of each body. */
async function boundsOf(service: Service, document: JsonObject, key: string): Promise<Map<number, number[]>> {
  const answer = await fetch(`${service.url}/v1/plans`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(document),
  });
  const { errors } = (await answer.json()) as { errors: { pointer: string; allowed: string }[] };
  const own = errors.filter(({ pointer }) => pointer.endsWith(`/position/${key}`));
  return new Map(
    own.map(({ pointer, allowed }) => [
      Number(pointer.split("/")[2]),
      (allowed.match(/-?\d+(\.\d+)?/g) ?? []).map(Number),
    ]),
  );
}

function reachOf(scene: Scene, index: number, axis: 0 | 1): [number, number] {
  const { core, centre, solid } = scene.bodies[index]!;
  const places = core.map((vertex) => vertex[axis] - centre[axis]);
  return [Math.min(...places) - solid.radius, Math.max(...places) + solid.radius];
}

test("bodies reach as far downstream and across as the service says", async ({ service }) => {
  const schemas = await schemasOf(service);
  for (const [key, axis] of [
    ["downstream_m", 0],
    ["lateral_m", 1],
  ] as const) {
    const document = bodies(0, { [key]: 99 });
    const scene = sceneOf(document, schemas)!;
    const bounds = await boundsOf(service, document, key);
    expect(bounds.size).toBe(3 * SHAPES.length);
    for (const [index, [low = 0, high = 0]] of bounds) {
      const [back, front] = reachOf(scene, index, axis);
      expect.soft(low, SHAPES[Math.floor(index / 3)]?.[0]).toBeCloseTo(-2 - back, 5);
      expect.soft(high, SHAPES[Math.floor(index / 3)]?.[0]).toBeCloseTo(2 - front, 5);
    }
  }
});

test("a body over the foot of the incline needs the elevation that its drawing needs", async ({ service }) => {
  const schemas = await schemasOf(service);
  const document = bodies(45, { downstream_m: 0.002 });
  const scene = sceneOf(document, schemas)!;
  const bounds = await boundsOf(service, document, "elevation_m");
  expect(bounds.size).toBeGreaterThan(SHAPES.length);
  const r = Math.SQRT1_2;
  for (const [index, [least = 0]] of bounds) {
    const { core, centre, solid } = scene.bodies[index]!;
    const depth = Math.max(...core.map(([x, , z]) => solid.radius - r * (x + z)));
    expect.soft(least, SHAPES[Math.floor(index / 3)]?.[0]).toBeCloseTo(centre[2] + depth / r, 5);
  }
});

test("a body on the incline is turned with it, and touches it", async ({ service }) => {
  const schemas = await schemasOf(service);
  const scene = sceneOf(bodies(30, { downstream_m: -1 }), schemas)!;
  const normal = [0.5, 0, Math.cos(Math.PI / 6)];
  for (const { core, solid } of scene.bodies) {
    const heights = core.map(([x, , z]) => x * normal[0]! + z * normal[2]! - solid.radius);
    expect(Math.min(...heights)).toBeCloseTo(0, 9);
  }
  const cube = scene.bodies[0]!;
  expect(cube.centre[2]).toBeCloseTo(Math.tan(Math.PI / 6) + 0.05 / Math.cos(Math.PI / 6), 9);
});

test("a polyhedron is drawn about its centre of mass", async ({ service }) => {
  const schemas = await schemasOf(service);
  const vertices_m = [
    [5, 5, 5],
    [5.04, 5, 5],
    [5, 5.04, 5],
    [5, 5, 5.04],
  ];
  const document: JsonObject = {
    ...((await scenario("minimal")) as JsonObject),
    bodies: [{ shape: { polyhedron: { vertices_m } } }],
  };
  const [body] = sceneOf(document, schemas)!.bodies;
  expect(body?.centre[0]).toBeCloseTo(0.04 * Math.SQRT2, 9);
  expect(body?.centre[2]).toBeCloseTo(0.01, 9);
  const flat: JsonObject = {
    ...document,
    bodies: [{ shape: { polyhedron: { vertices_m: vertices_m.map(([x = 0, y = 0]) => [x, y, 0]) } } }],
  };
  expect(sceneOf(flat, schemas)?.missing).toEqual([0]);
});

test("the release has the volume and the thickness of the scenario", async ({ service }) => {
  const schemas = await schemasOf(service);
  const { release, channel } = sceneOf((await scenario("minimal")) as JsonObject, schemas)!;
  expect(release?.front).toBe(-0.05);
  expect((release!.front - release!.back) * release!.vertical * channel.width).toBeCloseTo(0.01, 12);
  expect(release!.vertical * Math.cos(channel.inclination)).toBeCloseTo(0.15, 12);
  const { side, top } = framesOf(sceneOf((await scenario("minimal")) as JsonObject, schemas)!, "channel", 700);
  expect(side.scale).toBe(top.scale);
});

test("an incomplete scenario has no scene, and odd values break nothing", async ({ service }) => {
  const schemas = await schemasOf(service);
  const minimal = (await scenario("minimal")) as JsonObject;
  const odd: [string, Json][] = [
    ["/channel/inclination_deg", "4x"],
    ["/channel", 5],
    ["/channel/width_m", -1],
    ["/channel/inclination_deg", 95],
  ];
  for (const [pointer, value] of odd)
    expect(sceneOf(editedDocument(minimal, pointer, value, schemas), schemas)).toBeUndefined();
  for (const value of [
    5,
    "x",
    [null, 3, "x", { shape: 5 }, { shape: { cube: null } }, { shape: { moon: {} } }],
    [{ shape: { toString: {} } }, { shape: { regular: { solid: "constructor", size_m: 1 } } }],
  ] as Json[]) {
    expect(sceneOf({ ...minimal, bodies: value }, schemas)?.bodies).toEqual([]);
  }
  expect(sceneOf({ ...minimal, flow: null }, schemas)?.release).toBeUndefined();
});

test("a job's scenario without its defaults is what was submitted, but for computed ones", async ({ service }) => {
  const schemas = await schemasOf(service);
  const id = await service.submit(QUICK);
  const job = await service.get<{ scenario: JsonObject }>(`/v1/jobs/${id}`);
  const root = resolved({ $ref: "#/components/schemas/Scenario" }, schemas);
  const plain = withoutDefaults(job.scenario, root, schemas) as JsonObject;
  const [body] = plain["bodies"] as JsonObject[];
  expect(Object.keys(body!).sort()).toEqual(["position", "shape", "sphero_radius_m"]);
  expect({ ...plain, bodies: QUICK.bodies }).toEqual(QUICK);
});

test("emptied objects go unless they must be there", async ({ service }) => {
  const schemas = await schemasOf(service);
  expect(editedDocument(QUICK as JsonObject, "/numerics/cell_size_m", undefined, schemas)).not.toHaveProperty(
    "numerics",
  );
  const shapeless = editedDocument(QUICK as JsonObject, "/bodies/0/shape/cube/side_m", undefined, schemas);
  expect(shapeless["bodies"]).toEqual([{ shape: { cube: {} } }]);
});

test("a target chooses the cells, and is taken away without a trace", async ({ service }) => {
  const schemas = await schemasOf(service);
  const asked = asking(QUICK as JsonObject, 0.05, schemas);
  expect(asked).not.toHaveProperty("numerics");
  expect(asked["accuracy"]).toEqual({ target: 0.05, quantity: "displacement_m" });
  expect(asking(asked, "off", schemas)).not.toHaveProperty("accuracy");
  expect(asking({ ...QUICK, bodies: [] } as JsonObject, 0.05, schemas)["accuracy"]).toEqual({
    target: 0.05,
    quantity: "runout_m",
  });
});

test("a further body stands clear of the others", async ({ service }) => {
  const schemas = await schemasOf(service);
  let document = (await scenario("minimal")) as JsonObject;
  for (let round = 0; round < 4; round += 1) {
    const list = document["bodies"] as Json[];
    document = {
      ...document,
      bodies: withItem(list, round % 2 === 0 ? 0 : undefined, "Body", sceneOf(document, schemas)),
    };
  }
  await service.post("/v1/plans", document);
});

test("labels, ranges and defaults come from the schema", async ({ service }) => {
  const schemas = await schemasOf(service);
  const document = (await scenario("minimal")) as JsonObject;
  const schema = (pointer: string) => schemaAt(pointer, document, schemas)!;
  expect(labelOf("bulk_density_kg_m3", "kg/m³")).toBe("Bulk density");
  expect(labelOf("angular_velocity_rad_s", "rad/s")).toBe("Angular velocity");
  expect(fieldName("/bodies/0/shape/cube/side_m", document, schemas)).toBe("Body 0 › Shape › Cube › Side");
  expect(placeholderOf(schema("/channel/base_friction"), false)).toBe("default: 0.4");
  expect(placeholderOf(schema("/numerics/cell_size_m"), false)).toBe("automatic");
  expect(described(schema("/duration_s")).fallback).toMatch(/^twice the time/);
  expect(described(schema("/duration_s")).help).not.toContain("[s]");
  expect(rangeOf(schema("/channel/inclination_deg"))).toBe("0 to 89");
  expect(rangeOf(schema("/numerics/courant"))).toBe("above 0, at most 0.9");
});

test("every field of the contract has a kind", async ({ service }) => {
  const schemas = await schemasOf(service);
  const kinds = (name: string) =>
    Object.fromEntries(
      Object.entries(schemas[name]?.properties ?? {}).map(([key, schema]) => [
        key,
        kindOf(resolved(schema, schemas), schemas),
      ]),
    );
  expect(kinds("Scenario")).toMatchObject({
    channel: "object",
    flow: "object",
    bodies: "list",
    duration_s: "number",
    title: "text",
  });
  expect(kinds("Body")).toMatchObject({
    shape: "variants",
    motion: "variants",
    velocity_m_s: "vector",
    orientation: "vector",
    fixed: "flag",
  });
  expect(kinds("Numerics")).toMatchObject({ precision: "names", threads: "number" });
  expect(kinds("Polyhedron")).toEqual({ vertices_m: "json" });
});

import { expect, test } from "@playwright/test";
import { solidOf } from "../src/scenario/solid";
import { outlineFromAbove } from "../src/geometry/outline";
import { type Surface, surfaceOf } from "../src/geometry/surface";
import { type Vector, cross, dot, length, minus } from "../src/geometry/vectors";

const extent = (values: number[]) => Math.max(...values) - Math.min(...values);
const along = ({ positions }: Surface, axis: number) => positions.filter((_, place) => place % 3 === axis);

test("a rounded cube has its width and the volume of the rounded solid", () => {
  const [side, r] = [0.04, 0.004];
  const cube = surfaceOf({ shape: { cube: { side_m: side } }, sphero_radius_m: r });
  for (const axis of [0, 1, 2]) expect(extent(along(cube, axis))).toBeCloseTo(side, 12);
  const a = side - 2 * r;
  const exact = a ** 3 + 6 * a * a * r + 3 * a * Math.PI * r * r + (4 / 3) * Math.PI * r ** 3;
  expect(cube.volume / exact).toBeGreaterThan(0.995);
  expect(cube.volume / exact).toBeLessThanOrEqual(1);
});

test("all surfaces are closed and look outwards", () => {
  const shapes = [
    { box: { sides_m: [0.04, 0.02, 0.03] } },
    ...["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"].map((solid) => ({
      regular: { solid, size_m: 0.03 },
    })),
    {
      polyhedron: {
        vertices_m: [
          [10, 0, 0],
          [10.05, 0, 0],
          [10.05, 0.03, 0],
          [10, 0.03, 0],
          [10.01, 0.005, 0.02],
          [10.04, 0.005, 0.025],
        ],
      },
    },
    { ball: { radius_m: 0.02 } },
    { capsule: { radius_m: 0.01, length_m: 0.06 } },
  ];
  for (const shape of shapes) {
    const surface = surfaceOf({ shape, sphero_radius_m: 0.001 });
    const at = (place: number) => surface.positions.slice(3 * place, 3 * place + 3) as unknown as Vector;
    let flux: Vector = [0, 0, 0];
    let least = Infinity;
    for (let k = 0; k < surface.triangles.length; k += 3) {
      const [a, b, c] = surface.triangles.slice(k, k + 3).map(at) as [Vector, Vector, Vector];
      const area = cross(minus(b, a), minus(c, a));
      least = Math.min(least, dot(area, a));
      flux = [flux[0] + area[0], flux[1] + area[1], flux[2] + area[2]];
    }
    // About the centre of mass of a convex body every face looks away, but for slivers along an arc.
    expect(least, JSON.stringify(shape)).toBeGreaterThan(-1e-3 * surface.volume);
    // The sum of the areas of a closed surface is 0.
    expect(Math.hypot(...flux), JSON.stringify(shape)).toBeLessThan(1e-7);
  }
});

test("a ball and a capsule have their size", () => {
  const ball = surfaceOf({ shape: { ball: { radius_m: 0.02 } }, sphero_radius_m: 0.02 });
  expect(extent(along(ball, 2))).toBeCloseTo(0.04, 9);
  const capsule = surfaceOf({ shape: { capsule: { radius_m: 0.01, length_m: 0.06 } }, sphero_radius_m: 0.01 });
  expect([0, 1, 2].map((axis) => Number(extent(along(capsule, axis)).toFixed(9)))).toEqual([0.06, 0.02, 0.02]);
});

test("regular solids lie on a face with an edge along y upstream", () => {
  const tetrahedron = surfaceOf({ shape: { regular: { solid: "tetrahedron", size_m: 0.04 } }, sphero_radius_m: 1e-5 });
  const lowest = Math.min(...tetrahedron.core.map(([, , z]) => z));
  const base = tetrahedron.core.filter(([, , z]) => z < lowest + 1e-6);
  expect(base.length).toBe(3);
  const upstream = Math.min(...base.map(([x]) => x));
  expect(base.filter(([x]) => x < upstream + 1e-6).length).toBe(2);
  expect(extent(base.map(([, y]) => y))).toBeCloseTo(0.04, 3);
});

test("a shape is the same solid in the form, which is held against the service, and in a replay", () => {
  const shapes = [
    { cube: { side_m: 0.04 } },
    { box: { sides_m: [0.04, 0.02, 0.03] } },
    ...["tetrahedron", "octahedron", "dodecahedron", "icosahedron"].map((solid) => ({
      regular: { solid, size_m: 0.03 },
    })),
    { capsule: { radius_m: 0.01, length_m: 0.06 } },
  ];
  for (const shape of shapes) {
    const solid = solidOf(shape, 0.001);
    const { core, radius } = surfaceOf({ shape, sphero_radius_m: 0.001 });
    expect(radius, JSON.stringify(shape)).toBe(solid?.radius);
    expect(core.length, JSON.stringify(shape)).toBe(solid?.core.length);
    for (const corner of core) {
      const apart = Math.min(...(solid?.core ?? []).map((other) => length(minus(corner, other))));
      expect(apart, JSON.stringify(shape)).toBeLessThan(1e-9);
    }
  }
});

test("an outline from above is turned with its body", () => {
  const cube = surfaceOf({ shape: { cube: { side_m: 0.04 } }, sphero_radius_m: 0.002 });
  const eighth = Math.PI / 8;
  const outline = outlineFromAbove(cube, [1, 2, 0], [Math.cos(eighth), 0, 0, Math.sin(eighth)]);
  const expected = Math.SQRT2 * 0.036 + 0.004;
  expect(extent(outline.map(([x]) => x))).toBeCloseTo(expected, 4);
  expect(outline.reduce((sum, [x]) => sum + x, 0) / outline.length).toBeCloseTo(1, 6);
});

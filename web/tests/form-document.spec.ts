/** The scenario document and its text, without a page. */

import { expect, test } from "@playwright/test";
import { at, changed, differences, same } from "../src/parts/json-document";
import { begin, edited, redone, undone } from "../src/form/history";
import { readText, written } from "../src/parts/json-text";
import { outlineOf } from "../src/geometry/outline";
import { marks, roundBelow, snapped } from "../src/parts/round-values";
import { uniqueKey } from "../src/parts/unique-key";
import { attemptFor } from "../src/form/attempt";

test("a change leaves the rest as it was and keeps the order of keys", () => {
  const before = { a: { b: 1, c: [1, { d: 2 }] }, e: null };
  const after = changed(before, "/a/c/1/d", 3);
  expect(JSON.stringify(after)).toBe('{"a":{"b":1,"c":[1,{"d":3}]},"e":null}');
  expect(before.a.c[1]).toEqual({ d: 2 });
  expect(changed(before, "/a/c/0", undefined)).toEqual({ a: { b: 1, c: [{ d: 2 }] }, e: null });
  expect(changed({ a: 5 }, "/a/b", 1)).toEqual({ a: { b: 1 } });
  expect(at(changed({}, "/x~1y/~0z", 1), "/x~1y/~0z")).toBe(1);
  expect(at({}, "/constructor")).toBeUndefined();
});

test("differences are single fields, lists of numbers as wholes", () => {
  const was = { a: 1, b: { v: [1, 2] }, bodies: [{ x: 1 }, { x: 2 }] };
  const is = { a: 1, b: { v: [1, 3] }, bodies: [{ x: 1, y: 0 }], c: { d: 4 } };
  expect(differences(was, is).map(({ pointer }) => pointer)).toEqual(["/b/v", "/bodies/0/y", "/bodies/1/x", "/c/d"]);
  expect(differences(was, structuredClone(was))).toEqual([]);
  expect(same({ a: 1, b: 2 }, { b: 2, a: 1 })).toBe(true);
});

test("texts are read as by the browser, with the place of each value", () => {
  for (const text of ["{}", " [1, -2.5e3, true, null] ", '{"a": {"b\\u0041": [ ]}, "c": "é\\n"}', "0"]) {
    expect(readText(text).value).toEqual(JSON.parse(text));
  }
  const text = '{"a": [10, {"b": 20}]}';
  const [start, end] = readText(text).places.get("/a/1/b") ?? [0, 0];
  expect(text.slice(start, end)).toBe("20");
});

test("what is wrong with a text is told by line and column", () => {
  const cases: [string, number, number, RegExp][] = [
    ['{\n  "a": 1,\n}', 3, 1, /key/],
    ['{"a" 1}', 1, 6, /colon/],
    ["[1 2]", 1, 4, /comma/],
    ["[01]", 1, 2, /value/],
    ['{"a": 1, "a": 2}', 1, 10, /twice/],
    ['{"a": "x', 1, 7, /no end/],
    ["", 1, 1, /end of the text/],
    ["{} x", 1, 4, /found x/],
    ["[NaN]", 1, 2, /found NaN/],
    ["[".repeat(2000), 1, 101, /deep/],
  ];
  for (const [text, line, column, message] of cases) {
    const { error } = readText(text);
    expect([error?.line, error?.column], text.slice(0, 30)).toEqual([line, column]);
    expect(error?.message).toMatch(message);
  }
});

test("written text reads as the same value, lists of numbers in one line", () => {
  const value = {
    a: [1, 2, 3],
    b: { c: [], d: {} },
    e: [
      {
        f: [
          [1, 2],
          [3, 4],
        ],
      },
    ],
    g: '"',
  };
  expect(readText(written(value)).value).toEqual(value);
  expect(written(value)).toContain('"a": [1, 2, 3]');
});

test("changes of one field in quick succession are one step back", () => {
  let history = begin({ a: 0 });
  history = edited(history, { a: 1 }, "/a", 1000);
  history = edited(history, { a: 2 }, "/a", 1500);
  history = edited(history, { a: 3 }, "/a", 9000);
  history = edited(history, { a: 3 }, "/a", 9100);
  expect(undone(history).present).toEqual({ a: 2 });
  expect(undone(undone(history)).present).toEqual({ a: 0 });
  expect(undone(undone(undone(history))).present).toEqual({ a: 0 });
  expect(redone(undone(history)).present).toEqual({ a: 3 });
  expect(edited(undone(history), { a: 4 }, "/b", 9200).future).toEqual([]);
});

test("steps and marks are round numbers", () => {
  expect([0.0075, 0.02, 1, 9.9].map(roundBelow)).toEqual([0.005, 0.02, 1, 5]);
  expect(snapped(0.30000000000000004, 0.005)).toBe(0.3);
  expect(snapped(-0.0413, 0.002)).toBe(-0.042);
  expect(marks(-0.31, 0.31, 4)).toEqual([-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3]);
});

test("an outline is swept by the disc", () => {
  const xs = outlineOf(
    [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 1],
      [0.5, 0.5],
    ],
    0.25,
  ).map(([x]) => x);
  expect([Math.min(...xs), Math.max(...xs)]).toEqual([-0.25, 1.25]);
});

test("a submission keeps its key while it is the same", () => {
  const first = attemptFor({ a: 1 }, "", undefined);
  expect(attemptFor({ a: 1 }, "", first)).toBe(first);
  expect(attemptFor({ a: 2 }, "", first).key).not.toBe(first.key);
  expect(attemptFor({ a: 1 }, "x", first).path).toBe("v1/jobs?label=x");
  expect(uniqueKey()).toMatch(/^[\da-f]{32}$/);
});

/** The scene of a scenario at its start: what the views draw. */

import { type Quaternion, type Vector, dot, length, minus, plus, product, rotation, turned } from "../geometry/vectors";
import { type Json, type JsonObject, at, isObject } from "../parts/json-document";
import { type Schemas, schemaAt } from "./schema";
import { type Solid, positive, solidOf } from "./solid";

/** Incline and floor. */
export interface Channel {
  /** Inclination [rad]. */
  inclination: number;
  incline: number;
  runout: number;
  width: number;
}

/** The released volume, between two vertical planes. */
export interface Release {
  back: number;
  front: number;
  /** Thickness normal to the slope [m]. */
  height: number;
  /** Thickness along z [m]. */
  vertical: number;
  volume: number;
}

/** A body in its place. */
export interface PlacedBody {
  index: number;
  centre: Vector;
  /** Places of the core's vertices [m]. */
  core: Vector[];
  solid: Solid;
  /** True if its elevation is given, so that it may hang in the air. */
  isElevated: boolean;
  isFixed: boolean;
}

/** All that is to be drawn. */
export interface Scene {
  channel: Channel;
  release: Release | undefined;
  bodies: PlacedBody[];
  /** Bodies whose dimensions make no solid yet. */
  missing: number[];
}

/** Scene of a document; undefined as long as the channel is incomplete. */
export function sceneOf(document: JsonObject, schemas: Schemas): Scene | undefined {
  const channel = channelOf(document, schemas);
  if (!channel) return undefined;
  const list = at(document, "/bodies");
  const bodies = Array.isArray(list) ? list : [];
  const places = bodies.map((body, index) => placedBody(body, index, channel));
  return {
    channel,
    release: releaseOf(document, channel, schemas),
    bodies: places.filter((body) => body !== undefined),
    missing: bodies.map((_, index) => index).filter((index) => places[index] === undefined),
  };
}

/** Value at a pointer, or the schema's default. */
function valueAt(document: JsonObject, pointer: string, schemas: Schemas): Json | undefined {
  return at(document, pointer) ?? (schemaAt(pointer, document, schemas)?.default as Json | undefined);
}

function channelOf(document: JsonObject, schemas: Schemas): Channel | undefined {
  const read = (key: string) => valueAt(document, `/channel/${key}`, schemas);
  const degrees = read("inclination_deg");
  const incline = positive(read("incline_length_m"));
  const runout = positive(read("runout_length_m"));
  const width = positive(read("width_m"));
  if (typeof degrees !== "number" || degrees < 0 || degrees > 89.5) return undefined;
  if (incline === undefined || runout === undefined || width === undefined) return undefined;
  return { inclination: (degrees * Math.PI) / 180, incline, runout, width };
}

function releaseOf(document: JsonObject, channel: Channel, schemas: Schemas): Release | undefined {
  const volume = positive(at(document, "/flow/volume_m3"));
  const height = positive(valueAt(document, "/flow/release/height_m", schemas));
  const toe = valueAt(document, "/flow/release/toe_distance_m", schemas);
  if (volume === undefined || height === undefined || typeof toe !== "number") return undefined;
  const vertical = height / Math.cos(channel.inclination);
  return { front: -toe, back: -toe - volume / (vertical * channel.width), height, vertical, volume };
}

/** Elevation of the bed [m]. */
export function bedAt({ inclination }: Channel, x: number): number {
  return x < 0 ? -x * Math.tan(inclination) : 0;
}

const placed = new WeakMap<JsonObject, { channel: string; index: number; as: PlacedBody | undefined }>();

/** Body in its place: the same one as long as neither body nor channel change, so that hundreds are
 * drawn anew only where they moved. */
function placedBody(body: Json, index: number, channel: Channel): PlacedBody | undefined {
  if (!isObject(body)) return undefined;
  const name = JSON.stringify(channel);
  const known = placed.get(body);
  if (known?.channel === name && known.index === index) return known.as;
  const as = placeBody(body, index, channel);
  placed.set(body, { channel: name, index, as });
  return as;
}

function placeBody(body: JsonObject, index: number, channel: Channel): PlacedBody | undefined {
  const solid = solidOf(body["shape"], body["sphero_radius_m"]);
  if (!solid) return undefined;
  const place = (key: string) => {
    const value = at(body, `/position/${key}`);
    return typeof value === "number" ? value : undefined;
  };
  const x = place("downstream_m") ?? solid.reach;
  const y = place("lateral_m") ?? 0;
  const inclination = x < 0 ? channel.inclination : 0;
  const turn = turnOf(body, inclination);
  const given = place("elevation_m");
  const centre: Vector = [x, y, given ?? restingElevation(solid, turn, x, inclination)];
  const core = solid.core.map((vertex) => plus(centre, turned(turn, vertex)));
  return { index, centre, core, solid, isElevated: given !== undefined, isFixed: at(body, "/fixed") === true };
}

/** Orientation: as given, or flat on the bed and turned by the yaw about its normal. */
function turnOf(body: Json, inclination: number): Quaternion {
  const given = at(body, "/orientation");
  if (Array.isArray(given) && given.length === 4 && given.every((part) => typeof part === "number")) {
    const norm = Math.hypot(...given);
    if (norm > 0) return given.map((part) => part / norm) as unknown as Quaternion;
  }
  const yaw = at(body, "/yaw_deg");
  const degrees = typeof yaw === "number" ? yaw : 0;
  return product(rotation([0, 1, 0], inclination), rotation([0, 0, 1], (degrees * Math.PI) / 180));
}

/** Elevation of the centre of a body that touches the bed under it. */
function restingElevation(solid: Solid, turn: Quaternion, x: number, inclination: number): number {
  const normal: Vector = [Math.sin(inclination), 0, Math.cos(inclination)];
  const depths = solid.core.map((vertex) => -dot(normal, turned(turn, vertex)));
  return (Math.max(...depths) + solid.radius - x * normal[0]) / normal[2];
}

/** Largest distance of a place of a body from its centre [m]. */
export function extentOf({ core, centre, solid }: PlacedBody): number {
  return Math.max(...core.map((vertex) => length(minus(vertex, centre)))) + solid.radius;
}

/** What is drawn, in words. */
export function sceneText({ channel, release, bodies }: Scene): string {
  const round = (value: number) => Number(value.toPrecision(3));
  const degrees = round((channel.inclination * 180) / Math.PI);
  const slope = `An incline of ${degrees}°, ${channel.incline} m long, and a floor of ${channel.runout} m, ${channel.width} m wide.`;
  const flow = release
    ? `The release holds ${release.volume} m³: ${release.height} m thick and ${round(release.front - release.back)} m long, its front ${round(-release.front)} m before the foot.`
    : "There is no flow.";
  const sizes = bodies.length > 0 && bodies.length <= 3 ? `: ${bodies.map(({ solid }) => solid.text).join("; ")}` : "";
  const fixed = bodies.filter(({ isFixed }) => isFixed).length;
  const count = bodies.length === 1 ? "1 body" : `${bodies.length} bodies`;
  return `${slope} ${flow} ${count}${fixed > 0 ? `, ${fixed} of them fixed` : ""}${sizes}.`;
}

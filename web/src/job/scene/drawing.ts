/** Surfaces, lines and texts of a ground in a scene. */

import {
  BufferGeometry,
  CanvasTexture,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshBasicMaterial,
  SRGBColorSpace,
  Sprite,
  SpriteMaterial,
  type Texture,
} from "three";
import { colourOf } from "./flow-points";

/** A place in a scene [m]. */
export type Corner = [number, number, number];

/** A group that is filled part by part, and disposed of as a whole. */
export class Drawing {
  readonly group = new Group();
  private readonly made: { dispose(): void }[] = [];

  dispose(): void {
    for (const part of this.made) part.dispose();
  }

  /** Draws triangles, three corners each. */
  surface(corners: Corner[], colour: string, opacity: number): void {
    const material = new MeshBasicMaterial({
      color: colourOf(colour),
      side: DoubleSide,
      transparent: opacity < 1,
      opacity,
      depthWrite: opacity === 1,
    });
    this.group.add(new Mesh(this.geometry(corners), this.keep(material)));
  }

  /** Draws lines, two corners each. */
  lines(corners: Corner[], colour: string): void {
    this.group.add(
      new LineSegments(this.geometry(corners), this.keep(new LineBasicMaterial({ color: colourOf(colour) }))),
    );
  }

  /** Writes a text as high as this [m] that faces the camera; the anchor is the part of it that lies at the place. */
  label(text: string, place: Corner, height: number, anchor: [number, number], colour: string): void {
    const texture = this.keep(textOf(text, colour));
    const sprite = new Sprite(this.keep(new SpriteMaterial({ map: texture, depthTest: false })));
    sprite.scale.set((height * texture.image.width) / texture.image.height, height, 1);
    sprite.center.set(...anchor);
    sprite.position.set(...place);
    this.group.add(sprite);
  }

  private geometry(corners: Corner[]): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(corners.flat(), 3));
    return this.keep(geometry);
  }

  private keep<T extends BufferGeometry | Material | Texture>(part: T): T {
    this.made.push(part);
    return part;
  }
}

function textOf(text: string, colour: string): CanvasTexture<HTMLCanvasElement> {
  const canvas = document.createElement("canvas");
  const font = "44px system-ui, sans-serif";
  const context = canvas.getContext("2d");
  if (context) {
    context.font = font;
    canvas.width = Math.ceil(context.measureText(text).width) + 8;
    canvas.height = 56;
    context.font = font;
    context.fillStyle = colour;
    context.fillText(text, 4, 44);
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

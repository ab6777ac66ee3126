/** Scene of a run in three dimensions, drawn only when something changes. */

import { AmbientLight, DirectionalLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { AerialContent } from "../aerial/draw";
import type { Clock } from "../playback/clock";
import type { Theme } from "../use-theme";
import { Bodies } from "./bodies";
import { CAMERAS, type CameraName, lookAt } from "./cameras";
import { Channel } from "./channel";
import { FlowPoints, colourOf } from "./flow-points";
import { Pace } from "./pace";
import { TerrainFrame } from "./terrain-frame";

/** Pause after which a scene that stands is drawn once with all pixels [ms]. */
const STILL_MS = 250;
const MOST_PIXEL_RATIO = 2;

/** Contents of a scene, replaced together. */
interface Parts {
  flow: FlowPoints;
  bodies: Bodies;
  ground: Channel | TerrainFrame;
}

/** A canvas with the scene, which follows a clock until it is disposed of. */
export class SceneViewer {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly pace: Pace;
  private readonly ends: (() => void)[] = [];
  private parts: Parts | undefined;
  private content: AerialContent | undefined;
  private asked = 0;
  private still: ReturnType<typeof setTimeout> | undefined;
  private isInView = true;
  /** The view that follows what happens, until it is moved by hand. */
  private followed: CameraName | undefined = "free";
  /** Called after each picture with the rate of late [1/s]. */
  onFrame: ((rate: number) => void) | undefined;

  /** Throws if the browser has no WebGL. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly clock: Clock,
  ) {
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: devicePixelRatio < 1.5 && !isSoftware(),
      powerPreference: "high-performance",
    });
    this.pace = new Pace(mostPixelRatio());
    this.camera.up.set(0, 0, 1);
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(-1, -2, 3);
    this.scene.add(new AmbientLight(0xffffff, 1.3), sun);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.listenToKeyEvents(canvas);
    this.controls.addEventListener("change", this.ask);
    this.controls.addEventListener("start", () => (this.followed = undefined));
    this.ends.push(clock.onChange(this.ask));
    this.watchSize();
    canvas.addEventListener("keydown", this.zoomByKey);
    canvas.addEventListener("keydown", this.stopFollowing);
  }

  /** Replaces what is shown; the camera stays where it has been moved to, or else shows all that happens. */
  show(content: AerialContent, theme: Theme): void {
    const { scenario, frames, poses, spacing, topSpeed, region } = content;
    this.clear();
    this.parts = {
      flow: new FlowPoints(frames, spacing, topSpeed),
      bodies: new Bodies(scenario, poses, theme.isDark),
      ground: scenario.channel ? new Channel(scenario.channel, region, theme) : new TerrainFrame(region, theme),
    };
    this.scene.add(this.parts.ground.group, this.parts.flow.points, this.parts.bodies.group);
    // Dark paper would hide grains at rest, which are dark in every theme.
    this.scene.background = colourOf(theme.isDark ? theme.line : theme.paper);
    this.content = content;
    if (this.followed) this.look(this.followed);
    this.ask();
  }

  look(name: CameraName): void {
    if (!this.content) return;
    this.followed = name;
    this.controls.target.copy(lookAt(this.camera, this.content.region, CAMERAS[name].from));
    this.controls.update();
    this.ask();
  }

  /** The picture as it is now, with all pixels, as PNG. */
  picture(): Promise<Blob | null> {
    this.draw(mostPixelRatio());
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  dispose(): void {
    cancelAnimationFrame(this.asked);
    clearTimeout(this.still);
    for (const end of this.ends) end();
    this.canvas.removeEventListener("keydown", this.zoomByKey);
    this.canvas.removeEventListener("keydown", this.stopFollowing);
    this.controls.dispose();
    this.clear();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private clear(): void {
    if (!this.parts) return;
    const { flow, bodies, ground } = this.parts;
    this.scene.remove(flow.points, bodies.group, ground.group);
    for (const part of [flow, bodies, ground]) part.dispose();
    this.parts = undefined;
  }

  /** Asks for a picture at the next chance, however often it is asked. */
  private readonly ask = () => {
    if (this.asked === 0 && this.isInView) this.asked = requestAnimationFrame(this.drawInMotion);
  };

  private readonly drawInMotion = (now: number) => {
    this.asked = 0;
    this.pace.note(now);
    this.draw(this.pace.ratio);
    this.canvas.dataset["frames"] = String(this.pace.frames);
    this.onFrame?.(this.pace.rate);
    clearTimeout(this.still);
    this.still = setTimeout(() => this.draw(mostPixelRatio()), STILL_MS);
  };

  private draw(ratio: number): void {
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
    this.parts?.flow.show(this.clock.time, this.renderer.domElement.height / 2);
    this.parts?.bodies.show(this.clock.time);
    this.renderer.render(this.scene, this.camera);
  }

  private watchSize(): void {
    const sizes = new ResizeObserver(([entry]) => {
      const { width, height } = entry?.contentRect ?? { width: 0, height: 0 };
      if (width === 0 || height === 0) return;
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      if (this.followed) this.look(this.followed);
      this.ask();
    });
    sizes.observe(this.canvas.parentElement ?? this.canvas);
    const views = new IntersectionObserver(([entry]) => {
      this.isInView = entry?.isIntersecting ?? true;
      this.ask();
    });
    views.observe(this.canvas);
    this.ends.push(
      () => sizes.disconnect(),
      () => views.disconnect(),
    );
  }

  private readonly stopFollowing = ({ key }: KeyboardEvent) => {
    if (/^(Arrow|[+=-]$)/.test(key)) this.followed = undefined;
  };

  private readonly zoomByKey = ({ key }: KeyboardEvent) => {
    const factor = { "+": 0.85, "=": 0.85, "-": 1 / 0.85 }[key];
    if (factor === undefined) return;
    const arm = new Vector3().subVectors(this.camera.position, this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.ask();
  };
}

/** Pixels of a picture per pixel of the page, if nothing moves. */
function mostPixelRatio(): number {
  return Math.min(devicePixelRatio, MOST_PIXEL_RATIO);
}

let software: boolean | undefined;

/** Whether pictures are made without a graphics card, where smoothed edges cost too much. */
function isSoftware(): boolean {
  return (software ??= findSoftware());
}

/** Looks once, since a browser makes but a few contexts. */
function findSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  const names = context?.getExtension("WEBGL_debug_renderer_info");
  const name = String(names ? context?.getParameter(names.UNMASKED_RENDERER_WEBGL) : "");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

// SPDX-License-Identifier: Apache-2.0
import type { Camera, DepthTexture, Object3D, Sphere, Vector3, WebGLRenderer, WebGLRenderTarget } from 'three';
import { three } from './kit.js';
import type { PlacedLamp } from './lamp.js';
import type { LampPoint } from './lamp_points.js';
import type { Surfaces } from './surfaces.js';

/** Draws what casts shadows, as a camera sees it. */
type Render = (camera: Camera) => void;

/** Which of a cube's faces have light of a lamp: a rectangle or disc has none behind it, a narrow spot all before it. */
const ALL_FACES = [0, 1, 2, 3, 4, 5];
const NOT_BEHIND = [0, 1, 2, 3, 4];
const FRONT = [4];
/** A face sees 45 degrees to each side; the map is tilted by a few. */
const NARROW = (40 * Math.PI) / 180;

/**
 * How far everything that a point of a lamp sees is: six faces of a cube, three beside one another in two rows, or one picture of all
 * that a sun lights.
 */
export class ShadowMap {
  readonly #target: WebGLRenderTarget;
  /** Of what was drawn last. */
  point!: LampPoint;
  /** Near and far end; of a sun half the picture's width and half its depth. */
  range: [number, number] = [1, 1];
  /** The middle of a sun's picture. */
  center!: Vector3;

  constructor(
    readonly sun: boolean,
    readonly size: number,
  ) {
    const [width, height] = sun ? [size, size] : [3 * size, 2 * size];
    this.#target = new three.WebGLRenderTarget(width, height, { format: three.RedFormat, generateMipmaps: false });
    this.#target.depthTexture = new three.DepthTexture(width, height, three.UnsignedIntType);
    this.#target.scissorTest = true;
  }

  /** Takes its memory now, so that no later frame waits for that. */
  allocate(renderer: WebGLRenderer): void {
    renderer.initRenderTarget(this.#target);
    renderer.initTexture(this.depths);
  }

  get depths(): DepthTexture {
    return this.#target.depthTexture!;
  }

  /** `bounds`: of all that casts shadows, in the world; `focus`: of what a sun's picture shows, and what all is measured by. */
  draw(surfaces: Surfaces, root: Object3D, placed: PlacedLamp, point: LampPoint, bounds: Sphere, focus: Sphere): void {
    this.point = point;
    surfaces.draw(root, 'casters', (render) => {
      if (this.sun) this.#drawSun(surfaces, focus, render);
      else this.#drawCube(surfaces, placed, bounds, focus, render);
    });
  }

  dispose(): void {
    this.#target.dispose();
    this.depths.dispose();
  }

  #drawCube(surfaces: Surfaces, placed: PlacedLamp, bounds: Sphere, focus: Sphere, render: Render): void {
    const { point, size } = this;
    this.range = [0.001 * focus.radius, point.position.distanceTo(bounds.center) + bounds.radius];
    const camera = new three.PerspectiveCamera(90, 1, ...this.range);
    for (const face of facesOf(placed)) {
      const axis = face >> 1;
      const forward = point.axes[axis]!.clone().multiplyScalar(face & 1 ? 1 : -1);
      this.#aim(camera, point.axes[(axis + 1) % 3]!, point.axes[(axis + 2) % 3]!, forward, point.position);
      this.#show(surfaces, (face % 3) * size, Math.floor(face / 3) * size);
      render(camera);
    }
  }

  /** As deep as what the pack is about and as much again on both sides: a dome of sky that the file has stands farther away. */
  #drawSun(surfaces: Surfaces, focus: Sphere, render: Render): void {
    const [right, up, front] = this.point.axes;
    const { radius, center } = focus;
    this.range = [radius, 2 * radius];
    this.center = center;
    const camera = new three.OrthographicCamera(-radius, radius, radius, -radius, 0, 4 * radius);
    this.#aim(camera, right, up, front.clone().negate(), center.clone().addScaledVector(front, -2 * radius));
    this.#show(surfaces, 0, 0);
    render(camera);
  }

  #show({ renderer }: Surfaces, x: number, y: number): void {
    this.#target.viewport.set(x, y, this.size, this.size);
    this.#target.scissor.copy(this.#target.viewport);
    renderer.setRenderTarget(this.#target);
  }

  #aim(camera: Camera, right: Vector3, up: Vector3, back: Vector3, place: Vector3): void {
    camera.matrixWorldAutoUpdate = false;
    camera.matrixWorld.makeBasis(right, up, back).setPosition(place);
    camera.matrixWorldInverse.copy(camera.matrixWorld).invert();
  }
}

function facesOf({ lamp: { definition } }: PlacedLamp): number[] {
  const { kind, twoSided, outerConeAngle = Math.PI / 4 } = definition;
  if (kind === 'spot') return outerConeAngle < NARROW ? FRONT : NOT_BEHIND;
  return (kind === 'rectangle' || kind === 'disc') && twoSided !== true ? NOT_BEHIND : ALL_FACES;
}

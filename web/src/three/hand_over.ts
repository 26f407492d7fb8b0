// SPDX-License-Identifier: Apache-2.0
import { BufferGeometry, Camera, Mesh, MeshBasicMaterial, Scene, type WebGLRenderer, WebGLRenderTarget } from 'three';

/**
 * Hands what has changed in geometries over to the GPU without drawing it. three.js does that only for what it draws: so each
 * geometry has a double that shares its buffers, and no face of that is drawn into a picture of one pixel.
 */
export class HandOver {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera = new Camera();
  readonly #target = new WebGLRenderTarget(1, 1, { depthBuffer: false });
  readonly #material = new MeshBasicMaterial();
  readonly #doubles = new Map<BufferGeometry, Mesh>();

  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
  }

  run(geometries: BufferGeometry[]): void {
    if (geometries.length === 0) return;
    const renderer = this.#renderer;
    const before = [renderer.getRenderTarget(), renderer.getActiveCubeFace(), renderer.getActiveMipmapLevel()] as const;
    this.#scene.clear().add(...geometries.map((geometry) => this.#doubleOf(geometry)));
    renderer.setRenderTarget(this.#target);
    renderer.render(this.#scene, this.#camera);
    renderer.setRenderTarget(...before);
  }

  dispose(): void {
    for (const { geometry } of this.#doubles.values()) geometry.dispose();
    this.#target.dispose();
    this.#material.dispose();
  }

  #doubleOf(geometry: BufferGeometry): Mesh {
    const known = this.#doubles.get(geometry);
    if (known !== undefined) return known;
    const buffers = new BufferGeometry().setIndex(geometry.index);
    for (const [name, attribute] of Object.entries(geometry.attributes)) buffers.setAttribute(name, attribute);
    buffers.setDrawRange(0, 0);
    buffers.boundingSphere = geometry.boundingSphere;
    const double = new Mesh(buffers, this.#material);
    double.frustumCulled = false;
    this.#doubles.set(geometry, double);
    return double;
  }
}

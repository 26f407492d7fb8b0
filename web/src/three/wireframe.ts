// SPDX-License-Identifier: Apache-2.0
import type { Material, Mesh, Object3D, WebGLRenderer } from 'three';
import { materialsOf, meshesIn } from './meshes.js';

/** What this code uses of https://registry.khronos.org/webgl/extensions/WEBGL_polygon_mode/ */
interface PolygonMode {
  polygonModeWEBGL(face: number, mode: number): void;
  LINE_WEBGL: number;
  FILL_WEBGL: number;
}

/** Whether the GPU draws the edges of triangles by itself: then outlines cost no memory, and follow what streams in. */
export function drawsEdges(renderer: WebGLRenderer): boolean {
  return renderer.extensions.has('WEBGL_polygon_mode');
}

/**
 * Draws all meshes as their edges, or as surfaces again. Where the GPU cannot, three.js makes a buffer of lines for each state of
 * a mesh that is drawn so.
 */
export function showEdges(root: Object3D, renderer: WebGLRenderer, wireframe: boolean): void {
  for (const mesh of meshesIn(root)) {
    if (drawsEdges(renderer)) setEdges(mesh, renderer, wireframe);
    else for (const material of materialsOf(mesh) as (Material & { wireframe?: boolean })[]) material.wireframe = wireframe;
  }
}

function setEdges(mesh: Mesh, renderer: WebGLRenderer, wireframe: boolean): void {
  const gl = renderer.getContext();
  const draw = (mode: 'LINE_WEBGL' | 'FILL_WEBGL') => () => {
    const extension = renderer.extensions.get('WEBGL_polygon_mode') as PolygonMode;
    extension.polygonModeWEBGL(gl.FRONT_AND_BACK, extension[mode]);
  };
  mesh.onBeforeRender = wireframe ? draw('LINE_WEBGL') : () => {};
  mesh.onAfterRender = wireframe ? draw('FILL_WEBGL') : () => {};
}

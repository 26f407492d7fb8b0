// SPDX-License-Identifier: Apache-2.0
import type { BufferAttribute, BufferGeometry, Material, Mesh, Object3D, WebGLRenderer } from 'three';

/** What this code uses of https://registry.khronos.org/webgl/extensions/WEBGL_polygon_mode/ */
interface PolygonMode {
  polygonModeWEBGL(face: number, mode: number): void;
  LINE_WEBGL: number;
  FILL_WEBGL: number;
}

/**
 * Draws all meshes as their edges, or as surfaces again. Where the GPU draws the edges of triangles by itself, outlines cost no memory and
 * follow what streams in. Elsewhere three.js makes a buffer of lines for each state of a mesh that is drawn so, of all of its index buffer: they
 * wait until all is `complete`, and each mesh gets an index buffer of what it draws. A script of its own, which imports nothing that the page has.
 */
export function showEdges(root: Object3D, renderer: WebGLRenderer, wireframe: boolean, complete: boolean): void {
  const drawsEdges = renderer.extensions.has('WEBGL_polygon_mode');
  root.traverse((object) => {
    const mesh = object as Mesh;
    if (!mesh.isMesh) return;
    if (drawsEdges) setEdges(mesh, renderer, wireframe);
    else if (complete) {
      if (wireframe) ownIndices(mesh.geometry);
      for (const material of [mesh.material].flat() as (Material & { wireframe?: boolean })[]) material.wireframe = wireframe;
    }
  });
}

/** DynamicDrawUsage, which the indices of what streams have. */
const STREAMED = 35048;

function ownIndices(geometry: BufferGeometry): void {
  const { index, drawRange } = geometry;
  if (index?.usage !== STREAMED) return;
  const own = index.array.slice(drawRange.start, drawRange.start + drawRange.count);
  geometry.setIndex(new (index.constructor as typeof BufferAttribute)(own, 1)).setDrawRange(0, own.length);
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

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
      useIndices(mesh.geometry, wireframe);
      for (const material of [mesh.material].flat() as (Material & { wireframe?: boolean })[]) material.wireframe = wireframe;
    }
  });
}

/** DynamicDrawUsage, which the indices of what streams have. */
const STREAMED = 35048;
/** Of geometries whose edges were shown: what they draw of an index buffer, and that in one of its own. */
const indices = new WeakMap<BufferGeometry, { shared: BufferAttribute; start: number; own: BufferAttribute }>();

function useIndices(geometry: BufferGeometry, own: boolean): void {
  const { index, drawRange } = geometry;
  const { start, count } = drawRange;
  if (own && index?.usage === STREAMED && !indices.has(geometry)) {
    const Attribute = index.constructor as typeof BufferAttribute;
    indices.set(geometry, { shared: index, start, own: new Attribute(index.array.slice(start, start + count), 1) });
  }
  const known = indices.get(geometry);
  if (known !== undefined) geometry.setIndex(own ? known.own : known.shared).setDrawRange(own ? 0 : known.start, count);
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

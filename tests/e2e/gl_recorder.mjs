// SPDX-License-Identifier: Apache-2.0

/**
 * Runs in a page before its scripts: counts what WebGL is handed between two animation frames and what it is asked to
 * allocate. `glRecord.frames` holds bytes a frame, `glRecord.allocations` the names of the calls, both since `glRecord.reset()`.
 */
export const RECORD_GL = `{
  const record = { frames: [0], allocations: [], reset() { this.frames = [0]; this.allocations = []; } };
  globalThis.glRecord = record;
  const prototype = WebGL2RenderingContext.prototype;
  const wrap = (name, before) => {
    const original = prototype[name];
    prototype[name] = function (...values) { before(...values); return original.apply(this, values); };
  };
  const add = (bytes) => (record.frames[record.frames.length - 1] += bytes);
  for (const name of ['bufferData', 'texImage2D', 'texImage3D', 'texStorage2D', 'texStorage3D', 'renderbufferStorage',
                      'renderbufferStorageMultisample', 'compressedTexImage2D'])
    wrap(name, () => record.allocations.push(name));
  wrap('bufferSubData', (target, offset, data, start = 0, length = 0) =>
    add((length || data.length - start) * data.BYTES_PER_ELEMENT));
  const texelBytes = (type) => (type === prototype.HALF_FLOAT ? 8 : 4);
  wrap('texSubImage2D', (target, level, x, y, width, height, format, type) => add(width * height * texelBytes(type)));
  wrap('texSubImage3D', (target, level, x, y, z, width, height, depth, format, type) =>
    add(width * height * depth * texelBytes(type)));
  const next = () => { record.frames.push(0); requestAnimationFrame(next); };
  requestAnimationFrame(next);
}`;

/** Runs in a page before its scripts: `objects` counts by its kind what the GPU holds. */
export const COUNT_OBJECTS = `globalThis.objects = {};
for (const kind of ['Buffer', 'Texture', 'VertexArray']) {
  const prototype = WebGL2RenderingContext.prototype;
  const { ['create' + kind]: create, ['delete' + kind]: remove } = prototype;
  objects[kind] = 0;
  prototype['create' + kind] = function () { objects[kind]++; return create.call(this); };
  prototype['delete' + kind] = function (object) { if (object) objects[kind]--; remove.call(this, object); };
}`;

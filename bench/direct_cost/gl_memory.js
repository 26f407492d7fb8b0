// SPDX-License-Identifier: Apache-2.0
//
// Counts the bytes of a page's textures and renderbuffers as WebGL is told to make them. To be loaded before a context is made.

/** Bytes of a texel; a depth of 24 bits takes 32. */
const BYTES = {
  R8: 1, RG8: 2, RGB8: 3, RGBA8: 4, SRGB8_ALPHA8: 4, R16F: 2, RG16F: 4, RGBA16F: 8, R32F: 4, RG32F: 8, RGBA32F: 16, R11F_G11F_B10F: 4,
  DEPTH_COMPONENT16: 2, DEPTH_COMPONENT24: 4, DEPTH_COMPONENT32F: 4, DEPTH24_STENCIL8: 4, DEPTH32F_STENCIL8: 8, RGBA: 4, RGB: 3,
};
const { prototype } = WebGL2RenderingContext;
const NAMES = new Map(Object.keys(BYTES).map((name) => [prototype[name], name]));

/** What each live texture and renderbuffer is: by how it is told apart, and its bytes. */
const live = new Map();

function note(object, format, width, height, depth, samples = 1) {
  const name = NAMES.get(format);
  if (name === undefined) throw new Error(`a texture of an unknown format, ${format}`);
  const size = [width, height, depth].filter((n) => n > 1).join(' x ') || '1';
  live.set(object, { what: `${name} ${size}`, bytes: BYTES[name] * width * height * depth * Math.max(1, samples) });
}

function bound(gl, target) {
  if (target === gl.TEXTURE_2D) return gl.getParameter(gl.TEXTURE_BINDING_2D);
  if (target === gl.TEXTURE_3D) return gl.getParameter(gl.TEXTURE_BINDING_3D);
  if (target === gl.TEXTURE_2D_ARRAY) return gl.getParameter(gl.TEXTURE_BINDING_2D_ARRAY);
  return gl.getParameter(gl.TEXTURE_BINDING_CUBE_MAP);
}

function after(name, then) {
  const own = prototype[name];
  prototype[name] = function (...values) {
    const result = own.apply(this, values);
    then(this, ...values);
    return result;
  };
}

/** Mipmaps add a third; a cube has six sides. */
const layers = (gl, target, levels) => (target === gl.TEXTURE_CUBE_MAP ? 6 : 1) * (levels > 1 ? 4 / 3 : 1);

after('texStorage2D', (gl, target, levels, format, width, height) => note(bound(gl, target), format, width, height, layers(gl, target, levels)));
after('texStorage3D', (gl, target, _, format, width, height, depth) => note(bound(gl, target), format, width, height, depth));
after('texImage2D', (gl, target, level, format, width, height) => {
  if (level === 0 && typeof height === 'number') note(bound(gl, target), format, width, height, layers(gl, target, 1));
});
after('texImage3D', (gl, target, level, format, width, height, depth) => level === 0 && note(bound(gl, target), format, width, height, depth));
const renderbuffer = (gl) => gl.getParameter(gl.RENDERBUFFER_BINDING);
after('renderbufferStorage', (gl, _, format, width, height) => note(renderbuffer(gl), format, width, height, 1));
after('renderbufferStorageMultisample', (gl, _, samples, format, width, height) => note(renderbuffer(gl), format, width, height, 1, samples));
after('deleteTexture', (_, texture) => live.delete(texture));
after('deleteRenderbuffer', (_, buffer) => live.delete(buffer));

/** What is live now. */
export const snapshot = () => new Set(live.keys());

/** Of what is live and was not in a snapshot: rows of { what, count, bytes }, the largest first. */
export function since(before) {
  const rows = new Map();
  for (const [object, { what, bytes }] of live) {
    if (before.has(object)) continue;
    const row = rows.get(what) ?? { what, count: 0, bytes: 0 };
    rows.set(what, { what, count: row.count + 1, bytes: row.bytes + bytes });
  }
  return [...rows.values()].sort((a, b) => b.bytes - a.bytes);
}

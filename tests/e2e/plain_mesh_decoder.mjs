// SPDX-License-Identifier: Apache-2.0
//
// A decoder of mesh streams written from docs/format.md alone, as plain as can be: it shares nothing with the product's.

const TOP = 2 ** 32;
const bits = (x) => (typeof x === 'bigint' ? (x === 0n ? 0 : x.toString(2).length) : 32 - Math.clz32(x));
const abs = (x) => (x < 0n ? -x : x);

/** "The range coder". */
class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
    this.range = TOP - 1;
    this.code = 0;
    for (let i = 0; i < 4; i++) this.code = this.code * 256 + this.next();
  }
  next() {
    return this.bytes[this.at++] ?? 0;
  }
  shift() {
    while (this.range < 2 ** 24) {
      this.range *= 256;
      this.code = this.code * 256 + this.next();
    }
  }
  bit(model, name) {
    const context = (model[name] ??= { fast: 32768, slow: 32768 });
    const p = Math.floor((((context.fast + context.slow) >> 1) * 65472) / 65536) + 32;
    const zero = Math.floor(this.range / 65536) * p;
    const one = this.code >= zero;
    if (one) {
      this.code -= zero;
      this.range -= zero;
      context.fast -= context.fast >> 4;
      context.slow -= context.slow >> 7;
    } else {
      this.range = zero;
      context.fast += (65535 - context.fast) >> 4;
      context.slow += (65535 - context.slow) >> 7;
    }
    this.shift();
    return one ? 1 : 0;
  }
  raw(count) {
    let value = 0;
    while (count > 0) {
      const now = Math.min(16, count);
      count -= now;
      this.range = Math.floor(this.range / 2 ** now);
      const found = Math.min(Math.floor(this.code / this.range), 2 ** now - 1);
      this.code -= found * this.range;
      value = value * 2 ** now + found;
      this.shift();
    }
    return value;
  }
  symbol(model, count) {
    let node = 1;
    for (let i = 0; i < count; i++) node = 2 * node + this.bit(model, `node ${node}`);
    return node - 2 ** count;
  }
  /** The bits of a number of `width` bits below its leading one. */
  below(model, width) {
    if (width === 0) return 0;
    let value = 1;
    let left = width - 1;
    for (let i = 0, node = 1; i < 2 && left > 0; i++, left--) {
      const bit = this.bit(model, `leading ${width} ${node}`);
      node = 2 * node + bit;
      value = 2 * value + bit;
    }
    return left > 0 ? value * 2 ** left + this.raw(left) : value;
  }
  natural(model) {
    return this.below(model, this.symbol(model, 6));
  }
  integer(model) {
    const width = this.symbol(model, 6);
    if (width === 0) return 0;
    const negative = this.bit(model, `sign ${width}`);
    const magnitude = this.below(model, width);
    return negative ? -magnitude : magnitude;
  }
}

/** The models of a stream, by name; each begins empty. */
class Models {
  #all = new Map();
  of(...name) {
    const key = name.join(' ');
    if (!this.#all.has(key)) this.#all.set(key, {});
    return this.#all.get(key);
  }
}

const minus = (a, b) => a.map((x, i) => x - b[i]);
const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
const big = (v) => v.map(BigInt);

/** Integers of a vector as a point of the octahedral square: lightwell/mesh/vertex_codes.cpp. */
function octahedral(vector) {
  const size = vector.reduce((sum, x) => sum + abs(x) / 4n, 0n);
  const step = 1n << BigInt(Math.max(0, bits(size) - 48));
  const [x, y, z] = vector.map((value) => value / step);
  const whole = abs(x) + abs(y) + abs(z);
  if (whole === 0n) return [0, 511];
  let [u, v] = [Number((x * 511n) / whole), Number((y * 511n) / whole)];
  if (z < 0n) [u, v] = [(511 - Math.abs(v)) * (u < 0 ? -1 : 1), (511 - Math.abs(u)) * (v < 0 ? -1 : 1)];
  if (Math.abs(u) === 511) v = Math.abs(v);
  if (Math.abs(v) === 511) u = Math.abs(u);
  return [u, v];
}

/** The streams of meshes in a pack: layout, places and payloads of each. */
export function meshStreams(file) {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const u32 = (at) => view.getUint32(at, true);
  const chunks = {};
  for (let at = 12; at < file.length; at += 8 + u32(at)) chunks[u32(at + 4)] = at + 8;
  const [bin, streams] = [chunks[0x004e4942], chunks[0x5453574c]];
  const found = [];
  let at = streams + 36;
  for (let i = u32(streams + 32); i > 0; i--) {
    const [kind, codec, blocks, length] = [view.getUint8(at), view.getUint8(at + 1), u32(at + 12), u32(at + 20)];
    const parameters = at + 24;
    const first = parameters + length;
    if (kind === 1) found.push({ codec, ...readLayout(view, parameters, length, bin), payloads: readBlocks(view, streams + u32(at + 4), first, blocks) });
    at = first + 12 * Math.min(blocks, 64);
  }
  return found;
}

/** After each 64th block comes the next page of rows. */
function readBlocks(view, begin, page, count) {
  const payloads = [];
  for (let i = 0, at = begin; i < count; i++) {
    if (i > 0 && i % 64 === 0) {
      page = at;
      at += 12 * Math.min(count - i, 64) + 4;
    }
    const length = view.getUint32(page + 12 * (i % 64), true);
    payloads.push(new Uint8Array(view.buffer, view.byteOffset + at, length - 4));
    at += length;
  }
  return payloads;
}

function readLayout(view, at, length, bin) {
  const u32 = (i) => view.getUint32(at + 4 * i, true);
  const [vertices, faces, baseVertices, baseFaces, loose] = [0, 1, 2, 3, 4].map(u32);
  const attributes = view.getUint8(at + 24);
  const exponents = [25, 26, 27].map((i) => view.getInt8(at + i));
  const place = (i) => bin + view.getUint32(at + 28 + 4 * i, true);
  const numbers = (present, i, count, size, read) =>
    present ? Array.from({ length: baseVertices }, (_, v) => Array.from({ length: count }, (_, k) => read(place(i) + size * (count * v + k)))) : null;
  const f32 = (i) => view.getFloat32(i, true);
  const u16 = (i) => view.getUint16(i, true);
  const short = view.getUint8(at + 52) === 1;
  const index = (i) => (short ? u16(place(5) + 2 * i) : view.getUint32(place(5) + 4 * i, true));
  const regions = [];
  for (let row = at + 53; row < at + length; row += 9) regions.push({ baseFaces: view.getUint32(row + 4, true), shift: view.getUint8(row + 8) });
  return {
    layout: { vertices, faces, loose, attributes, exponents, regions },
    base: {
      positions: numbers(true, 0, 3, 4, f32),
      normals: numbers(attributes & 1, 1, 3, 4, f32),
      texcoords: [numbers(attributes & 2, 2, 2, 4, f32), numbers(attributes & 4, 3, 2, 4, f32)],
      colors: numbers(attributes & 8, 4, 4, 2, u16),
      faces: Array.from({ length: baseFaces }, (_, f) => [0, 1, 2].map((k) => index(3 * f + k))),
    },
  };
}

/** A mesh between its coarsest and its final level. Positions and texcoords are codes; of normals the codes of those behind the coarsest level's. */
export class PlainMesh {
  #models = new Models();
  #lists = []; // of faces, the last one added first
  #points = []; // the vertices of each
  #order; // of the sweep
  #next;
  #at = 0;
  #left = 0; // splits of the pass
  #again = 0;
  #news = []; // how many new neighbours a vertex has in this pass
  #areas = null;
  #recent = 16;
  #lastLoose = 0;
  #lastRegion = 0;

  constructor({ layout, base }) {
    this.layout = layout;
    this.baseVertices = base.positions.length;
    const [position, ...texcoord] = layout.exponents.map((exponent) => 2 ** -exponent);
    this.positions = base.positions.map((p) => p.map((x) => x * position));
    this.texcoords = base.texcoords.map((set, i) => set?.map((t) => t.map((x) => x * texcoord[i])) ?? null);
    this.colors = base.colors?.map(colorCode) ?? null;
    this.normals = new Map();
    this.faces = [];
    this.regions = (layout.regions ?? []).flatMap(({ baseFaces }, region) => Array(baseFaces).fill(region)); // of each face, where there are several
    this.positions.forEach((p, v) => {
      this.#lists.push([]);
      if (v > 0 && minus(p, this.positions[v - 1]).every((x) => x === 0)) this.#points.at(-1).push(v);
      else this.#points.push([v]);
    });
    for (const face of base.faces) this.#addFace(face);
    this.#next = this.#points.map((_, i) => i);
  }

  append(payload) {
    const reader = new Reader(payload);
    const count = () => reader.natural(this.#models.of('count'));
    for (let i = count(); i > 0; i--) this.#split(reader, count);
    for (let i = count(); i > 0; i--) this.#looseFace(reader);
    for (let i = count(); i > 0; i--) this.#normal(reader);
  }

  #addFace(face) {
    this.faces.push(face);
    for (const v of face) this.#lists[v].unshift(this.faces.length - 1);
  }

  #fan(v) {
    const fan = this.#lists[v].map((face) => {
      const k = this.faces[face].indexOf(v);
      return { face, a: this.faces[face][(k + 1) % 3], b: this.faces[face][(k + 2) % 3] };
    });
    const swap = (i, j) => ([fan[i], fan[j]] = [fan[j], fan[i]]);
    const end = fan.findIndex(({ a }) => !fan.some(({ b }) => b === a));
    if (end > 0) swap(0, end);
    for (let i = 1; i < fan.length; i++) {
      const next = fan.findIndex(({ a }, j) => j >= i && a === fan[i - 1].b);
      if (next > i) swap(i, next);
    }
    return fan;
  }

  #beginPass() {
    if (this.#order !== undefined) this.#next.push(...this.#order.slice(this.#at + 1));
    this.#order = this.#next;
    this.#at = 0;
    this.#next = [this.#order[0]];
    this.#again = 0;
    this.#news = this.positions.map(() => 0);
  }

  #split(reader, count) {
    if (this.#left === 0) {
      this.#left = count();
      this.#beginPass();
    }
    const splits = () => {
      const [first] = this.#points[this.#order[this.#at]];
      return reader.bit(this.#models.of('splits', this.#again, Math.min(11, this.#lists[first].length)), this.#news[first]);
    };
    while (!splits()) {
      this.#again = 0;
      this.#next.push(this.#order[++this.#at]);
    }
    this.#again = 1;
    this.#left--;
    const parents = this.#points[this.#order[this.#at]];
    const point = [];
    do this.#vertex(reader, parents, point);
    while (reader.bit(this.#models.of('one more'), parents.length > 1 ? 1 : 0));
    this.#next.push(this.#points.push(point) - 1);
  }

  #vertex(reader, parents, point) {
    const parent = parents[parents.length > 1 ? reader.natural(this.#models.of('parent')) : 0];
    const fan = this.#fan(parent);
    const moves = this.#moves(reader, parent, fan);
    const added = this.#newFaces(reader, parent, fan, moves);
    const shift = this.layout.regions?.length > 0 ? this.#newRegions(reader, parent, fan, moves, added) : 0;
    const v = this.positions.length;
    const around = [...fan.filter((_, i) => moves[i]), ...added];
    this.positions.push(point.length > 0 ? this.positions[point[0]] : this.#position(reader, parent, around, shift));
    this.#texcoords(reader, parent, around);
    if (this.colors !== null) this.#color(reader, parent, around);
    point.push(v);
    if (fan.length > 0) this.#lists[parent] = [];
    this.#lists.push([]);
    fan.forEach(({ face }, i) => {
      const owner = moves[i] ? v : parent;
      this.faces[face][this.faces[face].indexOf(parent)] = owner;
      this.#lists[owner].unshift(face);
    });
    for (const { a, b } of added) this.#addFace([v, a, b]);
    for (const { a, b } of around) for (const x of [a, b]) if (x !== parent && this.#news[x] < 3) this.#news[x]++;
  }

  #moves(reader, parent, fan) {
    const closed = fan.length > 0 && fan.at(-1).b === fan[0].a ? 1 : 0;
    const moves = fan.map(() => 0);
    if (!reader.bit(this.#models.of('is run'), closed)) {
      for (let i = 0; i < fan.length; i++) moves[i] = reader.bit(this.#models.of('moves'), i > 0 ? moves[i - 1] : 0);
      return moves;
    }
    const length = reader.symbol(this.#models.of('length', closed, Math.min(15, fan.length)), 4);
    const runs = length === fan.length ? 1 : closed ? fan.length : fan.length - length + 1;
    const edge = (x) => minus(this.positions[x], this.positions[parent]).reduce((sum, d) => sum + d * d, 0);
    const weigh = (first) => {
      let sum = 0;
      for (let i = 0; i < length; i++) sum += edge(fan[(first + i) % fan.length].a) + edge(fan[(first + i) % fan.length].b);
      return sum;
    };
    const ranked = Array.from({ length: runs }, (_, first) => ({ first, weight: weigh(first) })).sort((a, b) => b.weight - a.weight || a.first - b.first);
    const rank = runs > 1 ? reader.symbol(this.#models.of('rank', Math.min(7, length), Math.min(15, runs)), 4) : 0;
    for (let i = 0; i < length; i++) moves[(ranked[rank].first + i) % fan.length] = 1;
    return moves;
  }

  #near(reader, model, list) {
    const place = reader.natural(this.#models.of(model));
    return place > 0 ? list[place - 1] : reader.raw(bits(this.positions.length));
  }

  #newFaces(reader, parent, fan, moves) {
    const ring = new Map();
    fan.forEach(({ a, b }, i) => {
      for (const x of [a, b]) {
        const known = ring.get(x) ?? { moving: 0, staying: 0, before: false };
        if (moves[i] ? known.moving === 0 : known.moving + known.staying === 0) known.before = (moves[i] === 1) === (x === b);
        known[moves[i] ? 'moving' : 'staying']++;
        ring.set(x, known);
      }
    });
    if (reader.bit(this.#models.of('explicit'), 0)) {
      const near = [parent, ...ring.keys()];
      return Array.from({ length: reader.natural(this.#models.of('explicit count')) }, () => {
        const a = this.#near(reader, 'explicit corner', near);
        return { a, b: this.#near(reader, 'explicit corner', near) };
      });
    }
    const faces = [];
    for (const [x, { moving, staying, before }] of ring) {
      const context = [Math.min(2, moving), Math.min(2, staying)];
      if (!reader.bit(this.#models.of('has face', ...context), 0)) continue;
      const turned = reader.bit(this.#models.of('turned', ...context), 0) === 1;
      faces.push(turned !== before ? { a: x, b: parent } : { a: parent, b: x });
    }
    return faces;
  }

  #region(reader, likely) {
    const found = reader.bit(this.#models.of('likely region'), 0) ? likely : reader.natural(this.#models.of('region'));
    this.regions.push(found);
    return (this.#lastRegion = found);
  }

  /** The shift of the lattice on which the new vertex' faces lie. */
  #newRegions(reader, parent, fan, moves, added) {
    const regions = fan.filter((_, i) => moves[i]).map(({ face }) => this.regions[face]);
    for (const { a, b } of added) {
      const beside = fan.find((face) => [a, b].some((x) => x !== parent && (face.a === x || face.b === x)));
      regions.push(this.#region(reader, beside === undefined ? this.#lastRegion : this.regions[beside.face]));
    }
    return regions.length > 0 ? Math.min(...regions.map((region) => this.layout.regions[region].shift)) : 0;
  }

  #position(reader, parent, around, regionShift) {
    const p = this.positions[parent];
    const from = (x) => minus(this.positions[x], p);
    const corners = around.flatMap(({ a, b }) => [from(a), from(b)]);
    let normal = [0n, 0n, 0n];
    let spread = 0n;
    for (const { a, b } of around) {
      normal = cross(big(from(a)), big(from(b))).map((x, i) => x + normal[i]);
      for (const d of [from(a), from(b)]) spread += big(d).reduce((sum, x) => sum + x * x, 0n) / 2n;
    }
    const mean = (list) => p.map((x, i) => x + (list.length > 0 ? Math.trunc(list.reduce((sum, d) => sum + d[i], 0) / list.length) : 0));
    const m = mean(corners);
    const shared = around.filter(({ a, b }) => (a === parent) !== (b === parent)).map(({ a, b }) => from(a === parent ? b : a));
    const h = shared.length > 0 ? mean(shared) : m;
    const s = corners.length > 0 ? spread / BigInt(corners.length) : 0n;
    const largest = normal.map(abs).reduce((most, x) => (x > most ? x : most));
    const n = normal.map((x) => x / (1n << BigInt(Math.max(0, bits(largest) - 34))));
    let up = 0;
    for (const i of [1, 2]) if (abs(n[i]) > abs(n[up])) up = i;
    const found = [];
    let height = 0n;
    const step = regionShift > 0 && reader.bit(this.#models.of('on lattice'), 0) ? 2 ** regionShift : 1;
    for (let i = 1; i <= 3; i++) {
      const axis = (up + i) % 3;
      let expected = m[axis] + Math.trunc((8 * (p[axis] - m[axis]) - 3 * (h[axis] - m[axis])) / 32);
      if (axis === up && n[up] !== 0n) expected -= Number(height / n[up]);
      const nearest = Math.floor((expected + Math.floor(step / 2)) / step);
      found[axis] = step * (nearest + reader.integer(this.#models.of(axis === up ? 'height' : 'across', bits(s / BigInt(step * step)))));
      height += n[axis] * BigInt(found[axis] - expected);
    }
    return found;
  }

  #texcoords(reader, parent, around) {
    for (const set of this.texcoords) {
      if (set === null) continue;
      const corners = around.flatMap(({ a, b }) => [set[a], set[b]]);
      set.push(
        [0, 1].map((i) => {
          const mean = corners.length > 0 ? Math.trunc(corners.reduce((sum, t) => sum + t[i], 0) / corners.length) : set[parent][i];
          const apart = set[parent][i] - mean;
          return mean + Math.trunc(apart / 4) + reader.integer(this.#models.of('texcoord', Math.min(23, bits(Math.abs(apart)))));
        }),
      );
    }
  }

  #color(reader, parent, around) {
    const all = [parent, ...around.flatMap(({ a, b }) => [a, b])].map((x) => this.colors[x]);
    this.colors.push(
      [0, 1, 2, 3].map((i) => {
        const mean = Math.trunc(all.reduce((sum, color) => sum + color[i], 0) / all.length);
        return (mean + reader.integer(this.#models.of('color'))) & 255;
      }),
    );
  }

  #looseFace(reader) {
    const first = (this.#lastLoose += reader.natural(this.#models.of('loose first')));
    const near = [first];
    if (this.#lists[first].length <= 64) for (const { a, b } of this.#fan(first)) for (const x of [a, b]) if (!near.includes(x)) near.push(x);
    const second = this.#near(reader, 'loose corner', near);
    near[0] = second;
    this.faces.push([first, second, this.#near(reader, 'loose corner', near)]);
    if (this.layout.regions?.length > 0) this.#region(reader, this.#lastRegion);
  }

  #normal(reader) {
    if (this.#areas === null) {
      this.#areas = this.positions.map(() => [0n, 0n, 0n]);
      for (const [a, b, c] of this.faces) {
        const area = cross(...[b, c].map((x) => big(minus(this.positions[x], this.positions[a]))));
        for (const v of [a, b, c]) this.#areas[v] = this.#areas[v].map((x, i) => x + area[i]);
      }
    }
    const v = this.positions.length - this.#missingNormals();
    const predicted = octahedral(this.#areas[v]);
    const model = this.#models.of('normal', Math.min(11, bits(this.#recent)));
    const [du, dv] = [reader.integer(model), reader.integer(model)];
    this.normals.set(v, [predicted[0] + du, predicted[1] + dv]);
    this.#recent = Math.floor((7 * this.#recent + 4 * (Math.abs(du) + Math.abs(dv))) / 8);
  }

  #missingNormals() {
    return this.layout.vertices - this.baseVertices - this.normals.size;
  }
}

/** The codes nearest to a colour of the coarsest level. */
function colorCode(values) {
  return values.map((value, i) => Math.floor(255 * (i < 3 ? Math.sqrt(value / 65535) : value / 65535) + 0.5));
}

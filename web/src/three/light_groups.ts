// SPDX-License-Identifier: Apache-2.0
import type { Color, Material } from 'three';
import type { LightEvent } from '../core/protocol.js';
import type { Lamp } from './direct/lamp.js';
import type { LampDefinition, LightGridDefinition } from './extensions.js';
import { halfValues, toHalf } from './half.js';
import type { Opening } from './opening.js';
import type { AssetWeight } from './view_weights.js';

/** By how much the light of a group is multiplied, for each colour. */
type Factor = [number, number, number];

const AS_BAKED: Factor = [1, 1, 1];
/** What multiplies the sky's own light, where it has grids apart; no group has this name. */
const SKY = '\0sky';
const SMALLEST_NORMAL_HALF = 2 ** -14;
/** Of lightwell/light/atlas.h. */
const SUB_VOLUMES = 7;
const WEIGHT_CHANNEL = 27;

/**
 * The light of a pack in parts: groups whose lamps are switched, dimmed and coloured with their bounced light, and the sky's own.
 * Light adds up: all grids become one, which is looked up as the grid of any other pack. Fetched for such packs only: it imports nothing
 * that others have (docs/decisions/008-size-of-the-page.md).
 */
export class LightGroups {
  readonly #sums: SummedGrid[] = [];
  readonly #sumOf = new Map<number, SummedGrid>();
  readonly #factors = new Map<string, Factor>();
  readonly #lampColors = new Map<Lamp, Color>();
  readonly #emissive = new Map<Material, Color>();

  /** `states`: the first ones of the grids, in their order. */
  constructor(definitions: LightGridDefinition[], states: LightEvent[]) {
    definitions.forEach((definition, i) => {
      let sum = this.#sums.find((other) => other.fits(definition));
      if (sum === undefined) this.#sums.push((sum = new SummedGrid(definition)));
      const state = states[i]!;
      sum.add(definition, state);
      this.#sumOf.set(state.asset, sum);
      for (const name of partsOfGrid(definition)) this.#factors.set(name, AS_BAKED);
    });
  }

  get names(): string[] {
    return [...this.#factors.keys()].filter((name) => name !== '' && name !== SKY);
  }

  get skyIsApart(): boolean {
    return this.#factors.has(SKY);
  }

  /** The grids that are looked up; behind those, where the sky's own light is apart, one without it, of what the pack is about. */
  get definitions(): LightGridDefinition[] {
    return [...this.#sums.map(({ definition }) => definition), ...this.#sums.flatMap((sum) => this.#withoutSky(sum) ?? [])];
  }

  states(): LightEvent[] {
    return this.#sums.map((sum) => sum.state(this.#factors)).concat(this.#sums.flatMap((sum) => this.#stateWithoutSky(sum)));
  }

  /** A newer state of a group's grid; gives those of the grids that are looked up. */
  receive(event: LightEvent): LightEvent[] {
    const sum = this.#sumOf.get(event.asset)!;
    sum.receive(event);
    return [sum.state(this.#factors), ...this.#stateWithoutSky(sum)];
  }

  /** Shadows are drawn of what the pack is about: around that the grid goes on to have the sky's light. */
  #withoutSky({ definition, namesOfSky }: SummedGrid): LightGridDefinition | null {
    const highest = Math.max(...this.#sums.map((sum) => sum.definition.priority ?? 0));
    if (namesOfSky.length === 0 || (definition.priority ?? 0) < highest) return null;
    const contains = definition.contains!.filter((what) => what !== 'environment');
    return { ...definition, stream: -1 - definition.stream, insteadOf: definition, contains };
  }

  #stateWithoutSky(sum: SummedGrid): LightEvent[] {
    const without = this.#withoutSky(sum);
    if (without === null) return [];
    return [{ ...sum.state(new Map([...this.#factors, [SKY, [0, 0, 0]]])), asset: without.stream }];
  }

  /** The grids of all groups matter as much as the one that is looked up. */
  weigh(weights: AssetWeight[]): AssetWeight[] {
    const known = new Map(weights);
    const ofGroups = [...this.#sumOf].map(([asset, sum]): AssetWeight => [asset, known.get(sum.asset) ?? 1]);
    return [...weights, ...ofGroups];
  }

  /** Sets the factor of a group, its lamps and what shines of them. Throws when there is no such group. */
  set(name: string, factor: number | Factor, lamps: Lamp[], opening: Opening): void {
    if (!this.names.includes(name)) throw new Error(`no light group "${name}": there are ${this.names.join(', ')}`);
    const of = factorOf(name, factor);
    this.#factors.set(name, of);
    for (const lamp of lamps) if (lamp.userData.group === name) tint(lamp.color, this.#lampColors, lamp, of);
    this.#tintSky(lamps);
    for (const definition of opening.extensions.LIGHTWELL_lamps?.lamps ?? [])
      if (definition.group === name) this.#tintSurface(definition, of, opening);
  }

  /** Sets the factor of the sky's own light. Throws when it is not apart. */
  setSky(factor: number | Factor, lamps: Lamp[]): void {
    if (!this.skyIsApart) throw new Error("the sky's own light is not apart from the rest in this pack");
    this.#factors.set(SKY, factorOf('sky', factor));
    this.#tintSky(lamps);
  }

  /** As a lamp the sky has the factors of its grid. */
  #tintSky(lamps: Lamp[]): void {
    // Of several places the sums have the same parts.
    const names = this.#sums.map(({ namesOfSky }) => namesOfSky).find(({ length }) => length > 0) ?? [];
    const of = product(names.map((name) => this.#factors.get(name)!));
    for (const lamp of lamps) {
      if (lamp.definition.kind !== 'sky') continue;
      tint(lamp.color, this.#lampColors, lamp, of);
      lamp.userData.inGrids = of;
    }
  }

  /** The surface that a lamp stands for; its material may be that of others, too. */
  #tintSurface({ node, primitive }: LampDefinition, factor: Factor, opening: Opening): void {
    if (node === undefined || primitive === undefined) return;
    for (const mesh of opening.meshesOf(node, primitive)) {
      // A glTF primitive has one material.
      const shared = mesh.material as Material & { emissive?: Color };
      if (shared.emissive === undefined) continue;
      const own = this.#emissive.has(shared) ? shared : shared.clone();
      mesh.material = own;
      tint(own.emissive!, this.#emissive, own, factor);
    }
  }
}

/** What a grid's light is multiplied by: the factor of its group, and of the sky where it is the sky's own. */
function partsOfGrid({ group, contains }: LightGridDefinition): string[] {
  return contains?.includes('indirect') === false ? [group ?? '', SKY] : [group ?? ''];
}

function product(factors: Factor[]): Factor {
  return factors.reduce((all, of) => all.map((x, c) => x * of[c]!) as Factor, AS_BAKED);
}

/** Throws when it is none. */
function factorOf(name: string, factor: number | Factor): Factor {
  const of = typeof factor === 'number' ? ([factor, factor, factor] as Factor) : factor;
  if (of.length !== 3 || !of.every((channel) => channel >= 0 && Number.isFinite(channel)))
    throw new Error(`light group "${name}": the factor is no number or three of at least 0`);
  return of;
}

/** Sets a colour to what it was at first, times a factor. */
function tint<Owner>(color: Color, first: Map<Owner, Color>, owner: Owner, [r, g, b]: Factor): void {
  if (!first.has(owner)) first.set(owner, color.clone());
  const { r: r0, g: g0, b: b0 } = first.get(owner)!;
  color.setRGB(r0 * r, g0 * g, b0 * b);
}

/** Grids of the same cells, each of a part of the light, and their sum. */
class SummedGrid {
  /** By their assets; the sum has the first one's. */
  readonly #parts = new Map<number, { names: string[]; state: LightEvent }>();

  constructor(public definition: LightGridDefinition) {}

  get asset(): number {
    return this.#first!.asset;
  }

  get #first(): LightEvent | undefined {
    return this.#parts.values().next().value?.state;
  }

  /** What multiplies the sky's own light, where that is apart. */
  get namesOfSky(): string[] {
    return [...this.#parts.values()].map(({ names }) => names).find((names) => names.includes(SKY)) ?? [];
  }

  fits({ min, cell, nodes, priority = 0 }: LightGridDefinition): boolean {
    const { definition } = this;
    const same = (a: number[], b: number[]) => a.every((x, i) => x === b[i]);
    return (
      priority === (definition.priority ?? 0) &&
      same(min, definition.min) &&
      same(cell, definition.cell) &&
      same(nodes, definition.nodes)
    );
  }

  add(definition: LightGridDefinition, state: LightEvent): void {
    const contains = [...new Set([...(this.definition.contains ?? []), ...(definition.contains ?? [])])];
    const bricks = [...new Set([...(this.definition.bricks ?? []), ...(definition.bricks ?? [])])];
    this.definition = { ...this.definition, contains, bricks };
    this.#parts.set(state.asset, { names: partsOfGrid(definition), state });
    this.#check(state);
  }

  receive(state: LightEvent): void {
    this.#check(state);
    this.#parts.get(state.asset)!.state = state;
  }

  state(factors: ReadonlyMap<string, Factor>): LightEvent {
    const summed = [...this.#parts.values()].map(({ names, state }) => ({
      atlas: state.atlas,
      factor: product(names.map((name) => factors.get(name) ?? AS_BAKED)),
    }));
    return { ...this.#first!, atlas: sumOf(summed, this.#first!) };
  }

  #check({ width, height, depth, asset }: LightEvent): void {
    const first = this.#first;
    if (first !== undefined && (first.width !== width || first.height !== height || first.depth !== depth))
      throw new Error(`the light of stream ${asset} has other cells than the rest of it`);
  }
}

/** The atlas of the sum of grids, each times its factor. What is not light is that of the first. */
function sumOf(grids: { atlas: Uint16Array; factor: Factor }[], size: LightEvent): Uint16Array<ArrayBuffer> {
  const halves = halfValues();
  const sum = new Uint16Array(grids[0]!.atlas);
  const { header, subVolume } = partsOf(sum, size);
  const strongest = Math.max(1, grids.reduce((all, { factor }) => all + Math.max(...factor), 0));
  const headroom = 2 ** -Math.ceil(Math.log2(strongest));
  const weights = new Float32Array(grids.length);
  for (let at = header; at < header + subVolume; at += 4) {
    const ofWeight = at + 6 * subVolume + 3;
    grids.forEach(({ atlas }, i) => (weights[i] = halves[atlas[ofWeight]!]!));
    const weight = Math.max(Math.min(...weights) * headroom, SMALLEST_NORMAL_HALF);
    sum[ofWeight] = toHalf(weight);
    for (let channel = 0; channel < WEIGHT_CHANNEL; channel++) {
      const place = at + (channel >> 2) * subVolume + (channel & 3);
      let value = 0;
      for (let i = 0; i < grids.length; i++)
        value += (halves[grids[i]!.atlas[place]!]! * grids[i]!.factor[channel % 3]! * weight) / weights[i]!;
      sum[place] = toHalf(value);
    }
  }
  // In a regular grid the first texels are its header and border at once.
  if (header === 0) sum.set(grids[0]!.atlas.subarray(0, 8));
  return sum;
}

/** Halves before the first sub-volume of an atlas, and in each. */
function partsOf(atlas: Uint16Array, { width, height, depth }: LightEvent): { header: number; subVolume: number } {
  const slice = 4 * width * height;
  const [, levels, slices, first] = Array.from(atlas.subarray(4, 8), (half) => halfValues()[half]!);
  if (levels === 0) return { header: 0, subVolume: (slice * depth) / SUB_VOLUMES };
  return { header: slice * first!, subVolume: slice * slices! };
}

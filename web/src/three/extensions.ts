// SPDX-License-Identifier: Apache-2.0
//
// What a pack's glTF extensions say; docs/format.md describes them.

type Triple = [number, number, number];

export interface StreamsExtension {
  version: number;
  id: string;
  /** In stops: pictures are multiplied by 2 to this power. */
  exposure?: number;
  /** What grids and lamps are counted from, in the glTF's coordinates: of scenes that lie far from theirs. */
  origin?: Triple;
}

/**
 * The asset that the stream of an extension refines, as updates and weights name it: in the packs of today the number of both
 * (lightwell/asset/asset.h).
 */
export const assetOf = (extension: { stream: number }): number => extension.stream;

/** On a primitive. */
export interface ProgressiveMeshExtension {
  stream: number;
  /** Which of the primitives that the stream refines together; 0 when left out. */
  region?: number;
  /** Of the final level. */
  faces: number;
  bounds: { min: Triple; max: Triple };
  /** Of the coarsest level of all regions: its distance from the final one, in metres of the mesh's space. Said of region 0 alone. */
  error: number;
  /** Accessors, by glTF's semantics, of what bends all vertices of the final level. */
  deformation?: { attributes: Record<string, number>; targets: Record<string, number>[] };
}

/** On a texture. */
export interface ProgressiveTextureExtension {
  stream: number;
  width: number;
  height: number;
  /** Smaller images of it, coarse to fine. */
  levels?: ProgressiveTextureExtension[];
}

export interface LightGridDefinition {
  stream: number;
  /** The first node's place. */
  min: Triple;
  /** From a node to the next, on each axis. */
  cell: Triple;
  nodes: Triple;
  /** In cells. */
  normalOffset: number;
  priority?: number;
  /** The light that the grid holds besides what bounced: 'environment' or lamps. */
  contains?: string[];
  /** Of the lamps whose light it holds. Absent: of all. */
  group?: string;
  /** No pack's: of a grid that is made of others and shown in the place of one, that one. */
  insteadOf?: LightGridDefinition;
  /** Streams of its finer cells, each of those in a box. */
  bricks?: { stream: number; min: Triple; max: Triple }[];
}

export interface LampDefinition {
  /** That it is switched and dimmed with. */
  group?: string;
  /** `sky`, which no pack has: all that surrounds it, where its light is apart in the grids. */
  kind: 'rectangle' | 'disc' | 'sphere' | 'point' | 'spot' | 'sun' | 'sky';
  center?: Triple;
  /** Where it shines. */
  normal?: Triple;
  /** Half the sides of a rectangle. */
  u?: Triple;
  v?: Triple;
  /** A rectangle or disc that shines to both sides. */
  twoSided?: boolean;
  /** Of a disc or sphere. */
  radius?: number;
  /** Of rectangles, discs and spheres, W/m2/sr. */
  radiance?: Triple;
  /** Of points and spots W/sr, of suns W/m2. */
  intensity?: Triple;
  /** Angles of a spot's cone, radians from its axis. */
  innerConeAngle?: number;
  outerConeAngle?: number;
  /** Metres; absent or 0: without end. */
  range?: number;
  /** The glTF node that it comes from. */
  node?: number;
  /** The primitive of that node's mesh whose surface shines. */
  primitive?: number;
}

/** The picture of what surrounds the scene: a byte of its texture stands for the radiance * 2 ^ (stops * (byte / 255 - 1)), 0 for none. */
export interface EnvironmentDefinition {
  texture: number;
  radiance: number;
  stops: number;
}

/** The pack's last mesh was merged from parts, of which a stream tells. */
export interface PartsDescription {
  stream: number;
  /** The number of the node that shows that mesh. */
  nodes: number;
  /** The number of that mesh. */
  meshes: number;
  /** How many materials the opening has. */
  materials: number;
}

/** The extensions that stand at the root of a pack's JSON. */
export interface PackExtensions {
  LIGHTWELL_streams?: StreamsExtension;
  LIGHTWELL_light_grids?: { grids: LightGridDefinition[] };
  LIGHTWELL_lamps?: { lamps: LampDefinition[] };
  LIGHTWELL_environment?: EnvironmentDefinition;
  LIGHTWELL_parts?: PartsDescription;
}

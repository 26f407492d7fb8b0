// SPDX-License-Identifier: Apache-2.0
//
// What the page and the worker say to each other. Buffers are transferred, never copied. An asset is a mesh, a light grid or an
// image, numbered as lightwell/asset/asset.h says.

/** Which stream goes first: the whole geometry, the whole light, or whatever lessens the error in the picture most. */
export type Strategy = 'interleave' | 'geometry' | 'light';

/** What the worker is told. */
export type Command =
  | { type: 'open'; url: string; wasm: string; strategy: Strategy }
  | { type: 'strategy'; strategy: Strategy }
  /** How much each asset matters to the present picture; the unit is of no account, 0 puts an asset last. */
  | { type: 'weights'; weights: [asset: number, weight: number][] }
  | { type: 'pause' }
  | { type: 'resume' }
  /** To be answered by the links of a light grid as far as it has come. */
  | { type: 'links'; asset: number }
  /** So many bytes of updates have reached the GPU: the worker may send as many more. */
  | { type: 'consumed'; bytes: number };

/** The pack's first part: a glTF binary that any loader reads. */
export interface OpeningEvent {
  type: 'opening';
  glb: ArrayBuffer;
}

export type Semantic = 'position' | 'normal' | 'texcoord_0' | 'texcoord_1' | 'color';
export type Component = 'i8' | 'u8' | 'i16' | 'u16' | 'f32';

/** One attribute of a mesh's vertices, an array of its own. */
export interface AttributeLayout {
  semantic: Semantic;
  component: Component;
  /** Numbers a vertex, without padding. */
  components: number;
  /** Bytes from a vertex to the next. */
  stride: number;
  normalized: boolean;
}

/** A mesh's buffers in their final sizes; comes before any other update of the mesh. */
export interface MeshEvent {
  type: 'mesh';
  asset: number;
  vertices: number;
  /** Three 32-bit indices each. */
  faces: number;
  attributes: AttributeLayout[];
}

/** The `buffer` of a RangeEvent that means the indices: of a region those of as many faces as it will have, then of the next. */
export const INDICES = 255;

/** New bytes of one of a mesh's buffers: an attribute's place in the layout, or INDICES. */
export interface RangeEvent {
  type: 'range';
  asset: number;
  buffer: number;
  /** In bytes, from the start of the buffer. */
  offset: number;
  data: Uint8Array<ArrayBuffer>;
}

/** The mesh may be drawn with so many faces: comes behind the ranges that make it so. */
export interface DrawEvent {
  type: 'draw';
  asset: number;
  vertices: number;
  /** Of each region. */
  faces: number[];
}

/** A light grid as a whole: the half-float RGBA texels of a 3D texture. */
export interface LightEvent {
  type: 'light';
  asset: number;
  width: number;
  height: number;
  depth: number;
  atlas: Uint16Array<ArrayBuffer>;
}

/** An image file, complete. */
export interface TextureEvent {
  type: 'texture';
  asset: number;
  /** In pixels, which the client has held against the file. */
  width: number;
  height: number;
  mimeType: string;
  file: ArrayBuffer;
}

/** What the file said of the parts that meshes were merged from: gzipped JSON, complete. */
export interface PartsEvent {
  type: 'parts';
  /** Bytes of the JSON. */
  inflated: number;
  file: ArrayBuffer;
}

export interface Share {
  done: number;
  total: number;
}

/** How much of a pack has arrived, and how fast the rest comes. */
export interface Progress {
  /** Bytes of the file. */
  bytes: Share;
  /** Bytes of meshes and textures. */
  geometry: Share;
  /** Bytes of light grids. */
  light: Share;
  faces: Share;
  nodes: Share;
  requests: number;
  /** Bytes a second over the last moments, 0 while nothing comes. */
  rate: number;
}

export interface ProgressEvent {
  type: 'progress';
  progress: Progress;
}

/** `waiting`: the server does not answer and is asked again and again; what has come is kept. */
export interface ConnectionEvent {
  type: 'connection';
  state: 'streaming' | 'waiting' | 'complete';
}

/** The links between neighbours of a light grid that walls block: x, y, z of both ends of each, in the grid's space. */
export interface LinksEvent {
  type: 'links';
  asset: number;
  ends: Float32Array<ArrayBuffer>;
}

/** Nothing more will come. What was handed over stays valid, unless the file was replaced by another. */
export interface FailureEvent {
  type: 'failure';
  reason: 'unreadable' | 'replaced' | 'refused';
  message: string;
}

export type UpdateEvent = MeshEvent | RangeEvent | DrawEvent | LightEvent | TextureEvent | PartsEvent;
export type PackEvent = OpeningEvent | UpdateEvent | ProgressEvent | ConnectionEvent | LinksEvent | FailureEvent;

/** The bytes of an update that flow control counts. */
export function payload(event: PackEvent): ArrayBuffer | null {
  switch (event.type) {
    case 'opening':
      return event.glb;
    case 'range':
      return event.data.buffer;
    case 'light':
      return event.atlas.buffer;
    case 'texture':
    case 'parts':
      return event.file;
    default:
      return null;
  }
}

// SPDX-License-Identifier: Apache-2.0
import { type BufferGeometry, type LoadingManager, Mesh, type Object3D, type Texture } from 'three';
import { type GLTF, GLTFLoader, type GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import {
  assetOf,
  type PackExtensions,
  type ProgressiveMeshExtension,
  type ProgressiveTextureExtension,
} from './extensions.js';
import { mapsOf, materialsOf, meshesIn } from './meshes.js';

/** A primitive that a stream refines, or a region of it: the meshes that show it, one for each node. */
export interface ProgressivePrimitive {
  extension: ProgressiveMeshExtension;
  meshes: Mesh[];
  base: BufferGeometry;
  /** Hands what bends its vertices over from the base to the geometry that takes its place. */
  bend?: (to: BufferGeometry) => void;
}

/** An image that a stream refines, or a level of one: the textures that show it, and the meshes whose materials have these. */
export interface ProgressiveImage {
  extension: ProgressiveTextureExtension;
  textures: Texture[];
  meshes: Mesh[];
  /** The longer side of what comes before it, in texels: of the level that is coarser, or of what the opening holds. */
  previewSize: number;
}

/** What three.js's own loader makes of a pack's opening, with what Lightwell's streams will refine. */
export interface Opening {
  gltf: GLTF;
  extensions: PackExtensions;
  /** By stream, each with its regions in their order. */
  primitives: Map<number, ProgressivePrimitive[]>;
  /** Levels behind the whole image, with the same arrays. */
  images: Map<number, ProgressiveImage>;
  /** The meshes that show a primitive of a glTF node's own mesh. */
  meshesOf(node: number, primitive: number): Mesh[];
}

/** Reads an opening. Its punctual lights are left out where LIGHTWELL_lamps lists them. */
export async function readOpening(glb: ArrayBuffer, manager: LoadingManager): Promise<Opening> {
  const loader = new GLTFLoader(manager);
  let hasLamps = false;
  loader.register((parser) => {
    hasLamps = extensionsOf(parser).LIGHTWELL_lamps !== undefined;
    return { name: hasLamps ? 'KHR_lights_punctual' : 'LIGHTWELL_lamps' };
  });
  const gltf = await loader.parseAsync(glb, '');
  gltf.scene.traverse((object) => {
    if (object.userData.gltfExtensions?.KHR_node_visibility?.visible === false) object.visible = false;
  });
  const primitives = progressivePrimitives(gltf);
  const bending = [...primitives.values()].flat().filter(({ extension }) => extension.deformation);
  if (bending.length > 0) await (await import('./deformation.js')).prepareDeformation(bending, gltf);
  return {
    gltf,
    extensions: extensionsOf(gltf.parser),
    primitives,
    images: progressiveImages(gltf),
    meshesOf: (node, primitive) => meshesOf(gltf, node, primitive),
  };
}

function extensionsOf(parser: GLTFParser): PackExtensions {
  return (parser.json as { extensions?: PackExtensions }).extensions ?? {};
}

/** A mesh belongs to the nearest node above it, or to the one that it is itself. */
function meshesOf(gltf: GLTF, node: number, primitive: number): Mesh[] {
  const found: Mesh[] = [];
  const visit = (object: Object3D, above: number | undefined) => {
    const at = gltf.parser.associations.get(object) as { nodes?: number; primitives?: number } | undefined;
    const owner = at?.nodes ?? above;
    if (object instanceof Mesh && owner === node && at?.primitives === primitive) found.push(object);
    for (const child of object.children) visit(child, owner);
  };
  visit(gltf.scene, undefined);
  return found;
}

function progressivePrimitives(gltf: GLTF): Opening['primitives'] {
  const definitions = gltf.parser.json as { meshes?: { primitives: { extensions?: Record<string, unknown> }[] }[] };
  const primitives: Opening['primitives'] = new Map();
  for (const mesh of meshesIn(gltf.scene)) {
    const at = gltf.parser.associations.get(mesh) as { meshes?: number; primitives?: number } | undefined;
    const definition = definitions.meshes?.[at?.meshes ?? -1]?.primitives[at?.primitives ?? 0];
    const extension = definition?.extensions?.['LIGHTWELL_progressive_mesh'] as ProgressiveMeshExtension | undefined;
    if (extension === undefined) continue;
    const regions = primitives.get(assetOf(extension)) ?? [];
    primitives.set(assetOf(extension), regions);
    const known = regions.find((primitive) => primitive.extension === extension);
    if (known !== undefined) known.meshes.push(mesh);
    else regions.push({ extension, meshes: [mesh], base: mesh.geometry });
  }
  const place = ({ extension }: ProgressivePrimitive) => extension.region ?? 0;
  for (const regions of primitives.values()) regions.sort((a, b) => place(a) - place(b));
  return primitives;
}

function progressiveImages(gltf: GLTF): Map<number, ProgressiveImage> {
  const definitions = gltf.parser.json as { textures?: { extensions?: Record<string, unknown> }[] };
  const images = new Map<number, ProgressiveImage>();
  for (const [texture, meshes] of texturesOf(gltf.scene)) {
    const at = gltf.parser.associations.get(texture) as { textures?: number } | undefined;
    const extension = definitions.textures?.[at?.textures ?? -1]?.extensions?.['LIGHTWELL_progressive_texture'] as
      | ProgressiveTextureExtension
      | undefined;
    if (extension === undefined) continue;
    const known = images.get(assetOf(extension));
    const image = known ?? { extension, textures: [], meshes: [], previewSize: 0 };
    image.textures.push(texture);
    image.meshes.push(...meshes);
    images.set(assetOf(extension), image);
    if (known) continue;
    let before: { width: number; height: number } = texture.image as ImageBitmap;
    for (const level of [...(extension.levels ?? []), extension]) {
      images.set(assetOf(level), Object.assign(level === extension ? image : { ...image, extension: level }, { previewSize: Math.max(before.width, before.height) }));
      before = level;
    }
  }
  return images;
}

/** The textures of an object's materials, with the meshes that show each; none is there twice. */
function texturesOf(root: Object3D): Map<Texture, Set<Mesh>> {
  const textures = new Map<Texture, Set<Mesh>>();
  for (const mesh of meshesIn(root))
    for (const texture of materialsOf(mesh).flatMap(mapsOf))
      textures.set(texture, (textures.get(texture) ?? new Set()).add(mesh));
  return textures;
}

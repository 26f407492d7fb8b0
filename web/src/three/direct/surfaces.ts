// SPDX-License-Identifier: Apache-2.0
import type { Camera, InstancedMesh, Material, Mesh, MeshBasicMaterial, MeshStandardMaterial, Object3D, Scene, Side, SkinnedMesh, WebGLRenderer } from 'three';
import { three } from './kit.js';

/** What of a scene's meshes is drawn: those that cast shadows, from both sides, or those that are seen and not seen through, or their colours. */
export type Part = 'casters' | 'seen' | 'colours';

const NOTHING = () => {};

/** What shaders/seen_surface.glsl unpacks: behind the texts of three.js's material for depths. */
const VARYING = 'varying vec3 vPlace, vShading;';
const VERTEX = `#ifndef USE_DISPLACEMENTMAP
#include <beginnormal_vertex>
#include <morphnormal_vertex>
#include <skinnormal_vertex>
#endif
#include <defaultnormal_vertex>
vPlace=mvPosition.xyz;vShading=transformedNormal;}`;
const PACK = `vec2 packNormal(vec3 n){n/=abs(n.x)+abs(n.y)+abs(n.z);
return n.z<0.0?(1.0-abs(n.yx))*vec2(n.x<0.0?-1.0:1.0,n.y<0.0?-1.0:1.0):n.xy;}`;
/** Without normals the shading is flat; of a surface that is seen from behind they are turned. */
const FRAGMENT = `vec3 n=normalize(cross(dFdx(vPlace),dFdy(vPlace)));
float along=dot(n,vShading);
#ifdef FLAT
along=0.0;
#endif
vec2 shading=floor(2047.5*packNormal(along==0.0?n:along*vShading)+2048.0);
gl_FragColor=vec4(packNormal(n),-vPlace.z,4096.0*shading.x+shading.y);}`;

/**
 * Draws the surfaces of somebody's scene by materials of its own: depths alone, each surface's normal and distance, or its colour. Cut-out
 * materials stay cut out; forms that change, skeletons and instances are drawn as three.js has them.
 */
export class Surfaces {
  /** Has the scene's children, and nothing of its background, fog and callbacks. */
  readonly #scene: Scene;
  readonly #hidden = new three.MeshBasicMaterial({ visible: false });
  readonly #plain = new Map<string, Material>();
  readonly #cutOut = new WeakMap<Material, Map<string, Material>>();
  readonly #coloured = new WeakMap<Material, MeshBasicMaterial>();
  readonly #own = new Set<Material>();

  constructor(readonly renderer: WebGLRenderer) {
    this.#scene = new three.Scene();
    this.#scene.matrixWorldAutoUpdate = false;
  }

  /** Draws all below `root` as often as `draw` calls back with a camera, whose matrices are as they are to be. */
  draw(root: Object3D, part: Part, draw: (render: (camera: Camera) => void) => void): void {
    const before: [Mesh, Material | Material[], Mesh['onBeforeRender']][] = [];
    root.traverseVisible((object) => {
      const mesh = object as Mesh;
      if (mesh.material === undefined) return;
      before.push([mesh, mesh.material, mesh.onBeforeRender]);
      const { material } = mesh;
      const own = (of: Material) => this.#materialOf(mesh, of, part);
      mesh.material = Array.isArray(material) ? material.map(own) : own(material);
      mesh.onBeforeRender = NOTHING;
    });
    this.#scene.children = root.children;
    try {
      draw((camera) => this.renderer.render(this.#scene, camera));
    } finally {
      for (const [mesh, material, onBeforeRender] of before) Object.assign(mesh, { material, onBeforeRender });
      this.#scene.children = [];
    }
  }

  dispose(): void {
    for (const material of this.#own) material.dispose();
    this.#hidden.dispose();
  }

  #materialOf(mesh: Mesh, of: Material, part: Part): Material {
    const { transparent, transmission = 0, visible } = of as Material & { transmission?: number };
    const drawn = transmission === 0 && (part === 'casters' ? mesh.castShadow : !transparent);
    if (!mesh.isMesh || !visible || !drawn) return this.#hidden;
    if (part === 'colours') return this.#colouredAs(of);
    const { flatShading = false } = of as MeshStandardMaterial;
    const key = part === 'casters' ? part : `${of.side}${flatShading}`;
    // What is seen through casts a share of a shadow: some of its places do.
    const cut = of.alphaTest > 0 || of.alphaHash || transparent;
    let known = this.#plain;
    if (cut) {
      known = this.#cutOut.get(of) ?? new Map<string, Material>();
      this.#cutOut.set(of, known);
    }
    const material = known.get(key) ?? this.#create(part, part === 'casters' ? three.DoubleSide : of.side, flatShading);
    known.set(key, material);
    if (cut) {
      const { map, alphaMap, alphaTest, opacity } = of as MeshStandardMaterial;
      Object.assign(material, { map, alphaMap, alphaTest, opacity, alphaHash: of.alphaHash || transparent });
    }
    return material;
  }

  #colouredAs(of: Material): Material {
    const material = this.#coloured.get(of) ?? new three.MeshBasicMaterial({ blending: three.NoBlending, toneMapped: false });
    this.#coloured.set(of, material);
    this.#own.add(material);
    const { color = material.color, map = null, alphaMap = null, alphaTest, opacity, alphaHash, vertexColors, side } = of as MeshStandardMaterial;
    return Object.assign(material, { color, map, alphaMap, alphaTest, opacity, alphaHash, vertexColors, side });
  }

  #create(part: Part, side: Side, flat: boolean): Material {
    const material = new three.MeshDepthMaterial({ side, blending: three.NoBlending, colorWrite: part === 'seen' });
    this.#own.add(material);
    if (part === 'casters') return material;
    material.onBeforeCompile = (shader) => {
      shader.vertexShader = [VARYING, shader.vertexShader.replace(/}\s*$/, VERTEX)].join('\n');
      shader.fragmentShader = [VARYING, PACK, shader.fragmentShader.replace(/}\s*$/, FRAGMENT)].join('\n');
      if (flat) shader.fragmentShader = `#define FLAT\n${shader.fragmentShader}`;
    };
    material.customProgramCacheKey = () => `seen${flat}`;
    return material;
  }
}

/** A number that changes when a surface moves, changes its form, comes or goes. */
export function signatureOf(root: Object3D): number {
  let sum = 0;
  let weight = 1;
  const add = (numbers: ArrayLike<number>) => {
    for (let i = 0; i < numbers.length; i++) sum += numbers[i]! * (weight = (weight * 1.618034) % 7);
  };
  root.traverseVisible((object) => {
    const mesh = object as Mesh;
    if (!mesh.isMesh) return;
    const { geometry, matrixWorld, morphTargetInfluences, castShadow } = mesh;
    add(matrixWorld.elements);
    add([geometry.id, Number(castShadow)]);
    if (morphTargetInfluences !== undefined) add(morphTargetInfluences);
    const { skeleton, instanceMatrix } = object as Partial<SkinnedMesh> & Partial<InstancedMesh>;
    if (skeleton?.boneMatrices) add(skeleton.boneMatrices);
    if (instanceMatrix !== undefined) add([instanceMatrix.version]);
  });
  return sum;
}

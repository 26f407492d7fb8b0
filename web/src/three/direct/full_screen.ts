// SPDX-License-Identifier: Apache-2.0
import type { BufferGeometry, IUniform, Mesh, RawShaderMaterial, WebGLRenderer, WebGLRenderTarget } from 'three';
import { three } from './kit.js';

const CORNERS = new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]);
const VERTEX_SHADER = 'in vec3 position;void main(){gl_Position=vec4(position,1.0);}';

/** The text of a pass whose target becomes what a texture is, texel for texel. */
export const COPY = `precision highp float;uniform highp sampler2D copied;out vec4 result;
void main(){result=texelFetch(copied,ivec2(gl_FragCoord.xy),0);}`;

/** What all passes draw: one triangle over everything. */
export const createScreen = (): BufferGeometry =>
  new three.BufferGeometry().setAttribute('position', new three.BufferAttribute(CORNERS, 3));

/** A fragment shader over all of a target, or over the part that its viewport says. */
export class FullScreen {
  readonly #mesh: Mesh;
  readonly #scene = new three.Scene();
  readonly #camera = new three.OrthographicCamera();
  readonly material: RawShaderMaterial;

  constructor(screen: BufferGeometry, fragmentShader: string, uniforms: Record<string, IUniform>, defines: Record<string, string> = {}) {
    const state = { depthTest: false, depthWrite: false, blending: three.NoBlending, glslVersion: three.GLSL3 };
    this.material = new three.RawShaderMaterial({ ...state, vertexShader: VERTEX_SHADER, fragmentShader, uniforms, defines });
    this.#mesh = new three.Mesh(screen, this.material);
    this.#mesh.frustumCulled = false;
    this.#scene.add(this.#mesh);
  }

  draw(renderer: WebGLRenderer, target: WebGLRenderTarget, values: Record<string, unknown>): void {
    for (const [name, value] of Object.entries(values)) this.material.uniforms[name]!.value = value;
    this.material.uniformsNeedUpdate = true;
    renderer.setRenderTarget(target);
    renderer.render(this.#scene, this.#camera);
  }

  dispose(): void {
    this.material.dispose();
  }
}

// SPDX-License-Identifier: Apache-2.0
//
// Percentage-closer soft shadows (R. Fernando, SIGGRAPH 2005 sketches): one map from the lamp's middle; the mean depth of what is in the way gives the
// penumbra's width, over which the map is filtered. In the place of three.js's own lookup, as in its example, with more samples: grids of
// 8 x 8, and the receiver's plane (J. Isidoro, GDC 2006) in the place of a bias. All of it is there in the first frame.
import * as THREE from 'three';
import { JitteredLamp, sharesOf } from './jittered.js';
import { pixelsOf, renderer, stage } from './stage.js';

/** The last of three.js's lookups is that without a filter. */
const OWN_LOOKUP = 'float getShadow( sampler2D shadowMap,';

/** `shadowRadius`: of the lamp, as wide as it is at a distance of 1, in widths of the map; `nearest` is what may be in the way. */
const LOOKUP = ({ near, far }, nearest) => `
const int SIDE=8;
float distanceOf(float depth){return ${near.toFixed(4)}*${far.toFixed(4)}/(${far.toFixed(4)}-depth*${(far - near).toFixed(4)});}
vec2 offset(int i){return (2.0*vec2(float(i%SIDE),float(i/SIDE))+1.0)/float(SIDE)-1.0;}
float getShadow(sampler2D shadowMap,vec2 shadowMapSize,float shadowIntensity,float shadowBias,float shadowRadius,vec4 shadowCoord){
  float away=shadowCoord.w;
  vec3 at=shadowCoord.xyz/away;
  vec3 dx=dFdx(at),dy=dFdy(at);
  vec2 slope=vec2(dy.y*dx.z-dx.y*dy.z,dx.x*dy.z-dy.x*dx.z)/(dx.x*dy.y-dx.y*dy.x);
  if(any(lessThan(at.xy,vec2(0.0)))||any(greaterThan(at.xy,vec2(1.0))))return 1.0;
  float search=shadowRadius*max(0.0,1.0/${nearest.toFixed(4)}-1.0/away);
  float sum=0.0,count=0.0;
  for(int i=0;i<SIDE*SIDE;i++){
    vec2 by=search*offset(i);
    float depth=texture2D(shadowMap,at.xy+by).r;
    if(depth<at.z+dot(slope,by)+shadowBias){sum+=distanceOf(depth);count+=1.0;}
  }
  if(count==0.0)return 1.0;
  float width=shadowRadius*max(0.0,count/sum-1.0/away);
  float lit=0.0;
  for(int i=0;i<SIDE*SIDE;i++){
    vec2 by=width*offset(i);
    if(texture2D(shadowMap,at.xy+by).r>=at.z+dot(slope,by)+shadowBias)lit+=1.0;
  }
  return lit/float(SIDE*SIDE);
}
float getHardShadow( sampler2D shadowMap,`;

export function pcss(definition, counts) {
  const { scene, meshes, camera } = stage(definition);
  const lamp = new JitteredLamp(definition.lamp, 'spot', 1);
  scene.add(...lamp.lights);
  const [{ shadow, angle }] = lamp.lights;
  shadow.radius = Math.hypot(...definition.lamp.u) / (2 * Math.tan(angle));
  shadow.bias = -1e-5;
  const { ShaderChunk } = THREE;
  const own = ShaderChunk.shadowmap_pars_fragment;
  const at = own.lastIndexOf(OWN_LOOKUP);
  if (at < 0) throw new Error('the lookup of shadows is not that of three.js 0.187');
  const text = own.slice(0, at) + LOOKUP(shadow.camera, definition.nearest) + own.slice(at + OWN_LOOKUP.length);
  for (const mesh of meshes)
    mesh.material.onBeforeCompile = (shader) => (shader.fragmentShader = shader.fragmentShader.replace('#include <shadowmap_pars_fragment>', text));
  const { type } = renderer.shadowMap;
  renderer.shadowMap.type = THREE.BasicShadowMap;
  const shares = sharesOf(pixelsOf(scene, camera));
  renderer.shadowMap.type = type;
  return counts.map(() => shares);
}

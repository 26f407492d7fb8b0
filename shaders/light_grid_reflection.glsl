// SPDX-License-Identifier: Apache-2.0
//
// To be appended to three.js's chunk lights_fragment_maps (0.187), before the reflection is shaded: gives metals the light
// that light_grid.glsl looked up for the surface's normal, in the reflected direction.

#if NUM_LIGHT_PROBE_GRIDS > 0 && defined( RE_IndirectSpecular )

	radiance += getLightProbeGridRadiance( transformDirectionByInverseViewMatrix( reflect( - geometryViewDir, geometryNormal ), viewMatrix ) );

#endif

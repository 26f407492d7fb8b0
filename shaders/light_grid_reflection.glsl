// SPDX-License-Identifier: Apache-2.0
//
// To be appended to three.js's chunk lights_fragment_maps (0.187), before the reflection is shaded: gives metals the light
// that light_grid.glsl looked up for the surface's normal, in the reflected direction, and counts the environment once. Where
// the grid holds its light, it does not light by itself, and what it mirrors is sharper than what the grid would.

#if NUM_LIGHT_PROBE_GRIDS > 0

	#if defined( RE_IndirectDiffuse )

		if ( lightProbeSample.sky ) iblIrradiance = vec3( 0.0 );

	#endif

	#if defined( RE_IndirectSpecular )

		#ifdef USE_ENVMAP
			if ( ! lightProbeSample.sky )
		#endif
		radiance += getLightProbeGridRadiance( transformDirectionByInverseViewMatrix( reflect( - geometryViewDir, geometryNormal ), viewMatrix ) );

	#endif

#endif

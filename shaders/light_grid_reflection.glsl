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

		// What a rough surface reflects more than once comes from everywhere. three.js takes it from the irradiance of environments
		// alone, without which rough metals and the rims of everything are too dark; here it is part of what is reflected once.
		vec3 onceByDielectric = vec3( 0.0 );
		vec3 onceByMetal = vec3( 0.0 );
		vec3 moreByDielectric = vec3( 0.0 );
		vec3 moreByMetal = vec3( 0.0 );
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, onceByDielectric, moreByDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, onceByMetal, moreByMetal );
		vec3 once = mix( onceByDielectric, onceByMetal, material.metalness );
		vec3 more = mix( moreByDielectric, moreByMetal, material.metalness );
		radiance += more / max( once, vec3( 1e-4 ) ) * getLightProbeGridRadiance( transformDirectionByInverseViewMatrix( geometryNormal, viewMatrix ) );

	#endif

#endif

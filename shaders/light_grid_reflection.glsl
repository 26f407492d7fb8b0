// SPDX-License-Identifier: Apache-2.0
//
// To be appended to three.js's chunk lights_fragment_maps (0.187), before the reflection is shaded: gives metals the light
// that light_grid.glsl looked up for the surface's normal, in the reflected direction, and counts the environment once. Where
// the grid holds its light, it does not light by itself.

#if NUM_LIGHT_PROBE_GRIDS > 0

	#if defined( RE_IndirectDiffuse )

		if ( ( lightProbeSample.marks & 1 ) != 0 ) iblIrradiance = vec3( 0.0 );

	#endif

	#if defined( RE_IndirectSpecular )

		vec3 reflected = reflect( - geometryViewDir, geometryNormal );
		vec3 baked = getLightProbeGridRadiance( transformDirectionByInverseViewMatrix( reflected, viewMatrix ) );

		#if defined( USE_ENVMAP ) && defined( STANDARD )

			// What is mirrored of the environment is sharp in its picture and dimmed where surfaces hide it in the grid: as much of
			// the grid's light as can be the environment's is taken for that, and shown as the picture has it. Together they are as
			// bright as the grid, and on what is rough no other.
			if ( ( lightProbeSample.marks & 1 ) != 0 ) {

				vec3 open = getIBLIrradiance( reflected ) * RECIPROCAL_PI;
				vec3 part = baked / max( open, vec3( 1e-6 ) );
				float share = min( 1.0, min( part.r, min( part.g, part.b ) ) );
				radiance *= share;
				baked -= share * open;

			}

		#endif

		radiance += baked;

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

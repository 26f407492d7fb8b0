// SPDX-License-Identifier: Apache-2.0
//
// To be appended to three.js's chunk lights_fragment_maps (0.187), behind light_grid_reflection.glsl (a pack's grids are made before its
// lamps): adds the sky where it is shown as a lamp (direct_light.glsl) and the grid that was looked up is without it.

#if NUM_SPOT_LIGHT_MAPS > 0 && NUM_LIGHT_PROBE_GRIDS > 0

	if ( skyLight.lit && ( lightProbeSample.marks & 4 ) != 0 ) {

		#if defined( RE_IndirectDiffuse )

			// What hides the sky within a cell, unknown to the grid of reflected light, is as bright as the fragment (lightwell/render/folds.h).
			#ifdef STANDARD
				vec3 albedo = material.diffuseContribution * ( 1.0 - onceByDielectric - moreByDielectric );
			#else
				vec3 albedo = material.diffuseColor;
			#endif
			vec3 ofGrid = PI * getLightProbeGridRadiance( transformDirectionByInverseViewMatrix( geometryNormal, viewMatrix ) );
			vec3 inFold = ( skyLight.irradiance + ofGrid ) / ( 1.0 - min( albedo * skyLight.hidden, 0.95 ) );
			irradiance += max( skyLight.irradiance, inFold ) - ofGrid;
			iblIrradiance = vec3( 0.0 );

		#endif

		#if defined( RE_IndirectSpecular )

			// The picture of the sky is sharper than the moments of its light, where there is one.
			#ifdef USE_ENVMAP
				radiance += ( skyLight.share - 1.0 ) * iblRadiance;
				#ifdef USE_CLEARCOAT
					clearcoatRadiance *= skyLight.share;
				#endif
			#else
				radiance += skyLight.mirrored;
			#endif
			radiance += more / max( once, vec3( 1e-4 ) ) * skyLight.irradiance * RECIPROCAL_PI;

		#endif

	}

#endif

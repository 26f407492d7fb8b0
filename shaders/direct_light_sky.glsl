// SPDX-License-Identifier: Apache-2.0
//
// To be appended to three.js's chunk lights_fragment_maps (0.187), behind light_grid_reflection.glsl (a pack's grids are made before its
// lamps): adds the sky where it is shown as a lamp (direct_light.glsl) and the grid that was looked up is without it.

#if NUM_SPOT_LIGHT_MAPS > 0 && NUM_LIGHT_PROBE_GRIDS > 0

	if ( skyLight.lit && ( lightProbeSample.marks & 4 ) != 0 ) {

		#if defined( RE_IndirectDiffuse )

			irradiance += skyLight.irradiance;
			iblIrradiance = vec3( 0.0 );

			// Of what hides the sky within a cell the grid of reflected light knows nothing: it is as bright as the fragment (lightwell/render/folds.h).
			#ifdef STANDARD
				vec3 albedo = material.diffuseContribution;
			#else
				vec3 albedo = material.diffuseColor;
			#endif
			irradiance = max( skyLight.irradiance, irradiance / ( 1.0 - min( albedo * skyLight.hidden, 0.95 ) ) );

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

// SPDX-License-Identifier: Apache-2.0
//
// To be put before the lookup of a spot light's map in three.js's chunk lights_fragment_begin (0.187): where the spot light stands for
// the lamps of a pack, each of these lights the fragment, and gloss mirrors those that have an area (direct_light_gloss.glsl).

if ( spotLight.decay == LAMPS_OF_PACK ) {

	vec4 head = texelFetch( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], ivec2( 0 ), 0 );
	bool shadowed = receiveShadow && head.y > 0.5;
	ivec2 place = shadowed ? getPlaceOfShares( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], - geometryPosition.z ) : ivec2( 0 );
	#ifdef STANDARD
		#ifndef USE_ANISOTROPY
			GlossLobe lobe = getGlossLobe( geometryNormal, geometryViewDir, material.roughness );
		#endif
		#ifdef USE_RETROREFLECTION
			GlossLobe lobeBack = getGlossLobe( geometryNormal, reflect( - geometryViewDir, geometryNormal ), material.roughness );
		#endif
		#ifdef USE_CLEARCOAT
			GlossLobe lobeOfCoat = getGlossLobe( geometryClearcoatNormal, geometryViewDir, material.clearcoatRoughness );
			vec3 allOfCoat = EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, vec3( 1.0 ), 1.0, material.clearcoatRoughness );
		#endif
	#endif
	for ( int k = 0; k < int( head.x ); k ++ ) {

		Lamp lamp = readLamp( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], k );
		if ( lamp.kind == LAMP_SKY ) {

			// Farther away is no shadow of it, and what stands there has light of its own grid, or of another pack's.
			vec3 way = geometryPosition - lamp.position;
			if ( dot( way, way ) > pow2( lamp.range ) ) continue;
			vec3 mirrored = reflect( - geometryViewDir, geometryNormal );
			vec3 open = getSkyIrradiance( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], geometryNormal );
			skyLight.lit = true;
			skyLight.share = lamp.color;
			skyLight.hidden = vec3( 0.0 );
			if ( shadowed ) {

				for ( int c = 0; c < 3; c ++ ) {

					float share = getShareOfLamp( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], place, lamp.share + c );
					skyLight.share[ c ] *= share;
					skyLight.hidden[ c ] = getShareOfLamp( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], place, lamp.share + 3 + c ) - share;

				}
				skyLight.hidden *= getWeightOfSkyShares( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], open );

			}
			skyLight.irradiance = skyLight.share * open;
			skyLight.mirrored = skyLight.share * getSkyIrradiance( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], mirrored ) * RECIPROCAL_PI;
			continue;

		}
		float reach = getLamp( lamp, geometryPosition, geometryNormal, directLight );
		float share = shadowed ? getShareOfLamp( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], place, lamp.share ) : 1.0;
		directLight.color *= share;
		if ( directLight.color == vec3( 0.0 ) ) continue;
		#ifdef STANDARD
			vec3 specular = reflectedLight.directSpecular;
			float roughness = material.roughness;
			#ifdef USE_CLEARCOAT
				vec3 clearcoatSpecular = clearcoatSpecularDirect;
			#endif
			// Gloss that depends on the direction in the surface shows a large lamp as large by a rougher surface.
			#ifdef USE_ANISOTROPY
				material.roughness = min( sqrt( sqrt( pow4( roughness ) + 0.25 * pow2( reach ) ) ), 1.0 );
			#endif
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
		#ifdef STANDARD
			material.roughness = roughness;
			if ( lamp.kind > LAMP_SPHERE ) continue;
			vec3 radiance = lamp.color * share;
			#ifndef USE_ANISOTROPY
				vec2 seen = getLampInGloss( lamp, geometryPosition, geometryNormal, lobe );
				#ifdef USE_RETROREFLECTION
					vec2 seenBack = getLampInGloss( lamp, geometryPosition, geometryNormal, lobeBack );
					seen = mix( seen, seenBack, saturate( material.retroreflectivity ) );
				#endif
				vec3 gloss = material.specularColorBlended * seen.x + material.specularF90 * seen.y;
				#ifdef USE_IRIDESCENCE
					gloss = mix( gloss, material.iridescenceFresnel * ( seen.x + seen.y ), material.iridescence );
				#endif
				#ifdef USE_SHEEN
					float sheenThere = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
					float sheenBack = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
					gloss *= 1.0 - max3( material.sheenColor ) * max( sheenThere, sheenBack );
				#endif
				gloss *= ( material.dfg.x + material.dfg.y ) * material.multiScatteringCompensation;
				reflectedLight.directSpecular = specular + radiance * gloss;
			#endif
			#ifdef USE_CLEARCOAT
				vec2 seenInCoat = getLampInGloss( lamp, geometryPosition, geometryClearcoatNormal, lobeOfCoat );
				vec3 coat = material.clearcoatF0 * seenInCoat.x + material.clearcoatF90 * seenInCoat.y;
				clearcoatSpecularDirect = clearcoatSpecular + radiance * coat * allOfCoat;
			#endif
		#endif

	}
	directLight.color = vec3( 0.0 );

} else {

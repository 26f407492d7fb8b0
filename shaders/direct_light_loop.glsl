// SPDX-License-Identifier: Apache-2.0
//
// To be put before the lookup of a spot light's map in three.js's chunk lights_fragment_begin (0.187): where the spot light stands for
// the lamps of a pack, each of these lights the fragment. Gloss shows a large lamp as large, by a rougher surface.

if ( spotLight.decay == LAMPS_OF_PACK ) {

	vec4 head = texelFetch( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], ivec2( 0 ), 0 );
	bool shadowed = receiveShadow && head.y > 0.5;
	ivec2 place = shadowed ? getPlaceOfShares( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], - geometryPosition.z ) : ivec2( 0 );
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
		if ( shadowed ) directLight.color *= getShareOfLamp( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], place, lamp.share );
		#ifdef STANDARD
			float roughness = material.roughness;
			material.roughness = sqrt( sqrt( pow4( roughness ) + 0.25 * pow2( reach ) ) );
			material.roughness = min( material.roughness, 1.0 );
		#endif
		#ifdef USE_CLEARCOAT
			float clearcoatRoughness = material.clearcoatRoughness;
			material.clearcoatRoughness = min( sqrt( sqrt( pow4( clearcoatRoughness ) + 0.25 * pow2( reach ) ) ), 1.0 );
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
		#ifdef STANDARD
			material.roughness = roughness;
		#endif
		#ifdef USE_CLEARCOAT
			material.clearcoatRoughness = clearcoatRoughness;
		#endif

	}
	directLight.color = vec3( 0.0 );

} else {

// SPDX-License-Identifier: Apache-2.0
//
// The largest step of an encoded value, as it is shown, that is not seen, by the contrast around it, the standard deviation of encoded values:
// the map of Fournier and Peroche (WSCG 2005), as lightwell/render/permitted_difference.h has it, where its sources stand. Both in 255ths here.

const vec2 PERMITTED_DIFFERENCES[ 6 ] = vec2[ 6 ]( vec2( 2.0, 1.0 ), vec2( 4.0, 1.537 ), vec2( 8.0, 2.362 ), vec2( 16.0, 3.63 ),
	vec2( 32.0, 5.579 ), vec2( 36.0, 6.0 ) );

float getPermittedDifference( float contrast ) {

	float permitted = PERMITTED_DIFFERENCES[ 0 ].y;
	for ( int i = 1; i < 6; i ++ ) {

		vec2 from = PERMITTED_DIFFERENCES[ i - 1 ], to = PERMITTED_DIFFERENCES[ i ];
		permitted += ( to.y - from.y ) * clamp( ( contrast * 255.0 - from.x ) / ( to.x - from.x ), 0.0, 1.0 );

	}
	return permitted / 255.0;

}

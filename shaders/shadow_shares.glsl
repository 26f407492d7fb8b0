// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass into the picture that materials read (direct_light.glsl): the distance of what is seen, and six shares, two in a float as
// whole numbers of 12 bits: the ratios of lamps' sums, and behind those what is the same without sums. Where the view before saw the same place, its share of a
// lamp counts, too, the less the more samples there are (docs/light.md section 7). Comes behind direct_light.glsl and seen_surface.glsl.

uniform sampler2D sums[ 6 ];
uniform sampler2D ready;        // three shares without sums
uniform int firstReady;         // which of the six the first of those is
uniform bool readyForSums;      // whether they stand for the three before them, too
uniform ivec2 start;
uniform int firstShare;         // of the six
uniform sampler2D known;        // the picture of the view before
uniform float knownWeights[ 6 ]; // by how much of 1 its shares count
uniform mat4 toKnown;           // from the camera's space into that view's
uniform mat4 knownProjection;

out vec4 result;

// How far, of the distance, what the view before saw may be from the surface's plane, and how flat it may have seen it (cosine).
const float SAME_PLACE = 0.005, FLATTEST = 0.05;

float bitsOf( float share ) {

	return floor( 4095.0 * clamp( share, 0.0, 1.0 ) + 0.5 );

}

// Shares of a place in the picture of the view before, between its pixels.
struct KnownPlace {
	ivec2 pixels[ 4 ];
	float weights[ 4 ];  // together 1, or all 0 where that view did not see the place
};

KnownPlace getKnownPlace( vec3 position, vec3 normal ) {

	KnownPlace place;
	vec2 size = texelFetch( known, ivec2( 0 ), 0 ).zw;
	vec4 clip = knownProjection * vec4( position, 1.0 );
	vec2 at = ( 0.5 + 0.5 * clip.xy / clip.w ) * size;
	bool outside = clip.w <= 0.0 || any( lessThan( at, vec2( 0.0 ) ) ) || any( greaterThan( at, size ) );
	vec2 first = floor( at - 0.5 ), f = at - 0.5 - first;
	float sum = 0.0;
	for ( int i = 0; i < 4; i ++ ) {

		ivec2 by = ivec2( i & 1, i >> 1 );
		ivec2 pixel = clamp( ivec2( first ) + by, ivec2( 0 ), ivec2( size ) - 1 );
		// Along the pixel's ray that view saw the surface's plane in front, or something else.
		vec2 middle = 2.0 * ( vec2( pixel ) + 0.5 ) / size - 1.0;
		vec3 eye = positionIn( knownProjection, middle, 0.0 ), ray = positionIn( knownProjection, middle, 1.0 ) - eye;
		float facing = dot( normal, ray );
		float distance = dot( normal, position - eye ) / facing;
		float off = abs( texelFetch( known, pixel + ivec2( 0, 1 ), 0 ).r - distance );
		bool same = ! outside && facing < - FLATTEST * length( ray ) && off < SAME_PLACE * distance;
		vec2 shares = mix( 1.0 - f, f, vec2( by ) );
		place.pixels[ i ] = pixel;
		place.weights[ i ] = same ? shares.x * shares.y : 0.0;
		sum += place.weights[ i ];

	}
	for ( int i = 0; i < 4; i ++ ) place.weights[ i ] = sum > 0.1 ? place.weights[ i ] / sum : 0.0;
	return place;

}

// A share of the picture before, and by how much of 1 it counts there.
vec2 getKnownShare( KnownPlace place, int share ) {

	vec2 sum = vec2( 0.0 );
	for ( int i = 0; i < 4; i ++ ) if ( place.weights[ i ] > 0.0 ) sum += place.weights[ i ] * vec2( getShareOfLamp( known, place.pixels[ i ], share ), 1.0 );
	return sum;

}

void main() {

	ivec2 pixel = ivec2( gl_FragCoord.xy ) - start;
	vec4 surface = texelFetch( surfaces, pixel, 0 );
	vec2 of[ 6 ] = vec2[ 6 ]( texelFetch( sums[ 0 ], pixel, 0 ).rg, texelFetch( sums[ 1 ], pixel, 0 ).rg, texelFetch( sums[ 2 ], pixel, 0 ).rg,
		texelFetch( sums[ 3 ], pixel, 0 ).rg, texelFetch( sums[ 4 ], pixel, 0 ).rg, texelFetch( sums[ 5 ], pixel, 0 ).rg );
	vec3 shares = texelFetch( ready, pixel, 0 ).rgb;
	float most = 0.0;
	for ( int i = 0; i < 6; i ++ ) most = max( most, knownWeights[ i ] );
	KnownPlace place;
	bool asksKnown = most > 0.0 && surface.b > 0.0;
	if ( asksKnown ) place = getKnownPlace( ( toKnown * vec4( positionOf( vec2( pixel ) + 0.5, surface.b ), 1.0 ) ).xyz, mat3( toKnown ) * unpackNormal( surface.rg ) );
	vec3 two = vec3( 0.0 );
	for ( int i = 0; i < 6; i ++ ) {

		int k = i - firstReady;
		if ( k < 0 && readyForSums ) k += 3;
		float share = k >= 0 && k < 3 ? shares[ k ] : of[ i ].x > 0.0 ? of[ i ].y / of[ i ].x : 1.0;
		if ( asksKnown && knownWeights[ i ] > 0.0 ) {

			vec2 before = getKnownShare( place, firstShare + i );
			share = mix( share, before.x, knownWeights[ i ] * before.y );

		}
		two[ i / 2 ] += bitsOf( share ) * ( i % 2 == 0 ? 4096.0 : 1.0 );

	}
	result = vec4( surface.b, two );

}

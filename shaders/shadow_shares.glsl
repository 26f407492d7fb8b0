// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass into the picture that materials read (direct_light.glsl): the distance of what is seen, and six shares, two in a float as
// whole numbers of 12 bits: the ratios of lamps' sums, and behind those what is the same without sums. Where the view before saw the same place, its share of a
// lamp counts, too, the less the more samples there are (docs/light.md section 7). Comes behind seen_surface.glsl.

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

// Six shares, two and two.
struct Shares {
	vec3 even;
	vec3 odd;
	float found;  // 1, or 0 where there are none
};

// Those that the view before knew of a place, between its pixels.
Shares getKnownShares( vec3 position, vec3 normal ) {

	Shares shares = Shares( vec3( 0.0 ), vec3( 0.0 ), 0.0 );
	vec2 size = texelFetch( known, ivec2( 0 ), 0 ).zw;
	vec4 clip = knownProjection * vec4( position, 1.0 );
	vec2 at = ( 0.5 + 0.5 * clip.xy / clip.w ) * size;
	if ( clip.w <= 0.0 || any( lessThan( at, vec2( 0.0 ) ) ) || any( greaterThan( at, size ) ) ) return shares;
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
		vec4 texel = texelFetch( known, pixel + ivec2( firstShare / 6 * int( size.x ), 1 ), 0 );
		if ( facing > - FLATTEST * length( ray ) || abs( texel.r - distance ) > SAME_PLACE * distance ) continue;
		vec2 parts = mix( 1.0 - f, f, vec2( by ) );
		float weight = parts.x * parts.y;
		vec3 even = floor( texel.gba / 4096.0 );
		shares.even += weight * even;
		shares.odd += weight * ( texel.gba - 4096.0 * even );
		sum += weight;

	}
	float each = 4095.0 * max( sum, 0.1 );
	return Shares( shares.even / each, shares.odd / each, sum > 0.1 ? 1.0 : 0.0 );

}

void main() {

	ivec2 pixel = ivec2( gl_FragCoord.xy ) - start;
	vec4 surface = texelFetch( surfaces, pixel, 0 );
	vec2 of[ 6 ] = vec2[ 6 ]( texelFetch( sums[ 0 ], pixel, 0 ).rg, texelFetch( sums[ 1 ], pixel, 0 ).rg, texelFetch( sums[ 2 ], pixel, 0 ).rg,
		texelFetch( sums[ 3 ], pixel, 0 ).rg, texelFetch( sums[ 4 ], pixel, 0 ).rg, texelFetch( sums[ 5 ], pixel, 0 ).rg );
	vec3 shares = texelFetch( ready, pixel, 0 ).rgb;
	float most = 0.0;
	for ( int i = 0; i < 6; i ++ ) most = max( most, knownWeights[ i ] );
	Shares before = Shares( vec3( 0.0 ), vec3( 0.0 ), 0.0 );
	if ( most > 0.0 && surface.b > 0.0 )
		before = getKnownShares( ( toKnown * vec4( positionOf( vec2( pixel ) + 0.5, surface.b ), 1.0 ) ).xyz, mat3( toKnown ) * unpackNormal( surface.rg ) );
	vec3 two = vec3( 0.0 );
	for ( int i = 0; i < 6; i ++ ) {

		int k = i - firstReady;
		if ( k < 0 && readyForSums ) k += 3;
		float share = k >= 0 && k < 3 ? shares[ k ] : of[ i ].x > 0.0 ? of[ i ].y / of[ i ].x : 1.0;
		share = mix( share, i % 2 == 0 ? before.even[ i / 2 ] : before.odd[ i / 2 ], knownWeights[ i ] * before.found );
		two[ i / 2 ] += bitsOf( share ) * ( i % 2 == 0 ? 4096.0 : 1.0 );

	}
	result = vec4( surface.b, two );

}

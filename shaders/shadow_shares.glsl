// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass into the picture that materials read (direct_light.glsl): the distance of what is seen, and six shares, two in a float as
// whole numbers of 12 bits: the ratios of lamps' sums, and behind those what is the same without sums.

precision highp float;
precision highp sampler2D;

uniform sampler2D surfaces;
uniform sampler2D sums[ 6 ];
uniform sampler2D ready;        // three shares without sums
uniform int firstReady;         // which of the six the first of those is
uniform ivec2 start;

out vec4 result;

float bitsOf( float share ) {

	return floor( 4095.0 * clamp( share, 0.0, 1.0 ) + 0.5 );

}

void main() {

	ivec2 pixel = ivec2( gl_FragCoord.xy ) - start;
	vec2 of[ 6 ] = vec2[ 6 ]( texelFetch( sums[ 0 ], pixel, 0 ).rg, texelFetch( sums[ 1 ], pixel, 0 ).rg, texelFetch( sums[ 2 ], pixel, 0 ).rg,
		texelFetch( sums[ 3 ], pixel, 0 ).rg, texelFetch( sums[ 4 ], pixel, 0 ).rg, texelFetch( sums[ 5 ], pixel, 0 ).rg );
	vec3 shares = texelFetch( ready, pixel, 0 ).rgb;
	vec3 two = vec3( 0.0 );
	for ( int i = 0; i < 6; i ++ ) {

		int k = i - firstReady;
		float share = k >= 0 && k < 3 ? shares[ k ] : of[ i ].x > 0.0 ? of[ i ].y / of[ i ].x : 1.0;
		two[ i / 2 ] += bitsOf( share ) * ( i % 2 == 0 ? 4096.0 : 1.0 );

	}
	result = vec4( texelFetch( surfaces, pixel, 0 ).b, two );

}

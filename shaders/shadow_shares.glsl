// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass into the picture that materials read (direct_light.glsl): the distance of what is seen, and of six lamps the ratio
// of their sums, two in a float as whole numbers of 12 bits.

precision highp float;
precision highp sampler2D;

uniform sampler2D surfaces;
uniform sampler2D sums[ 6 ];
uniform ivec2 start;

out vec4 result;

float ratioOf( vec2 sum ) {

	return floor( 4095.0 * ( sum.x > 0.0 ? clamp( sum.y / sum.x, 0.0, 1.0 ) : 1.0 ) + 0.5 );

}

void main() {

	ivec2 pixel = ivec2( gl_FragCoord.xy ) - start;
	vec2 a = texelFetch( sums[ 0 ], pixel, 0 ).rg, b = texelFetch( sums[ 1 ], pixel, 0 ).rg, c = texelFetch( sums[ 2 ], pixel, 0 ).rg;
	vec2 d = texelFetch( sums[ 3 ], pixel, 0 ).rg, e = texelFetch( sums[ 4 ], pixel, 0 ).rg, f = texelFetch( sums[ 5 ], pixel, 0 ).rg;
	vec3 high = vec3( ratioOf( a ), ratioOf( c ), ratioOf( e ) ), low = vec3( ratioOf( b ), ratioOf( d ), ratioOf( f ) );
	result = vec4( texelFetch( surfaces, pixel, 0 ).b, 4096.0 * high + low );

}

// SPDX-License-Identifier: Apache-2.0
//
// What a view shows at each pixel, for full-screen passes: to be put before them.

precision highp float;
precision highp sampler2D;

// Octahedral geometric normal; distance along the view, 0 where nothing is; octahedral normal of the shading, two whole numbers of 12 bits.
uniform sampler2D surfaces;
uniform mat4 projection;

vec3 unpackNormal( vec2 packed ) {

	vec3 n = vec3( packed, 1.0 - abs( packed.x ) - abs( packed.y ) );
	if ( n.z < 0.0 ) n.xy = ( 1.0 - abs( n.yx ) ) * vec2( n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0 );
	return normalize( n );

}

vec3 unpackShading( float packed ) {

	float x = floor( packed / 4096.0 );
	return unpackNormal( vec2( x, packed - 4096.0 * x ) / 2047.5 - 1.0 );

}

// What is seen at a place of the picture, in pixels, in the camera's space.
vec3 positionOf( vec2 place, float distance ) {

	vec2 at = 2.0 * place / vec2( textureSize( surfaces, 0 ) ) - 1.0;
	float w = projection[ 3 ][ 3 ] - projection[ 2 ][ 3 ] * distance;
	vec2 xy = at * w + vec2( projection[ 2 ].xy ) * distance - projection[ 3 ].xy;
	return vec3( xy / vec2( projection[ 0 ][ 0 ], projection[ 1 ][ 1 ] ), - distance );

}

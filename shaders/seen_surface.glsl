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

// A place at a distance along a view, in the view's space; `at` from -1 to 1 across its picture.
vec3 positionIn( mat4 view, vec2 at, float distance ) {

	float w = view[ 3 ][ 3 ] - view[ 2 ][ 3 ] * distance;
	vec2 xy = at * w + vec2( view[ 2 ].xy ) * distance - view[ 3 ].xy;
	return vec3( xy / vec2( view[ 0 ][ 0 ], view[ 1 ][ 1 ] ), - distance );

}

// What is seen at a place of the picture, in pixels, in the camera's space.
vec3 positionOf( vec2 place, float distance ) {

	return positionIn( projection, 2.0 * place / vec2( textureSize( surfaces, 0 ) ) - 1.0, distance );

}

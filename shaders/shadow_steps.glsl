// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass over tiles of a view: by which step of what is shown a lamp's newest samples change it, at all but a few of a tile's pixels, as
// a multiple of the largest step that is not seen. What is shown has half of the samples, so that the step is half of what the two halves differ by: the error of
// all of them, or less. Comes behind direct_light.glsl, three.js's chunk colorspace_pars_fragment, seen_surface.glsl
// and permitted_difference.glsl.

uniform sampler2D picture;      // what materials read now (direct_light.glsl)
uniform sampler2D sums[ 3 ];    // of the lamp, of each colour
uniform sampler2D colours;      // of the surfaces
uniform int share;              // the lamp's, or its first one
uniform float exposure;
uniform vec2 tiles;

out vec4 result;

// Of a tile's pixels so many, squared, are looked at, and three may be outliers: the rims of facets, which see a sliver of a lamp.
const int LOOKS = 8;
// Of its own white a screen reflects so much of the room's light (lightwell/render/permitted_difference.h).
const float REFLECTED = 0.005;
const vec3 LUMINANCE = vec3( 0.2126, 0.7152, 0.0722 );

float encode( float light ) {

	return sRGBTransferOETF( vec4( ( clamp( light, 0.0, 1.0 ) + REFLECTED ) / ( 1.0 + REFLECTED ) ) ).r;

}

// The irradiance of a lamp where nothing hides it.
vec3 getOpenIrradiance( Lamp lamp, vec3 position, vec3 normal ) {

	if ( lamp.kind == LAMP_SKY ) return lamp.color * getSkyIrradiance( picture, normal );
	IncidentLight light;
	getLamp( lamp, position, normal, light );
	return light.color * max( 0.0, dot( light.direction, normal ) );

}

vec3 getColour( ivec2 pixel ) {

	vec2 size = vec2( textureSize( colours, 0 ) );
	return texelFetch( colours, ivec2( clamp( ( vec2( pixel ) + 0.5 ) / vec2( textureSize( surfaces, 0 ) ), 0.0, 0.9999 ) * size ), 0 ).rgb;

}

// By how much the encoded values around a pixel differ from one another under its own light.
float getContrast( ivec2 pixel, vec3 light ) {

	float sum = 0.0, squares = 0.0;
	for ( int i = 0; i < 9; i ++ ) {

		float value = encode( dot( LUMINANCE, light * getColour( pixel + 2 * ivec2( i % 3 - 1, i / 3 - 1 ) ) ) );
		sum += value;
		squares += value * value;

	}
	return sqrt( max( 0.0, squares / 9.0 - sum * sum / 81.0 ) );

}

float getStep( ivec2 pixel ) {

	vec4 surface = texelFetch( surfaces, pixel, 0 );
	if ( surface.b == 0.0 ) return 0.0;
	vec3 normal = unpackShading( surface.a ), position = positionOf( vec2( pixel ) + 0.5, surface.b );
	vec3 shown = vec3( 0.0 ), change = vec3( 0.0 );
	int lamps = int( texelFetch( picture, ivec2( 0 ), 0 ).x );
	for ( int k = 0; k < lamps; k ++ ) {

		Lamp lamp = readLamp( picture, k );
		vec3 open = getOpenIrradiance( lamp, position, normal ), before;
		for ( int c = 0; c < 3; c ++ ) before[ c ] = getShareOfLamp( picture, pixel, lamp.kind == LAMP_SKY ? lamp.share + c : lamp.share );
		shown += open * before;
		if ( lamp.share != share ) continue;
		vec2 red = texelFetch( sums[ 0 ], pixel, 0 ).rg, green = texelFetch( sums[ 1 ], pixel, 0 ).rg, blue = texelFetch( sums[ 2 ], pixel, 0 ).rg;
		vec3 weights = vec3( red.x, green.x, blue.x );
		change = open * ( mix( vec3( 1.0 ), vec3( red.y, green.y, blue.y ) / max( weights, 1e-30 ), greaterThan( weights, vec3( 0.0 ) ) ) - before );

	}
	float toLight = exposure * RECIPROCAL_PI;
	vec3 colour = getColour( pixel ) * toLight;
	float seen = abs( encode( dot( LUMINANCE, colour * ( shown + change ) ) ) - encode( dot( LUMINANCE, colour * shown ) ) );
	// A share is shown in 12 bits, which is no step of its own.
	return max( 0.0, seen - 1.0 / 4095.0 ) / getPermittedDifference( getContrast( pixel, toLight * shown ) );

}

void main() {

	vec2 tile = vec2( textureSize( surfaces, 0 ) ) / tiles;
	vec4 largest = vec4( 0.0 );
	for ( int i = 0; i < LOOKS * LOOKS; i ++ ) {

		vec2 place = floor( gl_FragCoord.xy ) + ( vec2( i % LOOKS, i / LOOKS ) + 0.5 ) / float( LOOKS );
		float here = getStep( ivec2( place * tile ) );
		for ( int k = 0; k < 4; k ++ ) if ( here > largest[ k ] ) { float less = largest[ k ]; largest[ k ] = here; here = less; }

	}
	result = vec4( largest.w, 0.0, 0.0, 1.0 );

}

// SPDX-License-Identifier: Apache-2.0
//
// To be appended to three.js's chunk lights_pars_begin (0.187): the lamps of a pack, each as what it is. They come as one spot light of
// no intensity, known by its decay, whose map is a table of all lamps with the share of each that reaches every pixel
// (docs/decisions/033-direct-light-on-the-page.md). A material calls getLamp for each of them and adds it by its own RE_Direct.
//
// Texels of the map, row 0: number of lamps, whether there are shares, their width and height; the viewport: x, y, width, height; of a
// sky three matrices, one a colour, for the irradiance of a surface with the normal n: n M n; then five a lamp, all in the camera's space:
//   position (of a sun: where its light comes from; of a sky: the middle of what its shadows are drawn of), kind
//   colour: radiance, or intensity; range, 0 without end; of a sky that of its shadows
//   half a rectangle's first side; radius of a disc or sphere, or cosine of a spot's outer angle
//   half its second side; 1 when it shines to both sides, or cosine of a spot's inner angle
//   normal; number of its share, of a sky that of red, before those of green and blue; behind these, what of each is in its grid
// Above row 0 the shares, one for every pixel of the viewport or for a few: red the distance of what is seen there, the others two shares each as whole numbers of 12 bits; of lamps
// beyond six beside it, again and again.

#if NUM_SPOT_LIGHT_MAPS > 0

#define LAMPS_OF_PACK -100.0
#define LAMP_RECTANGLE 0
#define LAMP_DISC 1
#define LAMP_SPHERE 2
#define LAMP_POINT 3
#define LAMP_SPOT 4
#define LAMP_SUN 5
#define LAMP_SKY 6

struct Lamp {
	vec3 position;
	int kind;
	vec3 color;
	float range;
	vec3 u;
	float outer;     // radius of a disc or sphere, cosine of a spot's outer angle
	vec3 v;
	float inner;     // 1 when both sides shine, cosine of a spot's inner angle
	vec3 normal;
	int share;
};

Lamp readLamp( sampler2D map, int i ) {

	vec4 texels[ 5 ];
	for ( int k = 0; k < 5; k ++ ) texels[ k ] = texelFetch( map, ivec2( 14 + 5 * i + k, 0 ), 0 );
	int kind = int( texels[ 0 ].w ), share = int( texels[ 4 ].w );
	return Lamp( texels[ 0 ].xyz, kind, texels[ 1 ].rgb, texels[ 1 ].w, texels[ 2 ].xyz, texels[ 2 ].w, texels[ 3 ].xyz, texels[ 3 ].w, texels[ 4 ].xyz, share );

}

// Where the shares of a fragment stand: at its pixel, unless a neighbour shows what is nearer to the fragment's distance, as at
// outlines, where a multisampled pixel has fragments of two surfaces.
ivec2 getPlaceOfShares( sampler2D map, float distance ) {

	vec2 size = texelFetch( map, ivec2( 0 ), 0 ).zw;
	vec4 viewport = texelFetch( map, ivec2( 1, 0 ), 0 );
	ivec2 last = ivec2( size ) - 1;
	ivec2 pixel = clamp( ivec2( floor( ( gl_FragCoord.xy - viewport.xy ) * size / viewport.zw ) ), ivec2( 0 ), last );
	ivec2 best = pixel;
	float least = abs( texelFetch( map, pixel + ivec2( 0, 1 ), 0 ).r - distance );
	if ( least < 0.002 * distance ) return best;
	for ( int i = 0; i < 8; i ++ ) {

		int k = i < 4 ? i : i + 1;
		ivec2 other = clamp( pixel + ivec2( k % 3 - 1, k / 3 - 1 ), ivec2( 0 ), last );
		float off = abs( texelFetch( map, other + ivec2( 0, 1 ), 0 ).r - distance );
		if ( off < 0.5 * least ) { best = other; least = off; }

	}
	return best;

}

// What the sky gives a fragment, as a lamp: by what its light is multiplied on the way, which share of it surfaces within a cell hide of which
// its grid knows nothing, the irradiance, and what comes from where it mirrors.
struct SkyLight {
	bool lit;
	vec3 share;
	vec3 hidden;
	vec3 irradiance;
	vec3 mirrored;
};

SkyLight skyLight = SkyLight( false, vec3( 1.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );

// The irradiance of the sky where nothing hides it.
vec3 getSkyIrradiance( sampler2D map, vec3 normal ) {

	vec4 n = vec4( normal, 1.0 );
	vec3 irradiance = vec3( 0.0 );
	for ( int i = 0; i < 12; i ++ ) irradiance[ i / 4 ] += n[ i % 4 ] * dot( texelFetch( map, ivec2( 2 + i, 0 ), 0 ), n );
	return max( irradiance, vec3( 0.0 ) );

}

// How much shares of the sky's light tell of a surface: nothing where little of it comes from where that faces (lightwell/render/folds.h).
vec3 getWeightOfSkyShares( sampler2D map, vec3 open ) {

	vec3 weight;
	for ( int c = 0; c < 3; c ++ ) {

		float mean = 0.0;
		for ( int i = 0; i < 4; i ++ ) mean += texelFetch( map, ivec2( 2 + 4 * c + i, 0 ), 0 )[ i ] / ( i < 3 ? 3.0 : 1.0 );
		weight[ c ] = mean > 0.0 ? smoothstep( 0.05, 0.2, open[ c ] / mean ) : 0.0;

	}
	return weight;

}

// How much of a lamp reaches the fragment, 0 to 1.
float getShareOfLamp( sampler2D map, ivec2 place, int share ) {

	int width = int( texelFetch( map, ivec2( 0 ), 0 ).z );
	vec4 texel = texelFetch( map, place + ivec2( share / 6 * width, 1 ), 0 );
	float two = texel[ 1 + share % 6 / 2 ];
	float first = floor( two / 4096.0 );
	return ( share % 2 == 0 ? first : two - 4096.0 * first ) / 4095.0;

}

// An axis as the last of three that are perpendicular, of which the first is turned towards somewhere.
mat3 getFrame( vec3 axis, vec3 towards ) {

	vec3 y = cross( axis, towards );
	if ( dot( y, y ) < 1e-8 * dot( towards, towards ) ) y = cross( axis, abs( axis.x ) < 0.5 ? vec3( 1.0, 0.0, 0.0 ) : vec3( 0.0, 1.0, 0.0 ) );
	y = normalize( y );
	return mat3( cross( y, axis ), y, axis );

}

// What an edge of a polygon adds to twice its vector irradiance; the ends as seen from the receiver.
vec3 getEdgeIrradiance( vec3 a, vec3 b ) {

	vec3 way = cross( a, b );
	float area = length( way );
	return area > 0.0 ? way * ( atan( area, dot( a, b ) ) / area ) : vec3( 0.0 );

}

// Vector irradiance of the part of a polygon of radiance 1 that is above the horizon of a receiver (Lambert's formula): along the normal
// it is the irradiance. The polygon is a rectangle with the half sides u and v, or one of more corners that an affine map has made of a
// regular one, as large as the ellipse with the half axes u and v. `center` as seen from the receiver.
vec3 getPolygonIrradiance( vec3 center, vec3 u, vec3 v, int corners, vec3 normal ) {

	float turn = PI2 / float( corners );
	vec2 place = sqrt( corners == 4 ? 2.0 : turn / sin( turn ) ) * vec2( cos( 0.5 * turn ), sin( 0.5 * turn ) );
	mat2 onwards = mat2( cos( turn ), sin( turn ), - sin( turn ), cos( turn ) );
	vec3 sum = vec3( 0.0 ), leaves = vec3( 0.0 ), enters = vec3( 0.0 ), next = center + place.x * u + place.y * v;
	for ( int i = 0; i < corners; i ++ ) {

		place = onwards * place;
		vec3 a = next, b = center + place.x * u + place.y * v;
		next = b;
		float over = dot( a, normal ), then = dot( b, normal );
		if ( over <= 0.0 && then <= 0.0 ) continue;
		vec3 cut = mix( a, b, over / ( over - then ) );
		if ( over < 0.0 ) enters = a = cut;
		if ( then < 0.0 ) leaves = b = cut;
		sum += getEdgeIrradiance( a, b );

	}
	sum = 0.5 * ( sum + getEdgeIrradiance( leaves, enters ) );
	return dot( sum, normal ) < 0.0 ? - sum : sum;

}

// The same of a disc, in closed form. Its rim is p(t) = center + radius (x cos t + y sin t), x away from the receiver's foot in its plane.
// Twice the vector irradiance is the integral of p x p' / |p|^2 along the rim, from where it rises above the horizon to where it sets,
// and back along the horizon; |p|^2 = a + b cos t. What floats would cancel is written out.
vec3 getDiscIrradiance( vec3 center, vec3 axis, float radius, vec3 normal ) {

	mat3 frame = getFrame( axis, center );
	vec3 x = frame[ 0 ], y = frame[ 1 ];
	float height = dot( center, axis ), away = max( dot( center, x ), 1e-3 * abs( height ) );
	float a = dot( center, center ) + radius * radius, b = 2.0 * radius * away;
	float farthest = pow2( away + radius ) + height * height;
	float k = sqrt( ( pow2( away - radius ) + height * height ) / farthest ), root = max( farthest * k, 1e-6 * a );
	float across = radius * length( vec2( dot( normal, x ), dot( normal, y ) ) );
	float middle = atan( dot( normal, y ), dot( normal, x ) ), turned = acos( clamp( - dot( normal, center ) / max( across, 1e-9 * a ), - 1.0, 1.0 ) );
	vec2 ends = vec2( middle - turned, middle + turned ), c = cos( ends ), s = sin( ends );
	// Between them the integral of root / |p|^2 is 2 turned - 2 lag, that of sin t / |p|^2 is - log / b.
	vec2 lags = atan( 2.0 * b / ( farthest * ( 1.0 + k ) ) * s, 1.0 + c + k * ( 1.0 - c ) );
	float lag = lags.y - lags.x, grown = b * ( c.y - c.x ) / ( a + b * c.x ), less = b * b / ( root + a );
	vec3 sum = ( turned * ( 2.0 * radius * radius - less ) + ( a - 2.0 * radius * radius ) * lag ) / root * axis;
	sum += height / away * ( turned * less - a * lag ) / root * x;
	sum += 0.5 * height / away * ( abs( grown ) < 1e-2 ? grown * ( 1.0 - 0.5 * grown ) : log( 1.0 + grown ) ) * y;
	vec3 rises = center + radius * ( c.x * x + s.x * y ), sets = center + radius * ( c.y * x + s.y * y );
	sum = 0.5 * ( sum + getEdgeIrradiance( sets, rises ) );
	return dot( sum, normal ) < 0.0 ? - sum : sum;

}

// Irradiance of a sphere of radiance 1, of which the horizon may hide a part (S. Lagarde, C. de Rousiers, Moving Frostbite to
// Physically Based Rendering, 2014, section 4.7.2). `cosine` of the angle to its centre, `share`: (radius / distance)^2.
float getSphereIrradiance( float cosine, float share ) {

	if ( cosine * cosine >= share ) return PI * share * saturate( cosine );
	float sine = sqrt( 1.0 - cosine * cosine );
	float x = sqrt( 1.0 / share - 1.0 );
	float y = - x * cosine / sine;
	float z = sine * sqrt( max( 0.0, 1.0 - y * y ) );
	return max( 0.0, ( cosine * acos( clamp( y, - 1.0, 1.0 ) ) - x * z ) * share + atan( z / x ) );

}

// What is left of an intensity at the end of a way, where the range, if it is not 0, ends the light (KHR_lights_punctual).
float getLampAttenuation( float squared, float range ) {

	return ( range > 0.0 ? saturate( 1.0 - pow2( squared / pow2( range ) ) ) : 1.0 ) / squared;

}

// A lamp as light from one direction, so that its cosine times its colour is the irradiance; gives how far the lamp reaches around that
// direction: the sine of half the angle.
float getLamp( Lamp lamp, vec3 position, vec3 normal, out IncidentLight light ) {

	vec3 way = lamp.kind == LAMP_SUN ? lamp.position : lamp.position - position;
	float squared = dot( way, way );
	light.direction = way * inversesqrt( squared );
	light.color = lamp.color;
	light.visible = true;
	if ( lamp.kind < LAMP_SPHERE ) {

		vec3 irradiance = lamp.kind == LAMP_DISC ? getDiscIrradiance( way, lamp.normal, lamp.outer, normal ) : getPolygonIrradiance( way, lamp.u, lamp.v, 4, normal );
		bool behind = dot( way, lamp.normal ) >= 0.0 && lamp.inner < 0.5;
		float strength = behind ? 0.0 : length( irradiance );
		if ( strength > 0.0 ) light.direction = irradiance / strength;
		light.color *= strength;
		return sqrt( saturate( strength / PI ) );

	}
	if ( lamp.kind == LAMP_SPHERE ) {

		float share = min( pow2( lamp.outer ) / squared, 0.999 );
		float irradiance = getSphereIrradiance( dot( normal, light.direction ), share );
		if ( dot( normal, light.direction ) < sqrt( share ) ) light.direction = normalize( light.direction + sqrt( share ) * normal );
		light.color *= irradiance / max( dot( normal, light.direction ), 1e-4 );
		return sqrt( share );

	}
	if ( lamp.kind != LAMP_SUN ) light.color *= getLampAttenuation( squared, lamp.range );
	if ( lamp.kind == LAMP_SPOT ) {

		float cosine = - dot( light.direction, lamp.normal );
		light.color *= pow2( saturate( ( cosine - lamp.outer ) / max( 1e-3, lamp.inner - lamp.outer ) ) );

	}
	return 0.0;

}

#endif

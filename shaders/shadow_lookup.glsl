// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass: adds one sample of a lamp, a point of it, to the two sums of every pixel: the weight w that the point would have
// unoccluded, and w where it is seen. The sums' ratio is the share of the lamp that reaches the pixel. Comes behind seen_surface.glsl.

uniform sampler2D sums;         // so far
uniform sampler2D depths;       // of the map: 3 x 2 faces of a cube, or one picture for a sun
uniform bool first;             // whether the sums begin here
uniform float strength;         // of this sample beside the others
uniform mat3 axes;              // rows: the map's axes in the camera's space, the last one to its front
uniform vec3 point;             // of the lamp, in the camera's space; of a sun the middle of the map
uniform vec3 normal;            // of the lamp's surface there; 0 where it shines evenly to all sides
uniform bool bothSides;
uniform float size;             // a face's side, in texels
uniform vec2 within;            // of the pixel: the place that is looked up, from its middle
uniform float mostRise;         // of steep planes: what stands on one casts no shadow on what is nearer to it than that
uniform vec2 range;             // near and far end of the map; of a sun its half width and half depth

out vec4 result;

// Of the depth picture's own values, which reach from 0 to 1.
const float SLACK = 3e-6;
// How much nearer to the lamp than the receiver's plane a surface is that has a share in its shadow: of the distance, and of a sun's range.
const float OWN = 0.0015, OWN_OF_SUN = 1e-4;
// And one that stands on the receiver, or beside it in a corner: a dozen texels.
const float CLOSE = 0.05, CLOSE_OF_SUN = 5e-3;

// A receiver as the map sees it.
struct Receiver {
	vec3 at;        // in the face's axes; of a sun as a fraction of the half width
	vec3 normal;
	float side;     // to which side of its axis the face looks
	ivec2 start;    // of the face, in texels
	vec2 place;     // in the face, in texels
};

// By how much a plane is nearer to the lamp at a texel's corner than in its middle, as a share of its distance, of a sun's half width.
float getRise( vec3 n, float facing ) {

	return min( ( abs( n.x ) + abs( n.y ) ) / ( abs( facing ) * size ), mostRise );

}

#ifdef SUN

	Receiver receiverOf( vec3 way, vec3 n ) {

		vec3 at = axes * way / range.x;
		return Receiver( at, axes * n, 1.0, ivec2( 0 ), ( at.xy * 0.5 + 0.5 ) * size );

	}

	// The depth of the receiver's plane where it is least in a texel, not its own, so that no slope shades itself: Mesa's software renderer may draw the
	// depth of four texels' common corner. And that of what is close to it.
	vec2 depthsOf( Receiver receiver, vec2 middle ) {

		vec3 n = receiver.normal;
		float rise = - dot( n.xy, middle - receiver.at.xy ) / min( n.z, - 0.02 ) - getRise( n, n.z );
		return 0.5 + 0.5 * ( receiver.at.z + clamp( rise, - 0.05, 0.05 ) ) * range.x / range.y - vec2( OWN_OF_SUN, CLOSE_OF_SUN );

	}

#else

	Receiver receiverOf( vec3 way, vec3 n ) {

		vec3 at = axes * way;
		n = axes * n;
		vec3 along = abs( at );
		int axis = along.x > along.y ? ( along.x > along.z ? 0 : 2 ) : ( along.y > along.z ? 1 : 2 );
		if ( axis == 0 ) { at = at.yzx; n = n.yzx; }
		if ( axis == 1 ) { at = at.zxy; n = n.zxy; }
		int face = 2 * axis + ( at.z < 0.0 ? 1 : 0 );
		vec2 place = ( at.xy / abs( at.z ) * 0.5 + 0.5 ) * size;
		return Receiver( at, n, sign( at.z ), ivec2( face % 3, face / 3 ) * int( size ), place );

	}

	vec2 depthsOf( Receiver receiver, vec2 middle ) {

		float own = abs( receiver.at.z );
		vec3 n = receiver.normal;
		float facing = dot( n, vec3( middle, receiver.side ) );
		float plane = dot( n, receiver.at ) / ( facing * ( 1.0 + getRise( n, facing ) ) );
		plane = plane > 0.0 ? clamp( plane, 0.9 * own, 1.1 * own ) : own;
		return range.y / ( range.y - range.x ) * ( 1.0 - range.x / ( plane * ( 1.0 - vec2( OWN, CLOSE ) ) ) );

	}

#endif

// Whether the receiver's plane is lit at a texel of its face; `close` where something close to it is in the way.
float isLit( Receiver receiver, ivec2 texel, float close ) {

	texel = clamp( texel, ivec2( 0 ), ivec2( size ) - 1 );
	vec2 limits = depthsOf( receiver, 2.0 * ( vec2( texel ) + 0.5 ) / size - 1.0 ) - SLACK;
	float depth = texelFetch( depths, texel + receiver.start, 0 ).r;
	return depth >= limits.x ? 1.0 : depth >= limits.y ? close : 0.0;

}

float lookUp( Receiver receiver ) {

	#ifdef SUN
		if ( any( greaterThan( abs( receiver.at.xy ), vec2( 1.0 ) ) ) ) return 1.0;
	#endif
	ivec2 texel = ivec2( receiver.place );
	#ifdef SOFT

		// A tent of three texels' width.
		vec2 f = fract( receiver.place );
		vec2 shares[ 3 ] = vec2[ 3 ]( 0.5 - 0.5 * f, vec2( 0.5 ), 0.5 * f );
		float lit = 0.0;
		for ( int x = 0; x < 3; x ++ ) for ( int y = 0; y < 3; y ++ ) lit += shares[ x ].x * shares[ y ].y * isLit( receiver, texel + ivec2( x, y ) - 1, 0.0 );
		return lit;

	#else

		// Between the four texels around: the nearest alone moves an edge by up to half a texel, which is noise of all samples. It decides about
		// what is close, so that corners are not darker by the other three.
		vec2 place = receiver.place - 0.5;
		ivec2 first = ivec2( floor( place ) );
		vec2 f = place - vec2( first );
		float own = isLit( receiver, texel, 0.0 ), lit = 0.0;
		for ( int i = 0; i < 4; i ++ ) {

			ivec2 by = ivec2( i & 1, i >> 1 );
			vec2 shares = mix( 1.0 - f, f, vec2( by ) );
			lit += shares.x * shares.y * isLit( receiver, first + by, own );

		}
		return lit;

	#endif

}

// The place of the surface that is looked up. Of one that is seen almost along it, or so near that the pixel reaches behind the eye, the middle.
vec3 placeOf( vec4 surface, vec3 n ) {

	vec3 middle = positionOf( gl_FragCoord.xy, surface.b );
	vec2 at = gl_FragCoord.xy + within;
	vec3 eye = positionOf( at, 0.0 ), ray = positionOf( at, 1.0 ) - eye;
	float facing = dot( n, ray ), distance = dot( n, middle - eye ) / facing;
	return facing < - 0.1 * length( ray ) && abs( distance - surface.b ) < 0.1 * surface.b ? eye + distance * ray : middle;

}

void main() {

	vec4 surface = texelFetch( surfaces, ivec2( gl_FragCoord.xy ), 0 );
	vec2 before = first ? vec2( 0.0 ) : texelFetch( sums, ivec2( gl_FragCoord.xy ), 0 ).rg;
	if ( surface.b == 0.0 ) { result = vec4( before, 0.0, 0.0 ); return; }

	vec3 n = unpackNormal( surface.rg );
	vec3 way = placeOf( surface, n ) - point;
	#ifdef SUN
		vec3 direction = - vec3( axes[ 0 ][ 2 ], axes[ 1 ][ 2 ], axes[ 2 ][ 2 ] );
		float weight = strength;
	#else
		float squared = dot( way, way );
		vec3 direction = - way * inversesqrt( squared );
		float leaving = - dot( normal, direction );
		float weight = normal == vec3( 0.0 ) ? 1.0 : max( 0.0, bothSides ? abs( leaving ) : leaving );
		weight *= strength / squared;
	#endif
	// Nothing comes from below the surface's plane; what the shading would take from there is folded up (lightwell/trace/shading.h). A trifle where
	// the shading takes nothing: pixels to which that happens for all points are dark.
	vec3 shading = unpackShading( surface.a );
	float above = dot( n, direction );
	float cosine = max( dot( shading, direction ), 1e-4 );
	float folded = max( 0.0, dot( shading, direction - 2.0 * above * n ) );
	float lit = above > 0.0 && weight > 0.0 ? lookUp( receiverOf( way, n ) ) : 0.0;
	result = vec4( before + weight * vec2( cosine, ( cosine + folded ) * lit ), 0.0, 0.0 );

}

// SPDX-License-Identifier: Apache-2.0
//
// Lightwell's light lookup. It replaces three.js's chunk lightprobes_pars_fragment (0.187) by the same functions, so that
// three.js's own grids look as before and Lightwell's are recognised beside them.
//
// A grid of Lightwell's stands anywhere in the world. The renderer hands three vectors of a grid to the shader and no more; for
// Lightwell's they mean
//   probesMin          world position of the first node
//   probesMax          x, y, z of the unit quaternion that turns the grid into the world, the one with w >= 0
//   probesResolution   size of the box of the nodes in the world: x negative when the world mirrors the grid, z always negated
// which is what Matrix4.decompose gives for (the object's matrix times a translation to the grid's first node), the
// scale times the box's size. A negative z marks the grid, since three.js counts probes there. What else is needed lies
// in texel (0, 0, 0) of the atlas; lightwell/light/atlas.h describes it and the values. Red of texel (1, 0, 0) is
// 1 when the grid holds the light of the environment, which the page knows from the pack's JSON and writes there, and 2 more when
// lookups are to be tricubic, and 4 more when the sky shines beside it as a lamp (direct_light.glsl); green is the finest level of a grid with bricks, whose atlas is another.
//
// docs/decisions/011-cost-of-the-lookup.md tells what costs how much.

#if NUM_LIGHT_PROBE_GRIDS > 0

uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];

uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];

bool isLightwellGrid( vec3 probesResolution ) {

	return probesResolution.z < 0.0;

}

// A world vector in the axes of a grid of Lightwell's: turned back by the quaternion q, not scaled.
vec3 turnIntoGrid( vec3 v, vec3 q ) {

	float w = sqrt( max( 0.0, 1.0 - dot( q, q ) ) );
	return v + 2.0 * cross( q, cross( q, v ) - w * v );

}

// The size of the box of the nodes of a grid of Lightwell's in the world, negative where the world mirrors it.
vec3 sizeOfGrid( vec3 probesResolution ) {

	return probesResolution * vec3( 1.0, 1.0, - 1.0 );

}

// A world position as a fraction of the box of the nodes of a grid of Lightwell's.
vec3 fractionOfGrid( vec3 worldPos, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {

	return turnIntoGrid( worldPos - probesMin, probesMax ) / sizeOfGrid( probesResolution );

}

bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {

	if ( isLightwellGrid( probesResolution ) ) {

		// A hundredth more than the box, since the scene's outermost surfaces lie on it: at their edges a multisampled pixel's
		// place may lie a little farther out.
		vec3 fraction = fractionOfGrid( worldPos, probesMin, probesMax, probesResolution );
		return all( lessThanEqual( abs( fraction - 0.5 ), vec3( 0.51 ) ) );

	}

	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );

}

// The light at the fragment for every direction. It is kept from the irradiance for the reflection, which then costs no fetches.
struct LightProbeSample {
	vec3 c[ 9 ];     // coefficients of the spherical harmonics
	float weight;    // by which they are to be divided
	vec3 turn;       // a world direction in their axes is turned back by this quaternion ...
	vec3 stretch;    // ... and stretched, up to length
	bool reflects;   // whether metals take their reflection from here: in grids of Lightwell's
	int marks;       // bits: 1 where the light of the environment is in it already, 4 where the sky shines beside it as a lamp
};

LightProbeSample lightProbeSample = LightProbeSample( vec3[ 9 ]( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) ), 1.0, vec3( 0.0 ), vec3( 1.0 ), false, 0 );

// A world direction in the axes of the sample, of length 1.
vec3 directionInGrid( vec3 worldDirection ) {

	return normalize( lightProbeSample.stretch * turnIntoGrid( worldDirection, lightProbeSample.turn ) );

}

// Seven fetches, filtered by the hardware: the 28 channels of the seven sub-volumes, `next` from one to the next.
void fetchLightProbes( highp sampler3D probesSH, vec3 at, vec3 next ) {

	vec4 s0 = texture( probesSH, at );
	vec4 s1 = texture( probesSH, at + next );
	vec4 s2 = texture( probesSH, at + 2.0 * next );
	vec4 s3 = texture( probesSH, at + 3.0 * next );
	vec4 s4 = texture( probesSH, at + 4.0 * next );
	vec4 s5 = texture( probesSH, at + 5.0 * next );
	vec4 s6 = texture( probesSH, at + 6.0 * next );

	lightProbeSample.c[ 0 ] = s0.xyz;
	lightProbeSample.c[ 1 ] = vec3( s0.w, s1.xy );
	lightProbeSample.c[ 2 ] = vec3( s1.zw, s2.x );
	lightProbeSample.c[ 3 ] = s2.yzw;
	lightProbeSample.c[ 4 ] = s3.xyz;
	lightProbeSample.c[ 5 ] = vec3( s3.w, s4.xy );
	lightProbeSample.c[ 6 ] = vec3( s4.zw, s5.x );
	lightProbeSample.c[ 7 ] = s5.yzw;
	lightProbeSample.c[ 8 ] = s6.xyz;
	lightProbeSample.weight = s6.w;

}

// Irradiance of the sample for a unit normal in its axes.
vec3 evaluateLightProbes( vec3 n ) {

	vec3 result = lightProbeSample.c[ 0 ] * 0.886227;
	result += lightProbeSample.c[ 1 ] * ( 1.023328 * n.y );
	result += lightProbeSample.c[ 2 ] * ( 1.023328 * n.z );
	result += lightProbeSample.c[ 3 ] * ( 1.023328 * n.x );
	result += lightProbeSample.c[ 4 ] * ( 0.858086 * n.x * n.y );
	result += lightProbeSample.c[ 5 ] * ( 0.858086 * n.y * n.z );
	result += lightProbeSample.c[ 6 ] * ( 0.743125 * n.z * n.z - 0.247708 );
	result += lightProbeSample.c[ 7 ] * ( 0.858086 * n.x * n.z );
	result += lightProbeSample.c[ 8 ] * ( 0.429043 * ( n.x * n.x - n.y * n.y ) );
	return max( result / lightProbeSample.weight, vec3( 0.0 ) );

}

// Where a grid of Lightwell's with bricks is fetched: the texel in the first sub-volume for a place in cells of the grid.
vec3 texelOfBrick( highp sampler3D probesSH, vec3 place, vec3 cells, float finest, float firstSlice ) {

	vec3 within = clamp( place, vec3( 0.0 ), cells - 0.5 / exp2( finest ) );
	vec4 brick = texelFetch( probesSH, ivec3( within * exp2( finest ) / 4.0 ) + ivec3( 0, 0, 1 ), 0 );
	float level = exp2( brick.a );
	vec3 first = 4.0 * floor( within * level / 4.0 );
	return brick.rgb + clamp( place * level - first, vec3( 0.0 ), vec3( 4.0 ) ) + vec3( 0.0, 0.0, firstSlice );

}

// The texel in the first sub-volume for a place in cells of a grid of Lightwell's; `parts` is its texel (1, 0, 0).
vec3 texelOfGrid( highp sampler3D probesSH, vec3 place, vec3 cells, vec4 parts ) {

	if ( parts.g > 0.5 ) return texelOfBrick( probesSH, place, cells, parts.g, parts.a );
	return clamp( place, vec3( 0.0 ), cells ) + vec3( 0.0, 0.0, 1.0 );

}

// The B-spline of third degree over the cells at a place, by eight lookups between the nodes (Sigg and Hadwiger, Fast Third-Order
// Texture Filtering, GPU Gems 2, 2005): on each axis two, which stand for two nodes each.
void fetchLightProbesTricubic( highp sampler3D probesSH, vec3 place, vec3 cells, vec4 parts, vec3 atlasSize, vec3 next ) {

	float level = 1.0;
	if ( parts.g > 0.5 ) {

		vec3 within = clamp( place, vec3( 0.0 ), cells - 0.5 / exp2( parts.g ) );
		level = exp2( texelFetch( probesSH, ivec3( within * exp2( parts.g ) / 4.0 ) + ivec3( 0, 0, 1 ), 0 ).a );

	}

	vec3 node = floor( place * level );
	vec3 f = place * level - node;
	vec3 w1 = ( 4.0 - 3.0 * f * f * ( 2.0 - f ) ) / 6.0;
	vec3 w3 = f * f * f / 6.0;
	vec3 before = ( 1.0 - f ) * ( 1.0 - f ) * ( 1.0 - f ) / 6.0 + w1;
	vec3 behind = 1.0 - before;
	vec3 near = ( node - 1.0 + w1 / before ) / level;
	vec3 far = ( node + 1.0 + w3 / behind ) / level;
	vec3 c[ 9 ] = vec3[ 9 ]( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	float weight = 0.0;

	for ( int i = 0; i < 8; i ++ ) {

		vec3 upper = vec3( float( i & 1 ), float( i >> 1 & 1 ), float( i >> 2 ) );
		vec3 share = mix( before, behind, upper );
		float own = share.x * share.y * share.z;
		vec3 texel = texelOfGrid( probesSH, mix( near, far, upper ), cells, parts );
		fetchLightProbes( probesSH, ( texel + 0.5 ) / atlasSize, next );
		for ( int k = 0; k < 9; k ++ ) c[ k ] += own * lightProbeSample.c[ k ];
		weight += own * lightProbeSample.weight;

	}

	lightProbeSample.c = c;
	lightProbeSample.weight = weight;

}

vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {

	bool ours = isLightwellGrid( probesResolution );
	vec3 atlasSize = vec3( textureSize( probesSH, 0 ) );
	vec3 last = vec3( atlasSize.xy - 1.0, atlasSize.z / 7.0 - 3.0 );
	vec3 normal = worldNormal;
	vec3 node;
	vec3 texel;
	vec4 parts = vec4( 0.0 );
	float subVolume = atlasSize.z / 7.0;

	if ( ours ) {

		// Surfaces of a stretched object keep the normals that they had unstretched: a normal is multiplied by the stretch, the
		// ratio of the cells' sides in the world to those in the grid.
		vec4 header = texelFetch( probesSH, ivec3( 0 ), 0 );
		parts = texelFetch( probesSH, ivec3( 1, 0, 0 ), 0 );
		bool bricks = parts.g > 0.5;
		if ( bricks ) last = texelFetch( probesSH, ivec3( 2, 0, 0 ), 0 ).rgb;
		lightProbeSample.turn = probesMax;
		lightProbeSample.stretch = sizeOfGrid( probesResolution ) / ( last * header.rgb );
		lightProbeSample.marks = int( parts.r );
		normal = directionInGrid( worldNormal );
		node = fractionOfGrid( worldPos, probesMin, probesMax, probesResolution ) * last + header.a * normal;

		if ( bricks ) subVolume = parts.b;
		texel = texelOfGrid( probesSH, node, last, parts );

	} else {

		node = ( worldPos - probesMin ) / ( probesMax - probesMin ) * probesResolution - 0.5 + 0.5 * worldNormal;
		texel = clamp( node, vec3( 0.0 ), last ) + vec3( 0.0, 0.0, 1.0 );

	}

	vec3 next = vec3( 0.0, 0.0, subVolume / atlasSize.z );
	if ( ( int( parts.r ) & 2 ) != 0 ) fetchLightProbesTricubic( probesSH, node, last, parts, atlasSize, next );
	else fetchLightProbes( probesSH, ( texel + 0.5 ) / atlasSize, next );
	lightProbeSample.reflects = ours;
	if ( ! ours ) lightProbeSample.weight = 1.0;
	return evaluateLightProbes( normal );

}

// Radiance that a mirror would show in a world direction, for want of anything better the mean over the half-space around it:
// E(direction) / pi. Zero where the irradiance did not come from a grid of Lightwell's.
vec3 getLightProbeGridRadiance( vec3 worldDirection ) {

	if ( ! lightProbeSample.reflects ) return vec3( 0.0 );
	return evaluateLightProbes( directionInGrid( worldDirection ) ) * RECIPROCAL_PI;

}

#endif

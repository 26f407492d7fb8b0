// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass: which share of each colour of the sky's light a grid has at every pixel: what the grid is with the sky's own light, less
// what it is without, to the irradiance where nothing hides the sky. Comes behind seen_surface.glsl and light_grid.glsl, whose two grids are
// those.

uniform mat4 place;             // from the camera's space into the world
uniform mat4 sky[ 3 ];          // of each colour, the irradiance of a surface of the normal n in the camera's space: n sky n
uniform bool first;             // whether this grid is the first: others leave pixels outside of them as they are

out vec4 result;

void main() {

	vec4 surface = texelFetch( surfaces, ivec2( gl_FragCoord.xy ), 0 );
	vec3 normal = unpackShading( surface.a );
	vec3 position = ( place * vec4( positionOf( gl_FragCoord.xy, surface.b ), 1.0 ) ).xyz;
	vec3 worldNormal = mat3( place ) * normal;
	bool inside = isInsideLightProbeGrid( position, worldNormal, probesMin[ 0 ], probesMax[ 0 ], probesResolution[ 0 ] );
	if ( ! first && ! inside ) discard;
	result = vec4( 1.0 );
	if ( surface.b == 0.0 || ! inside ) return;
	vec3 light = getLightProbeGridIrradiance( probesSH[ 0 ], probesMin[ 0 ], probesMax[ 0 ], probesResolution[ 0 ], position, worldNormal );
	light -= getLightProbeGridIrradiance( probesSH[ 1 ], probesMin[ 0 ], probesMax[ 0 ], probesResolution[ 0 ], position, worldNormal );
	vec4 n = vec4( normal, 1.0 );
	vec3 open = vec3( dot( n, sky[ 0 ] * n ), dot( n, sky[ 1 ] * n ), dot( n, sky[ 2 ] * n ) );
	result.rgb = clamp( light / max( open, 1e-6 ), 0.0, 1.0 );

}

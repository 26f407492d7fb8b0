// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass: the two sums of a lamp that has all of its samples, from its share in the picture that materials read (shadow_shares.glsl).

precision highp float;
precision highp sampler2D;

uniform sampler2D picture;
uniform ivec2 start;            // of the six shares that are together
uniform int which;              // of them

out vec4 result;

void main() {

	vec4 texel = texelFetch( picture, ivec2( gl_FragCoord.xy ) + start, 0 );
	float two = texel[ 1 + which / 2 ];
	float first = floor( two / 4096.0 );
	result = vec4( 1.0, ( which % 2 == 0 ? first : two - 4096.0 * first ) / 4095.0, 0.0, 0.0 );

}

// SPDX-License-Identifier: Apache-2.0
//
// A full-screen pass: the two sums of a lamp that has all of its samples, from its share in the picture that materials read. Comes behind
// direct_light.glsl.

uniform sampler2D picture;
uniform int share;

out vec4 result;

void main() {

	result = vec4( 1.0, getShareOfLamp( picture, ivec2( gl_FragCoord.xy ), share ), 0.0, 0.0 );

}

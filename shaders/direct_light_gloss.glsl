// SPDX-License-Identifier: Apache-2.0
//
// To be appended to direct_light.glsl: how gloss mirrors lamps that have an area, by linearly transformed cosines (E. Heitz, J. Dupuy, S. Hill,
// D. Neubelt, Real-Time Polygonal-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2016).

#if NUM_SPOT_LIGHT_MAPS > 0

// What gloss mirrors, seen from one direction.
struct GlossLobe {
	vec3 viewDir;
	mat3 toCosine;       // the lobe becomes a cosine's round z
	mat3 fromCosine;
	int corners;         // of round lamps, which show the less the rougher a surface is
};

// Fitted by bench/gloss_lobe.mjs: the lobe of three.js's GGX, its cosine included, is that of a cosine after ( x, y, z ) has become
// ( a x + b z, e y, z ), where z is the normal and x turned towards the viewer. So it is above the horizon as a whole.
GlossLobe getGlossLobe( vec3 normal, vec3 viewDir, float roughness ) {

	float c = clamp( dot( normal, viewDir ), 0.03, 1.0 ), r = pow2( roughness ), height = sqrt( c * c + 5.0 * r * r ), t = 1.0 - c / height;
	vec3 p = 1.0 + t * ( vec3( 0.8713, - 0.0087, - 0.3427 ) + t * ( vec3( 2.7556, - 0.5833, - 0.6259 ) + t * vec3( - 0.8108, 0.2713, 0.3938 ) ) )
		+ r * ( vec3( - 0.1073, - 0.0001, 0.0949 ) + t * ( vec3( - 6.5864, 0.1634, 0.8247 ) + t * vec3( - 0.7609, - 0.2205, 0.301 ) )
		+ r * ( vec3( 1.0866, - 0.0273, - 0.834 ) + t * vec3( 4.5216, 0.2362, - 0.3766 ) + r * vec3( - 1.2489, - 0.9428, 0.2678 ) ) );
	float b = - sqrt( 1.0 - c * c ) / height * p.y, a = 2.0 * r * ( 1.0 + b * b ) * p.x, e = 2.0 * r * p.z;
	mat3 frame = getFrame( normal, viewDir );
	mat3 toCosine = transpose( mat3( ( frame[ 0 ] - b * normal ) / a, frame[ 1 ] / e, normal ) );
	mat3 fromCosine = mat3( a * frame[ 0 ], e * frame[ 1 ], b * frame[ 0 ] + normal );
	return GlossLobe( viewDir, toCosine, fromCosine, roughness < 0.15 ? 64 : roughness < 0.3 ? 16 : 8 );

}

// How much of all that gloss mirrors a lamp is when nothing is in its way, 0 to 1, in two parts: what is reflected head-on and what at grazing
// angles, by Fresnel's term (Schlick's) where the lamp is seen in the mean.
vec2 getLampInGloss( Lamp lamp, vec3 position, vec3 normal, GlossLobe lobe ) {

	vec3 center = lamp.position - position, u = lamp.u, v = lamp.v;
	if ( lamp.kind != LAMP_RECTANGLE ) {

		// Of a sphere the disc behind its outline.
		float squared = dot( center, center ), share = min( pow2( lamp.outer ) / squared, 0.999 );
		bool isDisc = lamp.kind == LAMP_DISC;
		mat3 frame = getFrame( isDisc ? lamp.normal : center * inversesqrt( squared ), normal );
		float radius = isDisc ? lamp.outer : sqrt( squared * share / ( 1.0 - share ) );
		u = radius * frame[ 0 ];
		v = radius * frame[ 1 ];

	}
	int corners = lamp.kind == LAMP_RECTANGLE ? 4 : lobe.corners;
	vec3 irradiance = getPolygonIrradiance( lobe.toCosine * center, lobe.toCosine * u, lobe.toCosine * v, corners, vec3( 0.0, 0.0, 1.0 ) );
	vec3 direction = normalize( lobe.fromCosine * irradiance + 1e-9 * normal );
	float grazing = 1.0 - sqrt( saturate( 0.5 + 0.5 * dot( lobe.viewDir, direction ) ) );
	grazing *= pow4( grazing );
	return irradiance.z * RECIPROCAL_PI * vec2( 1.0 - grazing, grazing );

}

#endif

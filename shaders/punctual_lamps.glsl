// SPDX-License-Identifier: Apache-2.0
//
// To be appended to three.js's chunk lights_pars_begin (0.187): a pack's points and spots fade as KHR_lights_punctual says and as
// they do in the bake. three.js squares the window that ends a light at its range, fades a spot by smoothstep, and lets no light
// grow brighter nearer than 10 cm. A pack's lamps are known by a decay below zero, which no other light has; all others look as
// before (docs/decisions/016-punctual-lamps.md).

// What is left of an intensity at the end of a way, where the range, if it is not 0, ends the light.
float getLampAttenuation( const in vec3 way, const in float range ) {

	float squared = dot( way, way );
	return ( range > 0.0 ? saturate( 1.0 - pow2( squared / pow2( range ) ) ) : 1.0 ) / squared;

}

#if NUM_POINT_LIGHTS > 0

	void getLampInfo( const in PointLight lamp, const in vec3 geometryPosition, out IncidentLight light ) {

		getPointLightInfo( lamp, geometryPosition, light );
		if ( lamp.decay < 0.0 ) light.color = lamp.color * getLampAttenuation( lamp.position - geometryPosition, lamp.distance );

	}

	#define getPointLightInfo getLampInfo

#endif

#if NUM_SPOT_LIGHTS > 0

	void getLampInfo( const in SpotLight lamp, const in vec3 geometryPosition, out IncidentLight light ) {

		getSpotLightInfo( lamp, geometryPosition, light );
		float edge = saturate( ( dot( light.direction, lamp.direction ) - lamp.coneCos ) / max( 0.001, lamp.penumbraCos - lamp.coneCos ) );
		if ( lamp.decay < 0.0 ) light.color = lamp.color * pow2( edge ) * getLampAttenuation( lamp.position - geometryPosition, lamp.distance );

	}

	#define getSpotLightInfo getLampInfo

#endif

// Air around clouds: what it leaves of the sun's light on the way to them, and what it puts before them. Points are
// relative to the sea level below the camera. Needs sky_tables.glsl. BOX: in a flat world the sun stands equally high
// everywhere.

uniform vec3 sun_above_air;  // irradiance of a plane that faces the sun

vec3 sun_through_air(vec3 q, float altitude, vec3 to_sun)
{
#ifdef BOX
    float climb = to_sun.y;
#else
    float climb = dot(up_at(q), to_sun);
#endif
    return sun_above_air * sun_transmittance(clamp(altitude, 0.0, air.height), climb);
}

// Clouds (radiance, transmittance) that are this far away on the whole, behind the air before them. What they let
// through has its own air already.
vec4 behind_air(vec4 clouds, vec3 from, vec3 direction, float distance, vec3 to_sun)
{
    float altitude = altitude_above(from);
    float climb = clamp(dot(up_at(from), direction), -1.0, 1.0);
    vec2 hits = sphere_hits(altitude, climb, air.height);
    float begin = altitude > air.height ? max(hits.x, 0.0) : 0.0;
    float end = min(distance, hits.y);
    if (!(end > begin)) {
        return clouds;
    }
    int parts = int(clamp((end - begin) / 4000.0, 2.0, 16.0));
    AirLight light = air_light(from, direction, to_sun, begin, lowest_point(altitude, climb), end, parts);
    vec3 before = sun_above_air * radiance_of(light, dot(direction, to_sun));
    return vec4(clouds.rgb * light.transmittance + (1.0 - clouds.a) * before, clouds.a);
}

// Clouds as history is compared: luma and two differences of colour, and transmittance.
vec4 luma_chroma(vec4 clouds)
{
    vec3 c = clouds.rgb;
    return vec4(dot(c, vec3(0.25, 0.5, 0.25)), 0.5 * (c.r - c.b), dot(c, vec3(-0.25, 0.5, -0.25)), clouds.a);
}

vec4 from_luma_chroma(vec4 y)
{
    return vec4(y.x + y.y - y.z, y.x + y.z, y.x - y.y - y.z, y.w);
}

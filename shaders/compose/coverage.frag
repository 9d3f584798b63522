#version 450 core
// Keeps a fragment where a block of 8 x 8 pixels has one that something covers.

uniform sampler2D picture;  // alpha = 1 - transmittance

layout(location = 0) out float covered;

void main()
{
    ivec2 from = 8 * ivec2(gl_FragCoord.xy);
    ivec2 to = min(from + 8, textureSize(picture, 0));
    for (int y = from.y; y < to.y; ++y) {
        for (int x = from.x; x < to.x; ++x) {
            if (texelFetch(picture, ivec2(x, y), 0).a > 1.0 / 1024.0) {
                covered = 1.0;
                return;
            }
        }
    }
    discard;
}

// Corners of a translucent body in its own frame: mm from its middle, see render/subsurface/body_frame.h.
layout(location = 0) in vec3 position_model;  // metres from the middle of the mesh
layout(location = 1) in vec3 normal_model;

uniform mat3 body_from_model;
uniform mat3 body_from_normal;
uniform mat4 clip_from_body;

out vec3 position_body;
out vec3 normal_body;

void main()
{
    position_body = body_from_model * position_model;
    vec3 normal = body_from_normal * normal_model;
    normal_body = normal * inversesqrt(max(dot(normal, normal), 1e-36));
    gl_Position = clip_from_body * vec4(position_body, 1.0);
}

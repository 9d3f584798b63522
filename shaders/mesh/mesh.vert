#version 450 core
// Corners of a mesh in camera axes (right, up, back), in the opaque pass's unit of length.
layout(location = 0) in vec3 position_model;  // metres from the middle of the mesh
layout(location = 1) in vec3 normal_model;
layout(location = 2) in vec2 coordinate_model;
#ifdef VERTEX_COLORS
layout(location = 3) in vec3 color_model;
out vec3 color;
#endif

uniform mat4 camera_from_model;   // units per metre
uniform mat3 world_from_normal;
uniform int orthographic;
uniform vec2 half_view;
uniform vec4 picture_place;       // of the texture: scale, then offset
uniform vec2 depth_of_z;          // reversed: 1 at the near plane; perspective: near plane, at infinity 0

#ifdef TRANSLUCENT
uniform mat3 body_from_model;     // see render/subsurface/body_frame.h
uniform mat3 body_from_normal;
out vec3 position_body;
out vec3 normal_body;
#endif

#ifdef SHADOWS
uniform mat4 shadow_from_model;   // see light/shadow.glsl
out vec3 position_shadow;
#endif

invariant gl_Position;            // the same for depth alone as for all
out vec3 point_camera;
out vec3 normal_world;
out vec2 coordinate;

void main()
{
    point_camera = (camera_from_model * vec4(position_model, 1.0)).xyz;
    vec3 normal = world_from_normal * normal_model;
    normal_world = normal * inversesqrt(max(dot(normal, normal), 1e-36));
    vec2 place = coordinate_model * picture_place.xy + picture_place.zw;
    coordinate = vec2(place.x, 1.0 - place.y);  // the texture's top row comes first
#ifdef VERTEX_COLORS
    color = color_model;
#endif
#ifdef TRANSLUCENT
    position_body = body_from_model * position_model;
    normal_body = body_from_normal * normal_model;
#endif
#ifdef SHADOWS
    position_shadow = (shadow_from_model * vec4(position_model, 1.0)).xyz;
#endif
    float depth = point_camera.z * depth_of_z.x + depth_of_z.y;
    gl_Position = vec4(point_camera.xy / half_view, depth, orthographic != 0 ? 1.0 : -point_camera.z);
}

#version 450 core
// Depth of what stands in a lamp's light.
layout(location = 0) in vec3 position_model;  // metres from the middle of the mesh

uniform mat4 clip_from_model;

void main() { gl_Position = clip_from_model * vec4(position_model, 1.0); }

#version 450 core
#include "include/body_vertex.glsl"

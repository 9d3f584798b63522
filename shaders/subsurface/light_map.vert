#version 450 core
#include "subsurface/body_vertex.glsl"

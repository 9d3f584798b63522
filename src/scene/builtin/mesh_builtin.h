#pragma once
#include <memory>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"
#include "scene/mesh/mesh_parts.h"

namespace bruma::scene {

/// Names of the meshes made by code, without the 'builtin:' in front.
std::vector<std::string> builtin_mesh_names();

/// A mesh made by code, always the same triangles on every machine. Its unit is 1 mm unless the source says otherwise.
/// Throws InputError, with the nearest known name, for an unknown one.
LoadedMesh builtin_mesh(const std::string& name, const MeshSource& source = {});

/// The builtin meshes one by one, in millimetres; `builtin_mesh` finds them by name.
/// Icosahedron halved five times and drawn out to radius 10: 20480 triangles with exact normals.
MeshParts mesh_sphere_parts();
/// Tube of radius 5 around the torus knot (2,3) of the volume 'knot', half its size: closed, 55 across.
MeshParts mesh_knot_parts();
/// A pot with handle, spout and lid, 140 from handle to spout: three closed pieces that run into each other.
MeshParts pot_parts();
/// Room of 550 x 550 x 550 open towards +z with two blocks and a light panel, after Goral et al., "Modeling the
/// Interaction of Light between Diffuse Surfaces" (1984); materials white, red, green, light.
MeshParts cornell_parts();
/// A model of a landscape, 240 x 240 and up to 1.9 high, open below: 18432 triangles with exact normals.
MeshParts hills_parts();

}  // namespace bruma::scene

#pragma once
#include <array>
#include <glm/glm.hpp>
#include <memory>

#include "scene/volume/volume_grid.h"

/// The builtin volumes one by one; `builtin_volume` finds them by name. All have cubic voxels of 1 mm.
namespace bruma::scene {

/// 64^3 uint8: a Gaussian at each atom of C60, so that bonds show as saddles.
std::shared_ptr<const VolumeGrid> make_bucky();
/// Positions in mm from the centre of the cage, all at distance 25: vertices of the truncated icosahedron.
std::array<glm::dvec3, 60> bucky_atoms_mm();
/// Sum of the 60 Gaussians at a point in mm, 1 at an atom (but for 0.3 % from its neighbours).
double bucky_density(const glm::dvec3& point_mm);

/// 128^3 uint8: square root of |psi|^2 of the orbital 4d z^2 of hydrogen (n 4, l 2, m 0), 1 where it is largest; the
/// axis of the orbital is y; a Bohr radius is drawn as 1.8 mm.
std::shared_ptr<const VolumeGrid> make_hydrogen();

/// Test signal of Marschner and Lobb (An evaluation of reconstruction filters for volume rendering, 1994): alpha 0.25,
/// fM 6, over [-1,1]^3 with samples at cell centres. 41^3 float32, and 256^3 uint8.
std::shared_ptr<const VolumeGrid> make_marschner_lobb();
std::shared_ptr<const VolumeGrid> make_marschner_lobb_256();
/// The signal itself.
double marschner_lobb(double x, double y, double z);

/// 256^3 uint8: 96 overlapping compact blobs; nine tenths of it exactly 0.
std::shared_ptr<const VolumeGrid> make_blobs();

/// 160 x 112 x 96 uint8: a four-cylinder engine, x along the crankshaft, y up. Aluminium at 0.45, steel at 0.92 of the
/// range, air at 0; edges one and a half voxels wide.
std::shared_ptr<const VolumeGrid> make_engine();

/// 128^3 uint8: tube around the torus knot (2,3), soft outside (half the range), with a denser core.
std::shared_ptr<const VolumeGrid> make_knot();

/// 64^3 float32: (1 - (r / 28.8 mm)^2)^2 inside the ball, 0 outside.
std::shared_ptr<const VolumeGrid> make_sphere();

/// 32^3 float32: 1 everywhere. A slab of known optical depth.
std::shared_ptr<const VolumeGrid> make_cube();

}  // namespace bruma::scene

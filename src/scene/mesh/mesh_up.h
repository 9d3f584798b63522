#pragma once
#include "scene/mesh/mesh_data.h"

namespace bruma::scene {

/// Whether z plainly is a mesh's up axis, where y is the usual one: it stands on a wide flat base at its lowest z, of
/// three tenths of its outline or more, with nothing like it at its highest z, as plates and extruded shapes have, nor
/// at its lowest y, and is no thin relief that may as well lie on its back. Linear time.
bool is_z_plainly_up(const TriangleMesh& mesh);

}  // namespace bruma::scene

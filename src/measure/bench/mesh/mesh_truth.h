#pragma once
#include "reference/subsurface/subsurface_view.h"
#include "scene/scene.h"

/// One translucent body of a scene as the reference sees it.
namespace bruma::measure {

/// A shown mesh in world space, metres; its triangles counter-clockwise seen from outside.
reference::TriangleMesh reference_mesh(const scene::Scene& scene, const std::string& node_name);
reference::SubsurfaceMedium reference_medium(const scene::SubsurfaceMedium& medium);
reference::SubsurfaceModel reference_model(scene::SubsurfaceModel model);

/// Leaves nothing of a body's picture but the light from inside: black surroundings, no highlight, nothing unscattered;
/// and lets each pass be drawn that is asked for.
void make_body_scene(scene::Scene& scene, const std::string& node_name);

}  // namespace bruma::measure

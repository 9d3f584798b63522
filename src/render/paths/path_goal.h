#pragma once

namespace bruma::render {

/// How far a picture that is refined by chance is to go: path tracing, and the light inside translucent meshes.
struct PathGoal {
    static constexpr int all = 1 << 30;
    int samples = 64;        ///< paths per pixel; passes over the maps of a translucent mesh
    int scatterings = all;   ///< light that was scattered more often is left out; 1: single scattering
    double budget_ms = 0.0;  ///< a picture stops short of its samples once it took this long; 0: never
    bool operator==(const PathGoal&) const = default;
};

}  // namespace bruma::render

#include "scene/builtin/builtin_transfer_functions.h"

#include <utility>

namespace bruma::scene {
namespace {

TransferFunction curves(std::vector<OpacityPoint> opacity, std::vector<ColorPoint> color,
                        std::vector<EmissionPoint> emission = {}) {
    TransferFunction tf;
    tf.opacity = std::move(opacity);
    tf.color = std::move(color);
    tf.emission = std::move(emission);
    return tf;
}

}  // namespace

TransferFunction engine_transfer_function() {
    // Aluminium sits at 0.49 of the range: its skin shows, its bulk is glass. Steel, at 1, is warm and solid.
    return curves(
        {{0.0, 0.0}, {0.12, 0.0}, {0.26, 0.16}, {0.40, 0.05}, {0.50, 0.045}, {0.62, 0.10}, {0.72, 0.65}, {1.0, 0.95}},
        {{0.0, {0.06, 0.18, 0.40}},
         {0.48, {0.16, 0.34, 0.58}},
         {0.60, {0.50, 0.30, 0.20}},
         {0.75, {0.70, 0.28, 0.06}},
         {1.0, {0.80, 0.40, 0.13}}});
}

TransferFunction bucky_transfer_function() {
    return curves({{0.0, 0.0}, {0.14, 0.0}, {0.22, 0.10}, {0.45, 0.14}, {0.62, 0.5}, {1.0, 0.9}},
                  {{0.0, {0.04, 0.12, 0.38}},
                   {0.24, {0.06, 0.24, 0.56}},
                   {0.45, {0.10, 0.46, 0.60}},
                   {0.65, {0.90, 0.44, 0.10}},
                   {1.0, {1.0, 0.80, 0.45}}});
}

TransferFunction hydrogen_transfer_function() {
    // The outer lobes peak at 0.44, their ring at 0.22; at the faces of the box the orbital has fallen to 0.08.
    return curves({{0.0, 0.0}, {0.11, 0.0}, {0.17, 0.015}, {0.22, 0.03}, {0.44, 0.08}, {0.7, 0.2}, {1.0, 0.5}},
                  {{0.0, {0.06, 0.08, 0.40}},
                   {0.18, {0.08, 0.20, 0.70}},
                   {0.32, {0.08, 0.55, 0.62}},
                   {0.45, {0.62, 0.68, 0.28}},
                   {0.7, {1.0, 0.50, 0.10}},
                   {1.0, {1.0, 0.90, 0.65}}},
                  {{0.0, 0.0}, {0.2, 0.15}, {1.0, 0.8}});
}

TransferFunction knot_transfer_function() {
    return curves({{0.0, 0.0}, {0.06, 0.0}, {0.12, 0.03}, {0.45, 0.07}, {0.60, 0.15}, {0.75, 0.7}, {1.0, 0.9}},
                  {{0.0, {0.03, 0.14, 0.40}},
                   {0.15, {0.05, 0.28, 0.60}},
                   {0.45, {0.12, 0.50, 0.62}},
                   {0.65, {0.90, 0.42, 0.08}},
                   {1.0, {1.0, 0.82, 0.50}}});
}

TransferFunction blobs_transfer_function() {
    return curves({{0.0, 0.0}, {0.04, 0.0}, {0.2, 0.02}, {0.5, 0.06}, {1.0, 0.35}}, {{0.0, {0.05, 0.16, 0.42}},
                                                                                     {0.25, {0.10, 0.38, 0.56}},
                                                                                     {0.5, {0.50, 0.55, 0.38}},
                                                                                     {0.75, {0.92, 0.50, 0.14}},
                                                                                     {1.0, {1.0, 0.85, 0.60}}});
}

TransferFunction marschner_lobb_transfer_function() {
    // The usual picture is the surface at one half: a steep edge there, solid above.
    return curves({{0.0, 0.0}, {0.48, 0.0}, {0.52, 0.8}, {1.0, 0.95}},
                  {{0.0, {0.20, 0.40, 0.60}}, {0.5, {0.80, 0.56, 0.28}}, {1.0, {0.95, 0.88, 0.72}}});
}

TransferFunction marschner_lobb_256_transfer_function() {
    // Six times as many voxels across: the same surface, with an edge of the same length.
    TransferFunction tf = marschner_lobb_transfer_function();
    tf.reference_length = 1e-3 * 256.0 / 41.0;
    return tf;
}

TransferFunction sphere_transfer_function() {
    return curves(
        {{0.0, 0.0}, {0.01, 0.0}, {0.5, 0.04}, {1.0, 0.2}},
        {{0.0, {0.06, 0.20, 0.50}}, {0.3, {0.14, 0.46, 0.60}}, {0.7, {0.92, 0.50, 0.16}}, {1.0, {1.0, 0.85, 0.60}}});
}

TransferFunction cube_transfer_function() {
    // Its only value is the upper end of the window. Half of the light is lost over 8 mm.
    TransferFunction tf = curves({{0.0, 0.0}, {0.999, 0.0}, {1.0, 0.5}}, {{0.0, {0.80, 0.56, 0.28}}});
    tf.reference_length = 8e-3;
    return tf;
}

}  // namespace bruma::scene

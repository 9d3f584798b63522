#include "render/subsurface/body_frame.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numbers>

namespace bruma::render {
namespace {

/// The rotation (or reflection) of a matrix's polar decomposition, by Newton's iteration (Higham 1986), which squares
/// its error at each turn once it is near.
glm::dmat3 rotation_of(const glm::dmat3& linear) {
    // Without its scale a matrix starts near enough.
    glm::dmat3 x = linear / std::cbrt(std::abs(glm::determinant(linear)));
    for (int turn = 0; turn < 64; ++turn) {
        const glm::dmat3 next = 0.5 * (x + glm::transpose(glm::inverse(x)));
        const glm::dmat3 change = next - x;
        x = next;
        double largest = 0.0;
        for (int k = 0; k < 9; ++k) {
            largest = std::max(largest, std::abs(change[k / 3][k % 3]));
        }
        if (largest < 1e-14) {
            break;
        }
    }
    return x;
}

}  // namespace

BodyFrame body_frame(const glm::dmat4& world_from_model, const scene::TriangleMesh& mesh) {
    BodyFrame frame;
    const glm::dmat3 linear(world_from_model);
    frame.world_from_body = rotation_of(linear);
    const glm::dmat3 stretch = glm::transpose(frame.world_from_body) * linear;
    frame.body_from_model = mm_per_m * 0.5 * (stretch + glm::transpose(stretch));
    frame.middle_world = world_from_model * glm::dvec4(0.5 * (mesh.low + mesh.high), 1.0);
    return frame;
}

BodyLamp body_lamp(const scene::Light& light, const BodyFrame& frame, glm::dvec3 camera_back_world) {
    const glm::dmat3 body_from_world = glm::transpose(frame.world_from_body);
    BodyLamp lamp;
    lamp.has_position = scene::has_position(light);
    if (!lamp.has_position) {
        const bool head = light.kind == scene::LightKind::headlight;
        lamp.toward = body_from_world * glm::normalize(head ? camera_back_world : light.direction_world);
        return lamp;
    }
    lamp.position = mm_per_m * (body_from_world * (light.position_world - frame.middle_world));
    if (light.kind == scene::LightKind::spot) {
        const double outer = std::cos(glm::radians(light.spot_angle_deg));
        const double inner = std::cos(glm::radians(light.spot_angle_deg * (1.0 - light.spot_softness)));
        lamp.axis = body_from_world * glm::normalize(light.direction_world);
        lamp.cone = {outer, 1.0 / std::max(inner - outer, 1e-6)};
    }
    return lamp;
}

std::vector<glm::dvec3> body_points(const scene::TriangleMesh& mesh, const glm::dmat3& body_from_model) {
    const glm::dvec3 middle = 0.5 * (mesh.low + mesh.high);
    std::vector<glm::dvec3> points;
    points.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) {
        points.push_back(body_from_model * (glm::dvec3(p) - middle));
    }
    return points;
}

glm::dvec3 halton_direction(unsigned n) {
    const double turn = 2.0 * std::numbers::pi * radical_inverse(n, 2);
    const double z = 2.0 * radical_inverse(n, 3) - 1.0;
    const double s = std::sqrt(1.0 - z * z);
    return {s * std::cos(turn), s * std::sin(turn), z};
}

double radical_inverse(std::uint64_t n, unsigned base) {
    double inverse = 0.0;
    for (double weight = 1.0 / base; n > 0; n /= base, weight /= base) {
        inverse += double(n % base) * weight;
    }
    return inverse;
}

}  // namespace bruma::render

#include "reference/subsurface/ray_mesh.h"

#include <embree3/rtcore.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace bruma::reference {
namespace {

void check(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) {
        throw InputError("mesh: it has no triangles, and rays need at least one; load another file");
    }
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
        throw InputError(fmt::format("mesh: {} normals for {} positions, expected as many or none; compute them afresh",
                                     mesh.normals.size(), mesh.positions.size()));
    }
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        const glm::dvec3 p = mesh.positions[n];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            throw InputError(fmt::format("mesh: position {} is ({}, {}, {}), expected finite numbers; repair the file",
                                         n, p.x, p.y, p.z));
        }
    }
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const glm::uvec3 t = mesh.triangles[n];
        if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) {
            throw InputError(fmt::format("mesh: triangle {} uses position {}, but there are {}; repair the file", n,
                                         std::max({t.x, t.y, t.z}), mesh.positions.size()));
        }
    }
}

/// A ray for Embree, lengths in bounding radii.
RTCRay unit_ray(glm::dvec3 from, glm::dvec3 direction, double near, double far) {
    RTCRay ray{};
    ray.org_x = float(from.x);
    ray.org_y = float(from.y);
    ray.org_z = float(from.z);
    ray.tnear = float(near);
    ray.dir_x = float(direction.x);
    ray.dir_y = float(direction.y);
    ray.dir_z = float(direction.z);
    ray.tfar = float(std::min(far, 1e30));
    ray.mask = ~0U;
    return ray;
}

}  // namespace

struct RayMesh::Traversal {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Traversal(const TriangleMesh& mesh, glm::dvec3 centre, double radius) {
        device = rtcNewDevice(nullptr);
        if (device == nullptr) {
            throw MachineError(
                fmt::format("Embree does not start on this machine (error {}); a reference of meshes needs it",
                            int(rtcGetDeviceError(nullptr))));
        }
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
        auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
        if (vertices == nullptr || indices == nullptr) {
            rtcReleaseGeometry(geometry);
            release();
            throw MachineError(
                fmt::format("mesh: no memory for {} triangles; load a smaller one", mesh.triangles.size()));
        }
        for (const glm::dvec3& position : mesh.positions) {
            const glm::dvec3 p = (position - centre) / radius;
            *vertices++ = float(p.x);
            *vertices++ = float(p.y);
            *vertices++ = float(p.z);
        }
        for (const glm::uvec3& triangle : mesh.triangles) {
            *indices++ = triangle.x;
            *indices++ = triangle.y;
            *indices++ = triangle.z;
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
            release();
            throw MachineError(fmt::format("mesh: Embree cannot order {} triangles for rays; free some memory",
                                           mesh.triangles.size()));
        }
    }
    ~Traversal() { release(); }
    Traversal(const Traversal&) = delete;
    Traversal& operator=(const Traversal&) = delete;

    void release() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

RayMesh::RayMesh(TriangleMesh mesh) : mesh_(std::move(mesh)) {
    check(mesh_);
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const glm::uvec3& triangle : mesh_.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            low = glm::min(low, mesh_.positions[triangle[corner]]);
            high = glm::max(high, mesh_.positions[triangle[corner]]);
        }
    }
    centre_ = 0.5 * (low + high);
    for (const glm::uvec3& triangle : mesh_.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            radius_ = std::max(radius_, glm::length(mesh_.positions[triangle[corner]] - centre_));
        }
    }
    if (radius_ == 0.0) {
        throw InputError("mesh: all its corners are one point, and rays need a surface; load another file");
    }
    traversal_ = std::make_shared<const Traversal>(mesh_, centre_, radius_);
}

glm::dvec3 RayMesh::area_vector(std::uint32_t triangle) const {
    const glm::uvec3 t = mesh_.triangles[triangle];
    const glm::dvec3& a = mesh_.positions[t.x];
    return glm::cross(mesh_.positions[t.y] - a, mesh_.positions[t.z] - a);
}

glm::dvec3 RayMesh::position_at(std::uint32_t triangle, glm::dvec2 b) const {
    const glm::uvec3 t = mesh_.triangles[triangle];
    return (1.0 - b.x - b.y) * mesh_.positions[t.x] + b.x * mesh_.positions[t.y] + b.y * mesh_.positions[t.z];
}

glm::dvec3 RayMesh::normal_at(std::uint32_t triangle, glm::dvec2 b) const {
    if (!mesh_.normals.empty()) {
        const glm::uvec3 t = mesh_.triangles[triangle];
        const glm::dvec3 n =
            (1.0 - b.x - b.y) * mesh_.normals[t.x] + b.x * mesh_.normals[t.y] + b.y * mesh_.normals[t.z];
        const double length = glm::length(n);
        if (length > 1e-6) {
            return n / length;
        }
    }
    const glm::dvec3 area = area_vector(triangle);
    const double length = glm::length(area);
    return length > 0.0 ? area / length : glm::dvec3(0.0, 0.0, 1.0);
}

std::optional<MeshHit> RayMesh::first_hit(glm::dvec3 origin, glm::dvec3 direction, double limit) const {
    RTCRayHit query{};
    query.ray = unit_ray((origin - centre_) / radius_, direction, surface_offset() / radius_, limit / radius_);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(traversal_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    MeshHit hit;
    hit.triangle = query.hit.primID;
    const glm::dvec3 area = area_vector(hit.triangle);
    const double twice_area = glm::length(area);
    if (!(twice_area > 0.0)) {
        return std::nullopt;
    }
    hit.geometric_normal = area / twice_area;
    // In float the point is off by 1e-7 of the mesh; where the ray meets the plane in double is exact unless it grazes.
    const glm::uvec3 t = mesh_.triangles[hit.triangle];
    const glm::dvec3& a = mesh_.positions[t.x];
    hit.t = double(query.ray.tfar) * radius_;
    const double cosine = glm::dot(direction, hit.geometric_normal);
    if (std::abs(cosine) > 1e-3) {
        hit.t = glm::dot(a - origin, hit.geometric_normal) / cosine;
    }
    const glm::dvec3 met = origin + hit.t * direction - a;
    const glm::dvec3 ab = mesh_.positions[t.y] - a;
    const glm::dvec3 ac = mesh_.positions[t.z] - a;
    const double per_area2 = 1.0 / (twice_area * twice_area);
    glm::dvec2 b(glm::dot(glm::cross(met, ac), area) * per_area2, glm::dot(glm::cross(ab, met), area) * per_area2);
    b = glm::max(b, glm::dvec2(0.0));
    hit.barycentric = b / std::max(1.0, b.x + b.y);
    hit.position = position_at(hit.triangle, hit.barycentric);
    hit.shading_normal = normal_at(hit.triangle, hit.barycentric);
    return hit;
}

bool RayMesh::blocked(glm::dvec3 origin, glm::dvec3 direction, double limit) const {
    RTCRay ray = unit_ray((origin - centre_) / radius_, direction, surface_offset() / radius_, limit / radius_);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(traversal_->scene, &context, &ray);
    return ray.tfar < 0.0F;
}

}  // namespace bruma::reference

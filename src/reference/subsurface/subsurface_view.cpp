#include "reference/subsurface/subsurface_view.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>

#include "base/error.h"
#include "reference/subsurface/subsurface_random_walk.h"
#include "reference/subsurface/subsurface_sampling.h"

namespace bruma::reference {
namespace {

using std::numbers::pi;

constexpr double mm_per_m = 1000.0;

RayMesh in_millimetres(TriangleMesh mesh) {
    for (glm::dvec3& position : mesh.positions) {
        position *= mm_per_m;
    }
    return RayMesh(std::move(mesh));
}

/// Camera rays and their reverse, in mm.
class Eye {
  public:
    Eye(const scene::Camera& camera, int width, int height)
        : camera_(camera), frame_(scene::camera_frame(camera)), width_(width), height_(height) {
        const double extent = camera.projection == scene::Projection::orthographic
                                  ? camera.view_height * mm_per_m
                                  : 2.0 * std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
        pixel_ = extent / height;
    }

    std::optional<MeshHit> hit(const RayMesh& mesh, int x, int y, glm::dvec3& direction) const {
        const scene::Ray ray = scene::camera_ray(camera_, x + 0.5, y + 0.5, width_, height_);
        direction = ray.direction_world;
        const double near = ray.t_near * mm_per_m;
        return mesh.first_hit(ray.origin_world * mm_per_m + near * direction, direction);
    }

    struct Place {
        std::size_t pixel = 0;
        glm::dvec3 to_eye{0.0};
        double distance = 0.0;         ///< to the near plane, mm
        double pixels_per_area = 0.0;  ///< 1/mm^2 of a surface that faces the eye
    };
    /// Where a point of space falls in the picture, if it does.
    std::optional<Place> place(glm::dvec3 position) const {
        const glm::dvec3 from_eye = position - camera_.eye_world * mm_per_m;
        const double depth = -glm::dot(from_eye, frame_.back_world);
        const double near = camera_.near_distance * mm_per_m;
        if (depth <= near) {
            return std::nullopt;
        }
        Place place;
        const bool flat = camera_.projection == scene::Projection::orthographic;
        const double per_pixel = flat ? 1.0 / pixel_ : 1.0 / (pixel_ * depth);
        const double x = 0.5 * width_ + glm::dot(from_eye, frame_.right_world) * per_pixel;
        const double y = 0.5 * height_ - glm::dot(from_eye, frame_.up_world) * per_pixel;
        if (!(x >= 0.0 && x < width_ && y >= 0.0 && y < height_)) {
            return std::nullopt;
        }
        place.pixel = std::size_t(y) * std::size_t(width_) + std::size_t(x);
        if (flat) {
            place.to_eye = frame_.back_world;
            place.distance = depth - near;
            place.pixels_per_area = per_pixel * per_pixel;
        } else {
            const double distance = glm::length(from_eye);
            place.to_eye = -from_eye / distance;
            place.distance = distance * (1.0 - near / depth);
            place.pixels_per_area = per_pixel * per_pixel * distance / depth;  // foreshortened by the tilt of the ray
        }
        return place;
    }

  private:
    scene::Camera camera_;
    scene::CameraFrame frame_;
    int width_, height_;
    double pixel_;  ///< height of a pixel: mm, or mm at a depth of 1 mm
};

/// Light that an eye ray brings straight through the body.
glm::dvec3 unscattered(const RayMesh& mesh, const SubsurfaceMedium& medium, const MeshHit& near_side,
                       glm::dvec3 direction, const std::function<glm::dvec3(glm::dvec3)>& environment) {
    const double cosine = -glm::dot(direction, near_side.geometric_normal);
    if (!environment || cosine <= 0.0) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 inside = refract_into(-direction, near_side.geometric_normal, medium.eta);
    const auto far_side = mesh.first_hit(near_side.position, inside);
    if (!far_side || glm::dot(inside, far_side->geometric_normal) <= 0.0) {
        return glm::dvec3(0.0);
    }
    const auto outside = refract_out(inside, far_side->geometric_normal, medium.eta);
    if (!outside) {
        return glm::dvec3(0.0);  // totally reflected: what it meets then is left to the model
    }
    glm::dvec3 radiance = environment(*outside) * fresnel_transmittance(cosine, medium.eta) *
                          fresnel_transmittance(glm::dot(*outside, far_side->geometric_normal), medium.eta);
    for (int c = 0; c < 3; ++c) {
        radiance[c] *= unscattered_transmittance(medium.channel(c), far_side->t);
    }
    return radiance;
}

class Progress {
  public:
    Progress(const std::function<void(double)>& told, double total) : told_(told), total_(total) {}
    void add(double part) {
        if (told_) {
            const std::lock_guard lock(mutex_);
            done_ += part;
            told_(done_ / total_);
        }
    }

  private:
    const std::function<void(double)>& told_;
    std::mutex mutex_;
    double done_ = 0.0, total_;
};

/// What all of a light's photons carry together and where they start: a disk across a directional light, a cone of
/// directions from a point light. Weights are flux, mm^2 times irradiance.
struct PhotonStart {
    glm::dvec3 origin{0.0}, direction{0.0};
    double weight = 0.0;  ///< for strength 1
};

PhotonStart photon_start(const RayMesh& mesh, const BodyLight& light, double u, double v) {
    const double bound = 1.001 * mesh.bounding_radius();
    const auto frame = [](glm::dvec3 axis) {
        const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
        const glm::dvec3 right = glm::normalize(glm::cross(other, axis));
        return glm::dmat3(right, glm::cross(axis, right), axis);
    };
    if (light.directional) {
        const glm::dvec2 across = bound * uniform_disk_point(u, v);
        const glm::dvec3 origin = mesh.bounding_centre() + frame(light.to_light) * glm::dvec3(across, 2.0 * bound);
        return {origin, -light.to_light, pi * bound * bound};
    }
    const glm::dvec3 way = mesh.bounding_centre() - light.position;
    const double distance = glm::length(way);
    // From within the bounding sphere light may go anywhere.
    const double cos_edge = distance > bound ? std::sqrt(1.0 - bound * bound / (distance * distance)) : -1.0;
    const double cosine = 1.0 - u * (1.0 - cos_edge);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const glm::dvec3 axis = distance > 0.0 ? way / distance : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 local(sine * std::cos(2.0 * pi * v), sine * std::sin(2.0 * pi * v), cosine);
    return {light.position, frame(axis) * local, 2.0 * pi * (1.0 - cos_edge)};
}

void add_pixel(SubsurfaceView& view, std::size_t pixel, glm::dvec3 radiance, glm::dvec3 error) {
    for (int c = 0; c < 3; ++c) {
        view.image.rgba[4 * pixel + std::size_t(c)] += float(radiance[c]);
    }
    view.error[pixel] = glm::vec3(error);
}

void render_by_quadrature(SubsurfaceView& view, const RayMesh& mesh, const SubsurfaceMedium& medium,
                          const std::vector<BodyLight>& lights, const Eye& eye, const SubsurfaceViewOptions& options) {
    const Bssrdf bssrdf(medium, options.model);
    const SubsurfaceQuadrature quadrature(mesh, bssrdf, lights, options.quadrature);
    Progress progress(options.progress, double(view.image.pixel_count()));
    std::atomic<std::uint64_t> evaluations = 0;
    tbb::parallel_for(std::size_t(0), view.image.pixel_count(), [&](std::size_t n) {
        glm::dvec3 direction;
        const auto hit =
            eye.hit(mesh, int(n % std::size_t(view.image.width)), int(n / std::size_t(view.image.width)), direction);
        if (hit) {
            const QuadratureResult result = quadrature.at({hit->position, hit->shading_normal});
            // Where a triangle's normals turn away from the eye and the triangle does not, it stands for an outline.
            const double facing = std::max(-glm::dot(direction, hit->shading_normal),
                                           std::min(0.1, std::abs(glm::dot(direction, hit->geometric_normal))));
            const double t_21 = fresnel_transmittance(facing, medium.eta);
            add_pixel(view, n, t_21 * result.value, t_21 * result.error);
            evaluations += result.evaluations;
        }
        progress.add(1.0);
    });
    view.evaluations = evaluations;
}

void render_by_walks(SubsurfaceView& view, const RayMesh& mesh, const SubsurfaceMedium& medium,
                     const std::vector<BodyLight>& lights, const Eye& eye, const SubsurfaceViewOptions& options) {
    const MeshBody body(mesh);
    const double per_exitance = 1.0 / (4.0 * pi * diffuse_boundary(medium.eta).c_phi_inverse);
    // Each batch has a picture of its own: their scatter is the error whatever is correlated within, and adding them in
    // order makes the result independent of threads.
    constexpr std::size_t batches = 32;
    const std::uint64_t per_batch = (options.paths + batches - 1) / batches;
    std::vector<std::vector<glm::dvec3>> sums(batches);
    std::atomic<std::uint64_t> entered = 0;
    std::atomic<std::uint64_t> lost = 0;
    Progress progress(options.progress, double(batches));
    tbb::parallel_for(std::size_t(0), batches, [&](std::size_t batch) {
        sums[batch].assign(view.image.pixel_count(), glm::dvec3(0.0));
        std::uint32_t stream = 0;
        for (const BodyLight& light : lights) {
            for (int c = 0; c < 3; ++c, ++stream) {
                const SubsurfaceChannel channel = medium.channel(c);
                for (std::uint64_t n = 0; n < per_batch && light.strength[c] > 0.0; ++n) {
                    RandomStream random(options.seed, stream, batch * per_batch + n);
                    const double u = random.uniform();
                    const PhotonStart start = photon_start(mesh, light, u, random.uniform());
                    const auto entry = mesh.first_hit(start.origin, start.direction);
                    const double cosine = entry ? -glm::dot(start.direction, entry->geometric_normal) : 0.0;
                    if (cosine <= 0.0) {
                        continue;
                    }
                    ++entered;
                    const glm::dvec3 inside = refract_into(-start.direction, entry->geometric_normal, medium.eta);
                    const Walk walk = random_walk(body, channel, entry->position, inside, random);
                    lost += walk.fate == WalkFate::lost ? 1 : 0;
                    if (walk.fate != WalkFate::escaped) {
                        continue;
                    }
                    const auto place = eye.place(walk.position);
                    if (!place) {
                        continue;
                    }
                    const double facing = glm::dot(place->to_eye, walk.normal);
                    if (facing <= 0.0 || mesh.blocked(walk.position, place->to_eye, place->distance)) {
                        continue;
                    }
                    const double flux = light.strength[c] * share_towards(light, -start.direction) * start.weight /
                                        double(per_batch) * walk.weight * fresnel_transmittance(cosine, medium.eta);
                    sums[batch][place->pixel][c] += flux * place->pixels_per_area * facing * per_exitance *
                                                    fresnel_transmittance(facing, medium.eta);
                }
            }
        }
        progress.add(1.0);
    });
    for (std::size_t pixel = 0; pixel < view.image.pixel_count(); ++pixel) {
        glm::dvec3 sum(0.0);
        glm::dvec3 squares(0.0);
        for (const auto& batch : sums) {
            sum += batch[pixel];
            squares += batch[pixel] * batch[pixel];
        }
        const glm::dvec3 mean = sum / double(batches);
        const glm::dvec3 variance = glm::max(squares / double(batches) - mean * mean, glm::dvec3(0.0));
        add_pixel(view, pixel, mean, glm::sqrt(variance / double(batches - 1)));
    }
    view.paths = entered;
    view.lost = lost;
}

}  // namespace

BodyLight body_light(const scene::Light& light, const scene::Camera& camera) {
    BodyLight body;
    body.strength = light.on ? light.color * light.intensity : glm::dvec3(0.0);
    if (scene::has_position(light)) {
        body.directional = false;
        body.spot = light.kind == scene::LightKind::spot ? std::optional(light) : std::nullopt;
        body.position = light.position_world * mm_per_m;
        body.strength *= mm_per_m * mm_per_m;  // given at 1 m
    } else if (light.kind == scene::LightKind::headlight) {
        body.to_light = scene::camera_frame(camera).back_world;
    } else {
        body.to_light = glm::normalize(light.direction_world);
    }
    return body;
}

SubsurfaceView render_subsurface(const TriangleMesh& mesh_world, const SubsurfaceMedium& medium,
                                 const std::vector<scene::Light>& lights, const scene::Camera& camera, int width,
                                 int height, const SubsurfaceViewOptions& options) {
    if (width < 1 || height < 1) {
        throw InputError(fmt::format("reference: a picture of {} x {} pixels holds nothing; both must be at least 1",
                                     width, height));
    }
    check(medium);
    const RayMesh mesh = in_millimetres(mesh_world);
    const Eye eye(camera, width, height);
    std::vector<BodyLight> body_lights;
    for (const scene::Light& light : lights) {
        if (light.on && light.intensity > 0.0) {
            body_lights.push_back(body_light(light, camera));
        }
    }
    SubsurfaceView view;
    view.image = Image(width, height);
    view.error.assign(view.image.pixel_count(), glm::vec3(0.0F));
    if (options.method == SubsurfaceMethod::quadrature) {
        render_by_quadrature(view, mesh, medium, body_lights, eye, options);
    } else {
        render_by_walks(view, mesh, medium, body_lights, eye, options);
    }
    double squares = 0.0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            glm::dvec3 direction;
            const std::size_t n = std::size_t(y) * std::size_t(width) + std::size_t(x);
            squares += glm::dot(view.error[n], view.error[n]);
            if (const auto hit = eye.hit(mesh, x, y, direction)) {
                view.image.pixel(x, y)[3] = 1.0F;
                add_pixel(view, n, unscattered(mesh, medium, *hit, direction, options.environment), view.error[n]);
            }
        }
    }
    view.rms_error = std::sqrt(squares / double(3 * view.image.pixel_count()));
    return view;
}

}  // namespace bruma::reference

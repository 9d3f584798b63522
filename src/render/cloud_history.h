#pragma once
#include "gl/full_screen.h"
#include "gl/shader_library.h"
#include "gl/texture.h"
#include "scene/scene.h"

namespace bruma::render {

/// What one layer of clouds adds to each pixel. Bottom row first.
struct CloudPicture {
    gl::Texture radiance;  ///< linear, added; alpha: transmittance
    gl::Texture distance;  ///< mean along the ray, metres, weighted by what each part hides; 0: nothing is hidden
    gl::Framebuffer framebuffer;
};
void make_targets(CloudPicture& picture, glm::ivec2 pixels);

/// From where and when a picture was seen.
struct CloudSight {
    scene::Camera camera;
    glm::dvec3 drifted_m{0.0};  ///< how far the wind has carried the clouds
    bool operator==(const CloudSight&) const = default;
};

/// Makes whole pictures of clouds from a sixteenth of their pixels and the last picture.
class CloudHistory {
  public:
    /// Turns after which a still picture has been marched in all its pixels.
    static constexpr int turns = 16;

    /// Size of the picture that holds the marched pixels.
    static glm::ivec2 sparse_size(glm::ivec2 pixels) { return (pixels + 3) / 4; }
    /// Which pixel of each four by four this turn marches: an order in which neighbours are far apart in time.
    glm::ivec2 offset() const;
    /// Where to march them.
    CloudPicture& sparse(glm::ivec2 pixels);

    /// A whole picture was marched from `sight`.
    void begin(const CloudSight& sight);
    /// Fills `picture`, which holds the last one, from what was marched and from itself.
    void resolve(gl::ShaderLibrary& shaders, const CloudSight& sight, CloudPicture& picture);

    /// Turns that are missing until the picture is as if all of it had been marched.
    int missing() const { return missing_; }

  private:
    CloudPicture sparse_, last_;
    struct Statistics {
        gl::Texture mean, spread, distance;
        gl::Framebuffer framebuffer;
    } statistics_;
    gl::FullScreen full_screen_;
    CloudSight sight_;
    int turn_ = 0;
    int missing_ = 0;
};

}  // namespace bruma::render

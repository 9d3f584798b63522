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
    gl::Texture
        missing;  ///< depth of a picture from history: 1 where that cannot tell, and the pixel has to be marched
    gl::Framebuffer resolved;
};
void make_targets(CloudPicture& picture, glm::ivec2 pixels);

/// From where and when a picture was seen, and how finely.
struct CloudSight {
    scene::Camera camera;
    glm::dvec3 drifted_m{0.0};  ///< how far the wind has carried the clouds
    glm::ivec2 pixels{0};
    double step_scale = 1.0;
    bool operator==(const CloudSight&) const = default;
    /// Whether a picture seen from `last` says much about one from here: clouds went by less than this, and its pixels
    /// are not much larger.
    static constexpr double farthest_m = 100.0, most_growth = 1.6;
    bool is_near(const CloudSight& last) const {
        return glm::length(moved_m(last)) < farthest_m &&
               glm::all(glm::lessThanEqual(glm::dvec2(pixels), most_growth * glm::dvec2(last.pixels)));
    }
    /// How the eye has moved among the clouds since then.
    glm::dvec3 moved_m(const CloudSight& last) const {
        return (camera.eye_world - last.camera.eye_world) - (drifted_m - last.drifted_m);
    }
};

/// Makes whole pictures of clouds from a sixteenth of their pixels and the last picture.
class CloudHistory {
  public:
    /// Turns after which a still picture has been marched in all its pixels.
    static constexpr int turns = 16;

    /// Size of the picture that holds the marched pixels.
    static glm::ivec2 sparse_size(glm::ivec2 pixels) { return (pixels + 3) / 4; }
    bool is_near(const CloudSight& sight) const { return sight.is_near(sight_); }
    /// Begins a turn that is seen from `sight`, near the last one.
    void look(const CloudSight& sight);
    /// Which pixel of each four by four this turn marches: an order in which neighbours are far apart in time.
    glm::ivec2 offset() const;
    /// Where to march them.
    CloudPicture& sparse(glm::ivec2 pixels);

    /// A whole picture was marched from `sight`.
    void begin(const CloudSight& sight);
    /// Fills `picture`, which holds the last one, from what was marched and from itself. True when the view is not the
    /// last one's, so that pixels may be missing.
    bool resolve(gl::ShaderLibrary& shaders, CloudPicture& picture);

    /// Turns that are missing until the picture is as if all of it had been marched.
    int missing() const { return missing_; }

  private:
    CloudPicture sparse_, last_;
    struct Statistics {
        gl::Texture mean, spread, distance;
        gl::Framebuffer framebuffer;
    } statistics_;
    gl::FullScreen full_screen_;
    CloudSight sight_, last_sight_;
    int turn_ = 0;
    int missing_ = 0;
};

}  // namespace bruma::render

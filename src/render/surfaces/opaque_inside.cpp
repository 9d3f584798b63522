#include <algorithm>
#include <array>
#include <cmath>

#include "render/subsurface/subsurface_entry.h"
#include "render/surfaces/opaque_pass.h"

// Translucent meshes of the opaque pass: what shines out of them.
namespace bruma::render {
namespace {

/// Points per lamp for a pixel that no map sees well: turns of 64. Beside the maps' means their noise, a tenth of the
/// value with one turn, would be seen.
constexpr int points_in_turn = 64;
constexpr int turns_beside_maps = 4;
constexpr std::int64_t most_turns = 64;

/// Layout of mesh.frag: pixels that maps left open, and the first and last of them.
struct OpenTotals {
    std::uint32_t count = 0;
    glm::uvec2 low{~0U}, high{0U};
};

}  // namespace

std::uint32_t OpaquePass::draw_translucent(const PassAccess& access, const Parameters& parameters, const MeshView& view,
                                           const MeshInput& input) {
    // From the maps first, which leaves samples open that none of them sees: black, alpha 0; light from points, which
    // is dear, for the pixels of these.
    const bool see_through = draw_thickness(access, parameters, view, input);
    OpaquePicture& out = access.write(picture);
    if (!out.open || out.open.size() != out.layers.shown[0].radiance.size()) {
        out.open = gl::Texture::make_2d("open pixels", GL_R32UI, parameters.pixels);
        out.open.set_nearest();
    }
    std::array<OpenTotals, 1> totals;
    const std::uint32_t closed = 0;
    glClearTexImage(out.open.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &closed);
    const gl::Buffer buffer("open pixels", std::span<const OpenTotals>(totals));
    gl::Defines defines = defines_of(parameters);
    defines["TRANSLUCENT"] = "";
    if (input.colored) {
        defines["VERTEX_COLORS"] = "";
    }
    const auto draw = [&] {
        gl::Program& program = prepared_program(access, parameters, view, defines);
        gl::Buffer lamps;
        set_inside(access, program, input, lamps);
        program.set("see_through", see_through ? 1 : 0);
        program.set("sigma_unscattered", glm::vec3(input.inside.shown->constants.sigma_unscattered));
        program.set("thickness", 6);
        if (see_through) {
            out.thickness.bind(6);
        }
        program.set("open_pixels", defines.contains("FROM_POINTS") ? 7 : 0);
        draw_mesh(access, program, input, view, parameters.shadows);
    };
    glBindImageTexture(0, out.open.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
    buffer.bind_storage(3);
    defines["EXIT_MAPS"] = access.read(input.inside.shown->exits).room();
    draw();
    defines.erase("EXIT_MAPS");
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    buffer.read(std::span<OpenTotals>(totals));
    const OpenTotals& open = totals.front();
    if (open.count > 0) {
        defines["FROM_POINTS"] = "";
        defines.merge(entry_defines(access.read(input.inside.shown->light), input.inside.shown->settings));
        out.open.bind(7);
        glEnable(GL_SCISSOR_TEST);
        glScissor(int(open.low.x), int(open.low.y), int(open.high.x - open.low.x) + 1,
                  int(open.high.y - open.low.y) + 1);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
        glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);  // distances are there
        draw();
        glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDisable(GL_BLEND);
        glDisable(GL_SCISSOR_TEST);
    }
    return open.count;
}

bool OpaquePass::draw_thickness(const PassAccess& access, const Parameters& parameters, const MeshView& view,
                                const MeshInput& input) {
    const TranslucentPasses::Shown& shown = *input.inside.shown;
    const glm::dvec3 sigma = shown.constants.sigma_unscattered;
    const double radius = access.read(shown.light).bounding_radius;
    // Where less than e^-4 is left after half the body, what is scattered outshines the rest.
    const bool any_comes_through = std::min({sigma.x, sigma.y, sigma.z}) * radius < 4.0;
    if (!shown.settings.unscattered || parameters.environment.radiance == glm::dvec3(0.0) || !any_comes_through ||
        !access.read(input.placed.triangles)->closed) {
        return false;
    }
    OpaquePicture& out = access.write(picture);
    if (!out.thickness || out.thickness.size() != out.layers.shown[0].radiance.size()) {
        out.thickness_framebuffer = {};
        out.thickness = gl::Texture::make_2d("thickness", GL_R32F, glm::ivec2(out.layers.shown[0].radiance.size()));
        out.thickness_framebuffer = gl::Framebuffer("thickness", {&out.thickness});
    }
    const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    glClearNamedFramebufferfv(out.thickness_framebuffer.name(), GL_COLOR, 0, nothing);
    out.thickness_framebuffer.bind();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    gl::Program& program = prepared_program(access, parameters, view, {{"THICKNESS", ""}});
    program.set("mm_per_unit", float(1e3 * view.unit_world));
    draw_mesh(access, program, input, view, {});
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    out.sampled.target(out.layers).bind();
    return true;
}

void OpaquePass::set_inside(const PassAccess& access, gl::Program& program, const MeshInput& input, gl::Buffer& lamps) {
    const TranslucentPasses::Shown& shown = *input.inside.shown;
    const ExitMaps& exits = access.read(shown.exits);
    exits.bind_cameras();
    access.read(shown.radiosity).mean.bind(2);
    program.set("radiosity", 2);
    set_entry(program, access.read(shown.light), shown.constants, shown.powers, 3, lamps);
    program.set("diffuse_reflectance", glm::vec3(shown.constants.diffuse_reflectance));
    set_entry_points(program, 0, points_in_turn);
    // Without maps all pixels get the points that the maps' texels would have got.
    const std::int64_t turns = access.read(shown.radiosity).passes * shown.settings.samples / points_in_turn;
    program.set("entry_turns",
                exits.maps > 0 ? turns_beside_maps : int(std::clamp(turns, std::int64_t(1), most_turns)));
    set_body(program, shown.frame.body_from_model);
}

}  // namespace bruma::render

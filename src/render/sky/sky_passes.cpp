#include "render/sky/sky_passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "render/view_rays.h"
#include "scene/sky/sun_lamp.h"

namespace bruma::render {
namespace {

// Sizes after Hillaire 2020, section 5. 32-bit floats: half floats leave bands under long exposure.
constexpr glm::ivec2 transmittance_size{256, 64}, multiple_size{32, 32}, irradiance_size{256, 2}, view_size{192, 108};

void dispatch_over(glm::ivec2 size, glm::ivec2 group) {
    glDispatchCompute(GLuint((size.x + group.x - 1) / group.x), GLuint((size.y + group.y - 1) / group.y), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void bind_image(GLuint unit, const gl::Texture& texture) {
    glBindImageTexture(unit, texture.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
}

void make_table(gl::Texture& texture, const char* label, glm::ivec2 size) {
    if (!texture) {
        texture = gl::Texture::make_2d(label, GL_RGBA32F, size);
    }
}

void make_targets(SkyPicture& picture, glm::ivec2 pixels, int layers) {
    picture.layers.resize(std::size_t(layers));
    for (SkyPicture::Layer& layer : picture.layers) {
        if (!layer.color || glm::ivec2(layer.color.size()) != pixels) {
            layer.framebuffer = {};
            layer.color = gl::Texture::make_2d("sky", GL_RGBA32F, pixels);
            layer.framebuffer = gl::Framebuffer("sky", {&layer.color});
        }
    }
}

/// From one metre up the horizon has an angle of its own; below the ground nothing is to be seen.
double eye_altitude_m(const scene::Camera& camera) {
    return std::max(1.0, camera.eye_world.y);
}

/// Nearest of altitudes about a thousandth apart, so that a camera that sways makes no new table. Its rows follow the
/// true horizon; what is left changes the sky by less than a thousandth.
double rounded_altitude_m(double altitude_m) {
    constexpr double soft = 50.0, steps = 1024.0;
    return std::max(1.0, soft * std::expm1(std::round(std::log1p(altitude_m / soft) * steps) / steps));
}

/// Above this the sky is a thin band over the horizon, which the rows of the sky view do not resolve.
constexpr double highest_view_m = 20e3;

bool is_marched(const scene::Camera& camera, const scene::Atmosphere& atmosphere) {
    return camera.projection == scene::Projection::orthographic ||
           eye_altitude_m(camera) > std::min(highest_view_m, atmosphere.height_m);
}

void define_model(gl::Defines& defines, scene::SkyModel model) {
    if (model != scene::SkyModel::atmosphere) {
        defines[model == scene::SkyModel::preetham ? "PREETHAM" : "LOOK"] = "";
    }
}

}  // namespace

SkyPasses::SkyPasses(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {
    atmosphere_ = graph.add_source<scene::Atmosphere>("atmosphere");
    camera_ = graph.add_source<scene::Camera>("camera");
    shader_revision_ = graph.add_source<int>("shaders");
    transmittance = graph.add_product<SkyTable>("transmittance of air");
    multiple_scattering = graph.add_product<SkyTable>("multiple scattering in air");
    irradiance = graph.add_product<SkyTable>("sky on the ground");
    view = graph.add_product<SkyViewTables>("sky view");
    light = graph.add_product<SkyLight>("light from the sky");
    picture = graph.add_product<SkyPicture>("sky picture");
    const int air = atmosphere_.index, code = shader_revision_.index;
    transmittance_pass_ = graph.add_pass({"sky_transmittance",
                                          "how much light comes through the air",
                                          {air, code},
                                          {transmittance.index},
                                          [this](const PassAccess& access) { make_transmittance(access); }});
    multiple_pass_ = graph.add_pass({"sky_multiple_scattering",
                                     "light scattered more than once by the air",
                                     {air, code, transmittance.index},
                                     {multiple_scattering.index},
                                     [this](const PassAccess& access) { make_multiple_scattering(access); }});
    irradiance_pass_ =
        graph.add_pass({"sky_irradiance", "light of the whole sky on the ground", {}, {irradiance.index}, {}});
    view_pass_ = graph.add_pass({"sky_view", "the sky around the camera's altitude", {}, {view.index}, {}});
    light_pass_ = graph.add_pass({"sky_light", "what sun and sky send into the scene", {}, {light.index}, {}});
    picture_pass_ = graph.add_pass({"sky", "sky and ground, and the air before surfaces", {}, {picture.index}, {}});
}

SkyPasses::~SkyPasses() {
    for (const PassId pass :
         {transmittance_pass_, multiple_pass_, irradiance_pass_, view_pass_, light_pass_, picture_pass_}) {
        graph_.remove_pass(pass);
    }
    for (const int source : {atmosphere_.index, camera_.index, shader_revision_.index}) {
        graph_.remove_source(source);
    }
}

void SkyPasses::update(const scene::Scene& scene, Handle<OpaquePicture> opaque, glm::ivec2 pixels) {
    const scene::Outdoors& outdoors = *scene.outdoors;
    const scene::Camera& camera = **scene.camera;
    graph_.set_source(atmosphere_, *outdoors.atmosphere, outdoors.atmosphere.revision());
    graph_.set_source(camera_, camera, scene.camera->revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    const bool multiple = outdoors.sky->multiple_scattering;
    std::vector<int> tables{atmosphere_.index, shader_revision_.index, transmittance.index};
    if (multiple) {
        tables.push_back(multiple_scattering.index);
    }
    graph_.set_reads(irradiance_pass_, tables);
    const ModelParameters model = model_parameters(*outdoors.sky);
    graph_.set_parameters(irradiance_pass_, model);
    graph_.set_execute(irradiance_pass_,
                       [this, model, multiple](const PassAccess& access) { make_irradiance(access, model, multiple); });
    tables.push_back(irradiance.index);

    const ViewParameters view_parameters{rounded_altitude_m(eye_altitude_m(camera)),
                                         scene::to_sun_world(*outdoors.sun).y};
    graph_.set_reads(view_pass_, tables);
    graph_.set_parameters(view_pass_, view_parameters);
    graph_.set_execute(view_pass_, [this, view_parameters, multiple](const PassAccess& access) {
        make_view(access, view_parameters, multiple);
    });

    graph_.set_reads(light_pass_, tables);
    graph_.set_parameters(light_pass_, *outdoors.sun);
    graph_.set_execute(light_pass_, [this, sun = *outdoors.sun, multiple](const PassAccess& access) {
        make_light(access, sun, multiple);
    });

    const bool marched = is_marched(camera, *outdoors.atmosphere);
    tables.push_back(camera_.index);
    if (opaque.index >= 0) {
        tables.push_back(opaque.index);
    }
    if (!marched) {
        tables.push_back(view.index);
    }
    const PictureParameters parameters{pixels, *outdoors.sky, *outdoors.sun, opaque,
                                       skipped_distance(camera, scene::world_bounds(scene))};
    graph_.set_reads(picture_pass_, tables);
    graph_.set_parameters(picture_pass_, parameters);
    graph_.set_execute(picture_pass_,
                       [this, parameters, marched](const PassAccess& access) { draw(access, parameters, marched); });
}

AirTables SkyPasses::air(const scene::Outdoors& outdoors) const {
    return {*outdoors.atmosphere, outdoors.sun->irradiance, transmittance,
            outdoors.sky->multiple_scattering ? multiple_scattering : Handle<SkyTable>{}};
}

GLuint SkyPasses::bind_tables(const PassAccess& access, gl::Program& program, bool multiple,
                              bool irradiance_too) const {
    set_air(program, access.read(atmosphere_));
    // Nothing bound reads as 0.
    const gl::Texture none;
    (access.read(transmittance).texture).bind(0);
    (multiple ? access.read(multiple_scattering).texture : none).bind(1);
    (irradiance_too ? access.read(irradiance).texture : none).bind(2);
    program.set("transmittance_table", 0);
    program.set("multiple_table", 1);
    program.set("irradiance_table", 2);
    return 3;
}

void SkyPasses::make_transmittance(const PassAccess& access) {
    SkyTable& table = access.write(transmittance);
    make_table(table.texture, "transmittance of air", transmittance_size);
    gl::Program& program = shaders_.get("sky/sky_transmittance.comp");
    set_air(program, access.read(atmosphere_));
    program.use();
    bind_image(0, table.texture);
    dispatch_over(transmittance_size, {8, 8});
}

void SkyPasses::make_multiple_scattering(const PassAccess& access) {
    SkyTable& table = access.write(multiple_scattering);
    make_table(table.texture, "multiple scattering in air", multiple_size);
    gl::Program& program = shaders_.get("sky/sky_multiple_scattering.comp");
    bind_tables(access, program, false, false);
    program.use();
    bind_image(0, table.texture);
    dispatch_over(multiple_size, {8, 8});
}

SkyPasses::ModelParameters SkyPasses::model_parameters(const scene::Sky& sky) {
    switch (sky.model) {
        case scene::SkyModel::atmosphere:
            return {};
        case scene::SkyModel::preetham:
            return {sky.model, sky.turbidity, {}};
        case scene::SkyModel::look:
            break;
    }
    return {sky.model, sky.turbidity, {sky.look_rayleigh, sky.look_mie, sky.look_mie_g}};
}

void SkyPasses::set_model(gl::Program& program, const ModelParameters& parameters) {
    program.set("turbidity", float(parameters.turbidity));
    program.set("look", glm::vec3(parameters.look));
}

void SkyPasses::make_irradiance(const PassAccess& access, const ModelParameters& parameters, bool multiple) {
    SkyTable& table = access.write(irradiance);
    make_table(table.texture, "sky on the ground", irradiance_size);
    gl::Defines defines;
    define_model(defines, parameters.model);
    gl::Program& program = shaders_.get("sky/sky_irradiance.comp", defines);
    bind_tables(access, program, multiple, false);
    set_model(program, parameters);
    program.use();
    bind_image(0, table.texture);
    dispatch_over({irradiance_size.x, 1}, {64, 1});
}

void SkyPasses::make_view(const PassAccess& access, const ViewParameters& parameters, bool multiple) {
    SkyViewTables& tables = access.write(view);
    make_table(tables.clear, "sky view", view_size);
    make_table(tables.haze, "sky view of haze", view_size);
    gl::Program& program = shaders_.get("sky/sky_view.comp");
    bind_tables(access, program, multiple, true);
    program.set("altitude", float(parameters.altitude_m));
    program.set("sun_climb", float(parameters.sun_climb));
    program.use();
    bind_image(0, tables.clear);
    bind_image(1, tables.haze);
    dispatch_over(view_size, {8, 8});
    access.note(fmt::format("from {:.5g} m", parameters.altitude_m));
}

void SkyPasses::make_light(const PassAccess& access, const scene::Sun& sun, bool multiple) {
    SkyLight& out = access.write(light);
    if (!out.buffer) {
        out.buffer = gl::Buffer("light from the sky", 4 * sizeof(glm::vec4));
    }
    const scene::Light lamp = scene::sun_lamp(sun, access.read(atmosphere_));
    gl::Program& program = shaders_.get("sky/sky_light.comp");
    bind_tables(access, program, multiple, true);
    program.set("to_sun", glm::vec3(lamp.direction_world));
    program.set("irradiance", glm::vec3(sun.irradiance));
    program.set("irradiance_behind_air", glm::vec3(lamp.color * lamp.intensity));
    program.use();
    out.buffer.bind_storage(sky_light_binding);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void SkyPasses::draw(const PassAccess& access, const PictureParameters& parameters, bool marched) {
    SkyPicture& out = access.write(picture);
    const bool has_surfaces = parameters.opaque.index >= 0;
    const SurfaceLayers* const surfaces = has_surfaces ? &access.read(parameters.opaque).layers : nullptr;
    make_targets(out, parameters.pixels, has_surfaces ? surfaces->count : 1);
    gl::Defines defines;
    define_model(defines, parameters.sky.model);
    if (marched) {
        defines["MARCH"] = "";
    }
    if (has_surfaces) {
        defines["OPAQUE"] = "";
    }
    gl::Program& program = shaders_.get("sky/sky.frag", defines);
    GLuint unit = bind_tables(access, program, parameters.sky.multiple_scattering, true);
    const gl::Texture none;
    (marched ? none : access.read(view).clear).bind(unit);
    program.set("clear_table", int(unit++));
    (marched ? none : access.read(view).haze).bind(unit);
    program.set("haze_table", int(unit++));
    const GLuint surface_unit = unit;
    if (has_surfaces) {
        program.set("distance_scale", glm::vec2(surfaces->unit_world, parameters.skipped_distance));
    }
    const scene::Camera& camera = access.read(camera_);
    const scene::CameraFrame frame = scene::camera_frame(camera);
    const bool orthographic = camera.projection == scene::Projection::orthographic;
    const glm::dvec2 half = half_view(camera, parameters.pixels, 1.0);
    program.set("pixels", glm::vec2(parameters.pixels));
    program.set("orthographic", orthographic ? 1 : 0);
    program.set("half_view", glm::vec2(half));
    program.set("world_from_camera", glm::mat3(glm::dmat3(frame.right_world, frame.up_world, frame.back_world)));
    program.set("altitude", float(eye_altitude_m(camera)));
    program.set("to_sun", glm::vec3(scene::to_sun_world(parameters.sun)));
    program.set("irradiance", glm::vec3(parameters.sun.irradiance));
    program.set("sun_radius", float(glm::radians(parameters.sun.angular_radius_deg)));
    program.set("limb_darkening", parameters.sun.limb_darkening ? 1 : 0);
    program.set("pixel_angle", orthographic ? 0.0F : float(2.0 * std::atan(half.y / parameters.pixels.y)));
    set_model(program, model_parameters(parameters.sky));
    program.set("model_share", float(scene::ground_sky_share(eye_altitude_m(camera))));
    for (std::size_t layer = 0; layer < out.layers.size(); ++layer) {
        if (has_surfaces) {
            surfaces->bind(program, int(layer), surface_unit);
        }
        out.layers[layer].framebuffer.bind();
        full_screen_.draw(program);
    }
    access.note(fmt::format("{} x {} pixels{}", parameters.pixels.x, parameters.pixels.y,
                            marched ? ", marched along each ray" : ""));
}

}  // namespace bruma::render

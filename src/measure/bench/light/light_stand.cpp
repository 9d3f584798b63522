#include "measure/bench/light/light_stand.h"

#include <charconv>

namespace bruma::measure {
namespace {

/// The number that stands before `word` in a pass's own words; 0 without.
int number_before(const std::string& note, const std::string& word) {
    const std::size_t end = note.find(" " + word);
    if (end == std::string::npos) {
        return 0;
    }
    const std::size_t space = note.find_last_of(' ', end - 1);
    const std::size_t begin = space == std::string::npos ? 0 : space + 1;
    int number = 0;
    std::from_chars(note.data() + begin, note.data() + end, number);
    return number;
}

bool builds_light(const std::string& pass) {
    return pass.find(": light of ") != std::string::npos || pass.find(": diffuse light of ") != std::string::npos ||
           pass.find(": shadow rays of ") != std::string::npos;
}

int coarsening_of(scene::LightResolution resolution) {
    return 1 << int(resolution);
}

double count_of(glm::ivec3 cells) {
    return double(cells.x) * cells.y * cells.z;
}

}  // namespace

LightStand::LightStand(gl::ShaderLibrary& shaders, scene::Scene scene)
    : renderer_(shaders),
      scene_(std::move(scene)),
      volume_name_(scene::shown_volumes(scene_).front()),
      light_(*scene_.lights.begin()->second) {}

scene::Volume& LightStand::volume() {
    return std::get<scene::Volume>(scene_.nodes.at(volume_name_).content);
}

const scene::Volume& LightStand::volume() const {
    return std::get<scene::Volume>(scene_.nodes.at(volume_name_).content);
}

void LightStand::set(LightProvider provider, const scene::LightVolumeSettings& settings) {
    provider_ = provider;
    scene::LightVolumeSettings chosen = settings;
    chosen.mode = provider == LightProvider::paper ? scene::SweepMode::paper : scene::SweepMode::physical;
    chosen.diffuse = provider == LightProvider::diffuse;
    volume().light_volume = chosen;
    volume().optics.edit([provider](scene::VolumeOptics& optics) {
        optics.lighting = provider == LightProvider::shadow_rays ? scene::VolumeLighting::shadow_rays
                                                                 : scene::VolumeLighting::light_volume;
    });
}

void LightStand::set_unlit() {
    volume().optics.edit([](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::none; });
}

void LightStand::multiply_density(double factor) {
    volume().optics.edit([factor](scene::VolumeOptics& optics) { optics.density_scale *= factor; });
}

Image LightStand::picture(glm::ivec2 pixels) {
    moved_ = false;
    scene_.lights.begin()->second = light_;
    first_times_ = timed(pixels);
    return renderer_.read_picture();
}

LightTimes LightStand::timed(glm::ivec2 pixels) {
    LightTimes times;
    for (const render::PassReport& pass : renderer_.render(scene_, {pixels, 1.0}, true)) {
        if (pass.ran && builds_light(pass.name)) {
            times.build_ms += pass.gpu_ms;
            times.dispatches += std::max(1, number_before(pass.note, "dispatches"));
        }
        times.draw_ms += pass.ran && pass.name == "march" ? pass.gpu_ms : 0.0;
    }
    return times;
}

LightTimes LightStand::after_light_change(glm::ivec2 pixels) {
    moved_ = !moved_;
    scene::Light light = light_;
    const double share = moved_ ? 0.01 : 0.0;
    light.direction_world += share * glm::dvec3(light_.direction_world.y, -light_.direction_world.x, 0.0);
    light.position_world *= 1.0 + share;
    scene_.lights.begin()->second = light;
    return timed(pixels);
}

double LightStand::draw_ms(glm::ivec2 pixels) {
    // The same background, but newer: the picture is stale and nothing else is.
    scene_.background = Tracked<scene::Background>(scene::Background(*scene_.background));
    return timed(pixels).draw_ms;
}

glm::ivec3 LightStand::grid_cells(int coarsening) const {
    return render::light_grid(volume(), scene::world_from_texture(scene_, volume_name_), coarsening).cells;
}

std::int64_t LightStand::cells() const {
    return std::int64_t(count_of(grid_cells(coarsening_of(volume().light_volume->resolution))));
}

double LightStand::megabytes() const {
    const scene::LightVolumeSettings& settings = *volume().light_volume;
    const int coarsening = coarsening_of(settings.resolution);
    const double number = settings.precision == scene::LightPrecision::half ? 2.0 : 4.0;
    constexpr double extinction = 4.0, albedo = 8.0;  // bytes of a cell: R32F, RGBA16F
    const double fine = count_of(grid_cells(coarsening));
    double bytes = fine * number;
    switch (provider_) {
        case LightProvider::direct:
            bytes += fine * extinction;
            break;
        case LightProvider::diffuse:
            bytes += fine * extinction + count_of(grid_cells(2 * coarsening)) * (4.0 * number + extinction + albedo);
            break;
        case LightProvider::paper:
            bytes += fine * (4.0 * number + extinction + albedo);
            break;
        case LightProvider::shadow_rays:
            break;
    }
    return bytes * 1e-6;
}

}  // namespace bruma::measure

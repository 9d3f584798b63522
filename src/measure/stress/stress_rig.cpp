#include "measure/stress/stress_rig.h"

#include <fmt/core.h>

#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>

#include "base/installation.h"
#include "reference/volume/emission_absorption.h"

namespace bruma::measure {
namespace {

/// What is wrong with a picture by itself; empty if nothing is.
std::string unsound(const Image& image) {
    std::size_t broken = 0, outside = 0;
    double worst_alpha = 0.0;
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        const float* p = &image.rgba[4 * n];
        if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]) || !std::isfinite(p[3])) {
            ++broken;
        } else if (p[3] < 0.0F || p[3] > 1.0F) {
            ++outside;
            worst_alpha = std::max(worst_alpha, std::max(-double(p[3]), p[3] - 1.0));
        }
    }
    if (broken > 0) {
        return fmt::format("{} of {} pixels are not finite", broken, image.pixel_count());
    }
    return outside > 0 ? fmt::format("opacity of {} pixels leaves [0, 1] by up to {:.2g}", outside, worst_alpha) : "";
}

std::size_t differing_pixels(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < a.pixel_count(); ++n) {
        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the same bits are meant, not the same values.
        count += std::memcmp(&a.rgba[4 * n], &b.rgba[4 * n], 4 * sizeof(float)) != 0 ? 1 : 0;
    }
    return count;
}

double largest_radiance(const Image& image) {
    double largest = 1.0;
    for (const float channel : image.rgba) {
        largest = std::max(largest, double(channel));
    }
    return largest;
}

}  // namespace

double largest_difference(const Image& a, const Image& b) {
    double largest = 0.0;
    for (std::size_t n = 0; n < a.rgba.size(); ++n) {
        largest = std::max(largest, std::abs(double(a.rgba[n]) - double(b.rgba[n])));
    }
    return largest;
}

StressRig::StressRig(const StressOptions& options)
    : options_(options), shaders_(installed_folder("shaders")), renderer_(shaders_) {}

bool StressRig::is_wanted(const std::string& name) const {
    return options_.only.empty() || (group_ + "/" + name).find(options_.only) != std::string::npos;
}

void StressRig::fall(StressVerdict verdict) {
    if (options_.say) {
        options_.say(verdict);
    }
    verdicts_.push_back(std::move(verdict));
}

Image StressRig::draw(const scene::Scene& scene, glm::ivec2 pixels) {
    renderer_.render(scene, {pixels, 1.0});
    Image image = renderer_.read_picture();
    if (const std::string fault = unsound(image); !fault.empty()) {
        throw std::runtime_error(fault);
    }
    return image;
}

void StressRig::picture(const std::string& name, const std::string& what, const scene::Scene& scene,
                        std::optional<double> bound) {
    if (!is_wanted(name)) {
        return;
    }
    StressVerdict verdict{group_, name, what, true, bound.has_value(), 0.0, bound.value_or(0.0), ""};
    try {
        scene::check(scene);
        scene::Scene other = scene;
        other.rendering.edit([](scene::RenderSettings& s) { s.empty_space_skipping = true; });
        const Image leapt = draw(other);
        other.rendering.edit([](scene::RenderSettings& s) { s.empty_space_skipping = false; });
        const Image walked = draw(other);
        if (const std::size_t pixels = differing_pixels(leapt, walked); pixels > 0) {
            verdict.fault =
                fmt::format("skipping changes {} pixels, by up to {:.2g}", pixels, largest_difference(leapt, walked));
        }
        if (bound) {
            const Image truth =
                reference::render_emission_absorption(scene, leapt.width, leapt.height, {.tolerance = 1e-6}).image;
            verdict.number = largest_difference(leapt, truth) / largest_radiance(truth);
            if (verdict.fault.empty() && !(verdict.number <= *bound)) {
                verdict.fault = "further from the reference than the bound";
            }
        }
    } catch (const std::exception& fault) {
        verdict.fault = fault.what();
    }
    verdict.ok = verdict.fault.empty();
    fall(std::move(verdict));
}

void StressRig::number(const std::string& name, const std::string& what, double bound,
                       const std::function<double()>& measure) {
    if (!is_wanted(name)) {
        return;
    }
    StressVerdict verdict{group_, name, what, true, true, 0.0, bound, ""};
    try {
        verdict.number = measure();
        if (!(verdict.number <= bound)) {
            verdict.fault = "above the bound";
        }
    } catch (const std::exception& fault) {
        verdict.fault = fault.what();
    }
    verdict.ok = verdict.fault.empty();
    fall(std::move(verdict));
}

std::vector<StressVerdict> run_volume_stress(const StressOptions& options) {
    StressRig rig(options);
    stress_values(rig);
    stress_curves(rig);
    stress_cameras(rig);
    stress_placement(rig);
    stress_march(rig);
    stress_lights(rig);
    stress_random(rig, options.random_scenes);
    return rig.verdicts();
}

std::string line_of(const StressVerdict& v) {
    std::string line = fmt::format("{:4} {:34} {}", v.ok ? "ok" : "FAIL", v.group + "/" + v.name, v.what);
    if (v.has_number) {
        line += fmt::format(": {:.2g} (at most {:.2g})", v.number, v.bound);
    }
    return v.ok ? line : line + "; " + v.fault;
}

std::string summary_of(const std::vector<StressVerdict>& verdicts) {
    struct Group {
        int cases = 0, failed = 0;
        const StressVerdict* worst = nullptr;
    };
    std::vector<std::string> order;
    std::map<std::string, Group> groups;
    int failed = 0;
    for (const StressVerdict& v : verdicts) {
        if (!groups.contains(v.group)) {
            order.push_back(v.group);
        }
        Group& group = groups[v.group];
        ++group.cases;
        group.failed += v.ok ? 0 : 1;
        failed += v.ok ? 0 : 1;
        if (v.has_number && (!group.worst || v.number > group.worst->number)) {
            group.worst = &v;
        }
    }
    std::string text;
    for (const std::string& name : order) {
        const Group& group = groups[name];
        text += fmt::format("{:12} {:4} cases, {} failed", name, group.cases, group.failed);
        text +=
            group.worst ? fmt::format("; worst number {:.2g} ({})\n", group.worst->number, group.worst->name) : "\n";
    }
    return text + fmt::format("{} cases, {} failed\n", verdicts.size(), failed);
}

}  // namespace bruma::measure

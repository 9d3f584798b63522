#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "app/exposure.h"
#include "app/scene_arguments.h"
#include "app/verbs/verbs.h"
#include "base/console.h"
#include "base/error.h"
#include "base/log.h"
#include "io/picture/picture_file.h"
#include "measure/metrics/flip.h"
#include "measure/metrics/heatmap.h"
#include "measure/metrics/image_error.h"
#include "scene/tone_map.h"

namespace bruma::app {
namespace {

struct CompareArguments {
    std::string picture, reference;
    std::string heatmap;
    double full_scale = 0.1;
    std::optional<double> tolerance;  ///< without: any difference will do
    bool force = false;
    std::optional<double> exposure_ev;
    std::string tone_map;

    bool is_shown() const { return exposure_ev || !tone_map.empty(); }
};

/// CLI11's own ranges let pass what is no number.
CLI::Validator a_number_from(double low, double high) {
    return {[low, high](const std::string& word) {
                double value = 0.0;
                const bool is_number = CLI::detail::lexical_cast(word, value);
                return is_number && value >= low && value <= high
                           ? std::string()
                           : fmt::format("{} is no number from {:g} to {:g}", word, low, high);
            },
            fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

bool holds_radiance(const std::string& name) {
    return name.ends_with(".exr") || name.ends_with(".hdr");
}

/// Refuses to expose what was displayed already.
scene::Display display_of(const CompareArguments& arguments) {
    for (const std::string& name : {arguments.picture, arguments.reference}) {
        if (arguments.is_shown() && !holds_radiance(name)) {
            throw InputError(
                fmt::format("{}: holds what a display showed, which --exposure and --tone-map would change once more; "
                            "leave them out",
                            name));
        }
    }
    scene::Display display{.exposure_ev = arguments.exposure_ev.value_or(0.0)};
    const auto words = scene::enum_words<scene::ToneMap>();
    if (!arguments.tone_map.empty()) {
        display.tone_map = scene::ToneMap(std::find(words.begin(), words.end(), arguments.tone_map) - words.begin());
    }
    return display;
}

/// Where radiance is far from what a display shows, FLIP sees black or white.
void suggest_exposure(const CompareArguments& arguments, const Image& truth) {
    if (arguments.is_shown() || !holds_radiance(arguments.reference)) {
        return;
    }
    const std::optional<SuitableExposure> suitable = suitable_exposure(truth, {});
    if (suitable && std::abs(suitable->ev) > 1.0) {
        log_note("FLIP sees these pictures as a display without exposure; --exposure {:.2f} shows them better",
                 suitable->ev);
    }
}

int compare(const CompareArguments& arguments) {
    if (arguments.heatmap == "-") {
        throw InputError("--heatmap -: standard output carries the numbers; name a file");
    }
    if (!arguments.heatmap.empty()) {
        guard_against({arguments.picture, arguments.reference}, arguments.force)
            .add("--heatmap", arguments.heatmap, io::picture_content(arguments.heatmap));
    }
    const scene::Display shown_by = display_of(arguments);
    const Image picture = io::read_picture(arguments.picture);
    const Image truth = io::read_picture(arguments.reference);
    measure::ImageError error = measure::compare_images(picture, truth);
    suggest_exposure(arguments, truth);
    if (arguments.is_shown() && error.non_finite == 0) {
        error.mean_flip =
            measure::mean_flip(scene::shown_image(picture, shown_by), scene::shown_image(truth, shown_by));
    }
    answer("RMSE {:.3e}\nrelative MSE {:.3e}\nlargest {:.3e} at ({}, {})\nPSNR {:.2f} dB\nFLIP {:.4f}\n", error.rmse,
           error.relative_mse, error.largest, error.worst_pixel.x, error.worst_pixel.y, error.psnr_db, error.mean_flip);
    if (error.non_finite > 0) {
        answer("{} pixels are not finite\n", error.non_finite);
    }
    if (!arguments.heatmap.empty()) {
        const io::PictureFormat format = io::picture_format(arguments.heatmap);
        const Image map = measure::error_heatmap(picture, truth, arguments.full_scale);
        io::Picture8 display{map.width, map.height, {}};
        if (format == io::PictureFormat::png) {
            for (const float value : map.rgba) {
                display.rgba.push_back(std::uint8_t(std::lround(255.0F * std::min(1.0F, std::max(0.0F, value)))));
            }
        }
        io::write_picture(arguments.heatmap, map, display);
    }
    const bool within = error.non_finite == 0 && (!arguments.tolerance || error.rmse <= *arguments.tolerance);
    if (!within) {
        answer("{}", measure::character_picture(picture, truth, 72));
        if (arguments.tolerance && !(error.rmse <= *arguments.tolerance)) {
            answer("RMSE is above the tolerance of {:.3e}\n", *arguments.tolerance);
        }
    }
    return int(within ? ExitCode::done : ExitCode::answer_is_no);
}

}  // namespace

Verb declare_compare(CLI::App& app) {
    auto arguments = std::make_shared<CompareArguments>();
    app.add_option("picture", arguments->picture, "the picture in question")->required();
    app.add_option("reference", arguments->reference, "what it should be")->required();
    app.add_option("--tolerance", arguments->tolerance, "exit 1 if the RMSE (linear, display range 1) is above this")
        ->check(a_number_from(0.0, 1e30));
    const auto words = scene::enum_words<scene::ToneMap>();
    app.add_option("--exposure", arguments->exposure_ev, "of radiance for FLIP, EV: what a display would show")
        ->check(CLI::Range(-32.0, 32.0));
    app.add_option("--tone-map", arguments->tone_map, "of radiance for FLIP, see display.tone_map")
        ->check(CLI::IsMember(std::vector<std::string>(words.begin(), words.end())));
    app.add_option("--heatmap", arguments->heatmap, "picture of where they differ");
    app.add_option("--full-scale", arguments->full_scale, "difference shown in the brightest colour")
        ->check(a_number_from(1e-9, 1e9));
    declare_force(app, arguments->force);
    refuse_empty_words(app, {"--heatmap"});
    return [arguments, &app] {
        if (arguments->heatmap.empty()) {
            refuse_if_given(app, {"--full-scale", "--force"}, "is about --heatmap; add that or leave it out");
        }
        return compare(*arguments);
    };
}

}  // namespace bruma::app

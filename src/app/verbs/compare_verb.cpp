#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "app/verbs/verbs.h"
#include "base/error.h"
#include "io/atomic_file.h"
#include "io/picture_file.h"
#include "measure/heatmap.h"
#include "measure/image_error.h"

namespace bruma::app {
namespace {

struct CompareArguments {
    std::string picture, reference;
    std::string heatmap;
    double full_scale = 0.1;
    double tolerance = -1.0;
};

int compare(const CompareArguments& arguments) {
    if (!arguments.heatmap.empty()) {
        io::picture_format(arguments.heatmap);
        io::require_writable(arguments.heatmap);
    }
    const Image picture = io::read_picture(arguments.picture);
    const Image truth = io::read_picture(arguments.reference);
    const measure::ImageError error = measure::compare_images(picture, truth);
    fmt::print("RMSE {:.3e}\nrelative MSE {:.3e}\nlargest {:.3e} at ({}, {})\nPSNR {:.2f} dB\nFLIP {:.4f}\n",
               error.rmse, error.relative_mse, error.largest, error.worst_pixel.x, error.worst_pixel.y, error.psnr_db,
               error.mean_flip);
    if (error.non_finite > 0) {
        fmt::print("{} pixels are not finite\n", error.non_finite);
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
    const bool within = error.non_finite == 0 && (arguments.tolerance < 0.0 || error.rmse <= arguments.tolerance);
    if (!within) {
        fmt::print("{}", measure::character_picture(picture, truth, 72));
        fmt::print("RMSE is above the tolerance of {:.3e}\n", arguments.tolerance);
    }
    return int(within ? ExitCode::done : ExitCode::answer_is_no);
}

}  // namespace

Verb declare_compare(CLI::App& app) {
    auto arguments = std::make_shared<CompareArguments>();
    app.add_option("picture", arguments->picture, "the picture in question")->required();
    app.add_option("reference", arguments->reference, "what it should be")->required();
    app.add_option("--tolerance", arguments->tolerance, "exit 1 if the RMSE (linear, display range 1) is above this");
    app.add_option("--heatmap", arguments->heatmap, "picture of where they differ");
    app.add_option("--full-scale", arguments->full_scale, "difference shown in the brightest colour")
        ->check(CLI::Range(1e-9, 1e9));
    return [arguments] { return compare(*arguments); };
}

}  // namespace bruma::app

#include "measure/bench/volume/bench_findings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace bruma::measure {
namespace {

using scene::Classification;
using Get = std::function<double(const VolumeBenchRow&)>;

double error_of(const VolumeBenchRow& row) {
    return row.error.rmse;
}

const VolumeBenchRow* at_step(const std::vector<VolumeBenchRow>& rows, double step) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [step](const VolumeBenchRow& row) { return row.settings.step == step; });
    return found == rows.end() ? nullptr : &*found;
}

/// `y` where the error is `error`, on the segment between neighbours that holds it; the coarsest such, if several.
std::optional<double> where_error_is(const std::vector<VolumeBenchRow>& rows, double error, const Get& y) {
    for (std::size_t n = rows.size(); n-- > 1;) {
        const double a = error_of(rows[n - 1]);
        const double b = error_of(rows[n]);
        if (std::min(a, b) > 0.0 && std::min(a, b) <= error && error <= std::max(a, b)) {
            const double f = a == b ? 0.0 : std::log(error / a) / std::log(b / a);
            return std::exp((1.0 - f) * std::log(y(rows[n - 1])) + f * std::log(y(rows[n])));
        }
    }
    return std::nullopt;
}

/// Compares what both classifications cost for the error that pre-integration has at one voxel.
std::string compare_cost(const VolumeBenchScene& scene, const Get& cost, const std::string& unit) {
    const auto post = rows_by_step(scene, Classification::post, true, default_stop);
    const auto pre = rows_by_step(scene, Classification::preintegrated, true, default_stop);
    const VolumeBenchRow* usual = at_step(pre, 1.0);
    if (!usual || post.empty()) {
        return "too few steps were measured to compare the classifications";
    }
    const double error = error_of(*usual);
    const auto step = where_error_is(post, error, [](const VolumeBenchRow& row) { return row.settings.step; });
    if (step) {
        const double factor = *where_error_is(post, error, cost) / cost(*usual);
        return fmt::format(
            "post-classification needs a step of {:.2g} voxel and {:.2g} x the {} for the error that "
            "pre-integration has at one voxel ({:.2g})",
            *step, factor, unit, error);
    }
    const VolumeBenchRow& finest = post.front();
    if (error_of(finest) > error) {
        return fmt::format(
            "even at a step of {:g} voxel and {:.2g} x the {}, post-classification has {:.2g} x the error "
            "that pre-integration has at one voxel ({:.2g})",
            finest.settings.step, cost(finest) / cost(*usual), unit, error_of(finest) / error, error);
    }
    const VolumeBenchRow& coarsest = post.back();
    return fmt::format(
        "post-classification is below the error that pre-integration has at one voxel ({:.2g}) already "
        "at a step of {:g} voxel, for {:.2g} x the {}",
        error, coarsest.settings.step, cost(coarsest) / cost(*usual), unit);
}

}  // namespace

std::vector<VolumeBenchRow> rows_by_step(const VolumeBenchScene& scene, Classification classification, bool skip,
                                         double stop) {
    std::vector<VolumeBenchRow> rows;
    for (const VolumeBenchRow& row : scene.rows) {
        const double row_stop = row.settings.early_termination ? row.settings.stop_transmittance : 0.0;
        if (row.settings.classification == classification && row.settings.empty_space_skipping == skip &&
            row_stop == stop) {
            rows.push_back(row);
        }
    }
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.settings.step < b.settings.step; });
    return rows;
}

Fit fit_order(const std::vector<VolumeBenchRow>& rows, double floor) {
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (const VolumeBenchRow& row : rows) {
        if (error_of(row) > floor && std::isfinite(error_of(row))) {
            const double x = std::log(row.settings.step);
            const double y = std::log(error_of(row));
            n += 1.0;
            sx += x;
            sy += y;
            sxx += x * x;
            sxy += x * y;
        }
    }
    Fit fit;
    fit.points = int(n);
    const double spread = n * sxx - sx * sx;
    if (n >= 2.0 && spread > 0.0) {
        fit.order = (n * sxy - sx * sy) / spread;
        fit.factor = std::exp((sy - fit.order * sx) / n);
    }
    return fit;
}

std::string finding_time(const VolumeBenchScene& scene) {
    return compare_cost(
        scene, [](const VolumeBenchRow& row) { return row.time_over_yardstick; }, "time");
}

std::string finding_samples(const VolumeBenchScene& scene) {
    return compare_cost(
        scene, [](const VolumeBenchRow& row) { return row.samples_per_pixel; }, "samples");
}

std::string finding_order(const VolumeBenchScene& scene) {
    const Fit post = fit_order(rows_by_step(scene, Classification::post, true, 0.0));
    const Fit pre = fit_order(rows_by_step(scene, Classification::preintegrated, true, 0.0));
    if (post.points < 2 || pre.points < 2) {
        return "too few errors lie above 1e-5 for an order of convergence";
    }
    return fmt::format(
        "halving the step divides the error of post-classification by {:.2g} (order {:.2f}) and that of "
        "pre-integration by {:.2g} (order {:.2f})",
        std::exp2(post.order), post.order, std::exp2(pre.order), pre.order);
}

std::string finding_savings(const VolumeBenchScene& scene) {
    const auto both = rows_by_step(scene, Classification::preintegrated, true, default_stop);
    const auto skipping = rows_by_step(scene, Classification::preintegrated, true, 0.0);
    const auto stopping = rows_by_step(scene, Classification::preintegrated, false, default_stop);
    const VolumeBenchRow* all = at_step(both, 1.0);
    const VolumeBenchRow* skip = at_step(skipping, 1.0);
    const VolumeBenchRow* stop = at_step(stopping, 1.0);
    if (!all || !skip || !stop) {
        return "too few settings were measured";
    }
    return fmt::format(
        "at one voxel and pre-integrated, skipping and termination together take {:.0f} % of the "
        "brute-force time (skipping alone {:.0f} %, termination alone {:.0f} %) and {:.0f} % of its "
        "samples",
        100.0 * all->time_over_brute, 100.0 * skip->time_over_brute, 100.0 * stop->time_over_brute,
        100.0 * (1.0 - all->skipped_share));
}

}  // namespace bruma::measure

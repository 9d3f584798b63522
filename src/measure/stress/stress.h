#pragma once
#include <functional>
#include <string>
#include <vector>

/// Numerical stability: inputs that a viewer will meet one day and that break careless arithmetic.
namespace bruma::measure {

struct StressVerdict {
    std::string group, name;
    std::string what;  ///< what was done, in a few words
    bool ok = true;
    bool has_number = false;
    double number = 0.0;  ///< the worst seen: an error unless `what` says otherwise
    double bound = 0.0;   ///< that it must not exceed
    std::string fault;    ///< empty when ok
};

struct StressOptions {
    std::string only;  ///< groups or names that contain this; empty: all
    int random_scenes = 300;
    int pieces = 2000;                                   ///< of the mesh that falls into many
    std::function<void(const StressVerdict&)> say = {};  ///< told each verdict as it falls
};

/// All cases of the suite 'volume', in order. Needs a current context.
std::vector<StressVerdict> run_volume_stress(const StressOptions& options);
/// All cases of the suite 'light': light that scatters in volumes.
std::vector<StressVerdict> run_light_stress(const StressOptions& options);
/// All cases of the suite 'clouds'.
std::vector<StressVerdict> run_cloud_stress(const StressOptions& options);
/// All cases of the suite 'mesh': surfaces, and light inside translucent ones.
std::vector<StressVerdict> run_mesh_stress(const StressOptions& options);

/// 'ok   values/noise  0 and 255 at random: 1.2e-3 (at most 4e-3)'.
std::string line_of(const StressVerdict& verdict);
/// How many cases of each group, how many failed, and the worst number seen in each.
std::string summary_of(const std::vector<StressVerdict>& verdicts);

}  // namespace bruma::measure

#include "app/viewer/background_loader.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <new>

#include "app/scene_arguments.h"
#include "base/error.h"
#include "io/mesh/mesh_source.h"
#include "io/open.h"
#include "io/volume/grid_source.h"
#include "io/volume/raw_layout.h"
#include "scene/builtin/builtin.h"

namespace bruma::app {
namespace {

struct Cancelled {};

std::string lower_ending(const std::string& file) {
    std::string ending = std::filesystem::path(file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

template <class Map>
std::vector<std::string> names_beyond(const Map& all, const Map& before) {
    std::vector<std::string> names;
    for (const auto& [name, part] : all) {
        if (!before.contains(name)) {
            names.push_back(name);
        }
    }
    return names;
}

}  // namespace

void BackgroundLoader::start(std::string title, Job job, std::function<void()> wake) {
    cancelled_ = false;
    standing_ = {std::move(title), "", 0.0};
    result_.reset();
    thread_ = std::jthread([this, job = std::move(job), wake = std::move(wake)] {
        auto told = std::chrono::steady_clock::now();
        const io::Progress progress = [&](double share, std::string_view what) {
            if (cancelled_) {
                throw Cancelled();
            }
            {
                const std::scoped_lock lock(mutex_);
                standing_.share = share;
                standing_.what = what;
            }
            const auto now = std::chrono::steady_clock::now();
            if (now - told > std::chrono::milliseconds(60)) {
                told = now;
                wake();
            }
        };
        Result result;
        try {
            result = job(progress);
        } catch (const Cancelled&) {
            result.cancelled = true;
        } catch (const std::bad_alloc&) {
            result.fault = "not enough memory for this; close other programs or use smaller data";
        } catch (const std::exception& fault) {
            result.fault = fault.what();
        }
        {
            const std::scoped_lock lock(mutex_);
            result_ = std::move(result);
        }
        wake();
    });
}

std::optional<BackgroundLoader::Result> BackgroundLoader::take() {
    std::optional<Result> result;
    {
        const std::scoped_lock lock(mutex_);
        result.swap(result_);
    }
    if (result) {
        thread_.join();
    }
    return result;
}

BackgroundLoader::Standing BackgroundLoader::standing() const {
    const std::scoped_lock lock(mutex_);
    return standing_;
}

bool is_whole_scene(const std::string& file) {
    if (io::is_builtin(file)) {
        const std::vector<std::string> names = scene::builtin_scene_names();
        return std::find(names.begin(), names.end(), io::builtin_name(file)) != names.end();
    }
    return lower_ending(file) == ".json";
}

BackgroundLoader::Job add_files_job(scene::Scene scene, std::vector<std::string> files, scene::VolumeSource hints,
                                    std::vector<std::string> settings) {
    std::stable_partition(files.begin(), files.end(), is_whole_scene);
    return [scene = std::move(scene), files = std::move(files), hints = std::move(hints),
            settings = std::move(settings)](const io::Progress& progress) mutable {
        BackgroundLoader::Result result;
        const std::vector<scene::VolumeSource> own_hints = io::hints_for_each(files, hints);
        scene::Scene before = scene;
        for (std::size_t n = 0; n < files.size(); ++n) {
            const auto part = [&](double share, std::string_view what) {
                progress((double(n) + share) / double(files.size()), what);
            };
            part(0.0, files[n]);
            if (std::filesystem::exists(files[n]) && io::is_raw_volume(files[n], own_hints[n]) &&
                !io::known_layout_parts(files[n], own_hints[n]).complete()) {
                const scene::VolumeSource known = io::known_layout_parts(files[n], own_hints[n]).as_hints();
                result.unknown.push_back({files[n], io::propose_layouts(files[n], known, 12)});
                continue;
            }
            if (is_whole_scene(files[n])) {
                if (result.replaces) {
                    throw InputError(
                        fmt::format("{}: only one whole scene can be opened at a time; open it alone", files[n]));
                }
                scene = {};
                result.replaces = true;
                result.scene_file = io::is_builtin(files[n]) ? "" : files[n];
            }
            io::add_file(scene, files[n], own_hints[n], part, preset_folders(), settings);
            before = is_whole_scene(files[n]) ? scene : before;
        }
        result.added_nodes = names_beyond(scene.nodes, before.nodes);
        result.added_lights = names_beyond(scene.lights, before.lights);
        result.scene = std::move(scene);
        return result;
    };
}

}  // namespace bruma::app

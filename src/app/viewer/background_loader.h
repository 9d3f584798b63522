#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "io/progress.h"
#include "io/volume/raw_proposals.h"
#include "scene/scene.h"

namespace bruma::app {

/// Reads files on a thread of its own, one job at a time, while the window stays alive.
class BackgroundLoader {
  public:
    struct UnknownLayout {
        std::string file;
        std::vector<io::RawProposal> proposals;
    };
    /// What a job leaves behind: a scene, or a sentence of why not.
    struct Result {
        std::optional<scene::Scene> scene;
        bool replaces = false;   ///< the scene stands for itself; otherwise what follows is to be added
        std::string scene_file;  ///< the .json that replaces; empty for a builtin one
        std::vector<std::string> added_nodes, added_lights;  ///< beyond the scene that was there or that replaces it
        std::string fault;
        std::vector<UnknownLayout> unknown;  ///< files left out until a person tells how they lie
        bool cancelled = false;
    };
    /// Makes a result; may throw Error, and whatever `progress` throws.
    using Job = std::function<Result(const io::Progress& progress)>;

    ~BackgroundLoader() { cancel(); }

    /// Starts a job; there must be none. `wake` is called from the thread whenever there is something to show.
    void start(std::string title, Job job, std::function<void()> wake);
    bool busy() const { return thread_.joinable(); }
    void cancel() { cancelled_ = true; }
    /// The result, once, when the job is over.
    std::optional<Result> take();

    struct Standing {
        std::string title, what;
        double share = 0.0;
    };
    Standing standing() const;

  private:
    std::atomic<bool> cancelled_ = false;
    mutable std::mutex mutex_;  ///< guards what follows
    Standing standing_;
    std::optional<Result> result_;
    std::jthread thread_;  ///< last, so that it ends before the rest goes
};

/// A job that adds `files` to a copy of `scene`. A whole scene (.json or builtin), of which there may be one, replaces
/// it before the others are added, wherever it stands among them. Headerless volumes whose layout neither `hints` nor
/// the files tell are left for a person to decide. `settings` are those of io::add_file.
BackgroundLoader::Job add_files_job(scene::Scene scene, std::vector<std::string> files, scene::VolumeSource hints,
                                    std::vector<std::string> settings = {});

/// Whether a name means a whole scene rather than something to add to one.
bool is_whole_scene(const std::string& file);

}  // namespace bruma::app

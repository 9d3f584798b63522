#include "render/subsurface/radiosity_gather.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "render/subsurface/subsurface_entry.h"

namespace bruma::render {
namespace {

/// A job of its own, that no driver's watchdog takes for a hang; between them the time is looked at.
constexpr std::uint32_t texels_per_job = 1U << 15;

/// A texel of each, where the picture looks any up, tells the noise of all of them to a few parts in a hundred.
constexpr std::uint32_t most_noise_words = 1U << 15;

/// Work groups of 64.
std::uint32_t groups_of(std::uint32_t count) {
    return (count + 63) / 64;
}

double ms_since(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - then).count();
}

/// Layout of radiosity_choice.comp.
struct Choice {
    std::uint32_t read = 0;     ///< texels that are looked up
    std::uint32_t least = ~0U;  ///< passes that any of them has had
    std::uint32_t chosen = 0;   ///< those among them that have had as many as was said
};

void set_texels(gl::Program& program, const RadiosityMaps& maps, const RadiosityInput& input) {
    const ExitMaps& exits = input.exits;
    program.set("edge", unsigned(exits.depth.size().x));
    program.set("row_words", exits.row_words());
    program.set("word_count", exits.words());
    program.set("all_are_read", input.reads == nullptr ? 1 : 0);
    (input.reads != nullptr ? *input.reads : exits.see_body).bind_storage(2);
    exits.see_body.bind_storage(5);
    maps.passes_of.bind_storage(6);
    maps.chosen.bind_storage(7);
}

/// Lists the texels that are read and have had `passes` passes.
Choice choose(RadiosityMaps& maps, gl::ShaderLibrary& shaders, const RadiosityInput& input, int passes) {
    gl::Program& program = shaders.get("subsurface/radiosity_choice.comp");
    set_texels(program, maps, input);
    program.set("wanted_passes", unsigned(passes));
    std::array<Choice, 1> choice;
    maps.totals.fill(std::span<const Choice>(choice));
    maps.totals.bind_storage(3);
    program.use();
    glDispatchCompute(groups_of(input.exits.words()), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    maps.totals.read(std::span<Choice>(choice));
    return choice.front();
}

/// Of what a picture shows that looks up what is read: from texels spread over the maps, always the same ones.
double measure_noise(const RadiosityMaps& maps, gl::ShaderLibrary& shaders, const RadiosityInput& input) {
    const std::uint32_t words = input.exits.words();
    const std::uint32_t stride = std::max(1U, (words + most_noise_words - 1) / most_noise_words);
    const std::uint32_t groups = groups_of((words + stride - 1) / stride);
    std::vector<glm::vec4> sums(groups);
    const gl::Buffer buffer("noise of radiosity", std::span<const glm::vec4>(sums));
    gl::Program& program = shaders.get("subsurface/radiosity_noise.comp");
    set_texels(program, maps, input);
    glBindImageTexture(0, maps.mean.name(), 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA32F);
    glBindImageTexture(1, maps.variance.name(), 0, GL_TRUE, 0, GL_READ_ONLY, GL_R32F);
    program.set("stride", stride);
    buffer.bind_storage(4);
    // The first turn tells how bright the body is on the whole, the second what is noise.
    double texels = 0.0, mean = 0.0, squares = 0.0;
    for (int turn = 0; turn < 2; ++turn) {
        program.set("least", float(0.05 * mean));
        program.use();
        glDispatchCompute(groups, 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        buffer.read(std::span<glm::vec4>(sums));
        texels = mean = squares = 0.0;
        for (const glm::vec4& sum : sums) {
            squares += double(sum.x);
            mean += double(sum.y);
            texels += double(sum.z);
        }
        mean /= std::max(1.0, texels);
    }
    return std::sqrt(squares / std::max(1.0, texels));
}

/// One pass over the chosen texels; whether there was time for all of them.
class Pass {
  public:
    Pass(gl::ShaderLibrary& shaders, const RadiosityMaps& maps, const RadiosityInput& input, const PathGoal& goal)
        : maps_(maps),
          input_(input),
          goal_(goal),
          program_(shaders.get("subsurface/radiosity.comp", entry_defines(input.light, input.settings))) {}

    bool run(std::uint32_t chosen, std::uint64_t& evaluations) {
        const int samples = int(input_.settings.samples);
        set(samples);
        for (std::uint32_t first = 0; first < chosen; first += texels_per_job) {
            const std::uint32_t past = std::min(chosen, first + texels_per_job);
            program_.set("first_chosen", first);
            program_.set("past_chosen", past);
            glDispatchCompute(groups_of(past - first), 1, 1);
            evaluations += std::uint64_t(past - first) * std::uint64_t(samples) * input_.light.lamps.size();
            if (goal_.budget_ms > 0.0) {
                glFinish();
                // The first light of all is worth any wait.
                if (maps_.passes > 0 && is_late() && past < chosen) {
                    return false;
                }
            } else {
                glFlush();
            }
        }
        return true;
    }
    bool is_late() const { return goal_.budget_ms > 0.0 && ms_since(began_) >= goal_.budget_ms; }

  private:
    void set(int samples) {
        set_entry(program_, input_.light, input_.constants, input_.powers, 2, lamps_);
        set_entry_points(program_, std::uint64_t(maps_.passes) * std::uint64_t(samples), samples);
        input_.exits.bind_cameras();
        input_.exits.depth.bind(0);
        program_.set("exit_depth", 0);
        input_.exits.normals.bind(1);
        program_.set("exit_normals", 1);
        glBindImageTexture(0, maps_.mean.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
        glBindImageTexture(1, maps_.variance.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32F);
        program_.set("edge", unsigned(input_.exits.depth.size().x));
        program_.set("passes_before", maps_.passes);
        maps_.passes_of.bind_storage(6);
        maps_.chosen.bind_storage(7);
        program_.use();
    }
    const RadiosityMaps& maps_;
    const RadiosityInput& input_;
    const PathGoal& goal_;
    gl::Program& program_;
    gl::Buffer lamps_;
    std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// Whether it is time to look: whenever there are a quarter more passes than before.
bool noise_is_due(const RadiosityMaps& maps) {
    return maps.passes >= std::max(2, maps.noise_passes) &&
           (maps.passes < 4 || maps.passes % std::max(1, maps.passes / 4) == 0);
}

}  // namespace

void begin_radiosity(RadiosityMaps& maps, const ExitMaps& exits, Revision start) {
    if (!maps.mean || maps.mean.size() != exits.depth.size()) {
        maps.mean = gl::Texture::make_2d_array("radiosity", GL_RGBA32F, exits.depth.size());
        maps.variance = gl::Texture::make_2d_array("variance of radiosity", GL_R32F, exits.depth.size());
    }
    const float nothing_there[4] = {0.0F, 0.0F, 0.0F, 1e30F};
    glClearTexImage(maps.mean.name(), 0, GL_RGBA, GL_FLOAT, nothing_there);
    const glm::ivec3 size = exits.depth.size();
    const std::size_t all = std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z) * sizeof(std::uint32_t);
    if (maps.passes_of.bytes() != all) {
        maps.passes_of = gl::Buffer("passes of texels", all);
    }
    const std::size_t seen = std::max<std::size_t>(1, exits.texel_count) * sizeof(std::uint32_t);
    if (maps.chosen.bytes() != seen) {
        maps.chosen = gl::Buffer("chosen texels", seen);
    }
    if (!maps.totals) {
        const std::array<Choice, 1> none;
        maps.totals = gl::Buffer("totals of texels", std::span<const Choice>(none));
    }
    const std::uint32_t zero = 0;
    glClearNamedBufferData(maps.passes_of.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    maps.passes = maps.noise_passes = 0;
    maps.read_texels = 0;
    maps.all_texels = exits.texel_count;
    maps.evaluations = 0;
    maps.noise = 1e30;
    maps.start = start;
}

std::string gather_radiosity(RadiosityMaps& maps, gl::ShaderLibrary& shaders, const RadiosityInput& input,
                             const PathGoal& goal) {
    const std::uint64_t evaluations_before = maps.evaluations;
    Pass pass(shaders, maps, input, goal);
    while (true) {
        Choice choice = choose(maps, shaders, input, maps.passes);
        maps.read_texels = choice.read;
        if (choice.read == 0) {
            maps.passes = std::max(maps.passes, goal.samples);  // nothing is missing
            break;
        }
        if (choice.least != std::uint32_t(maps.passes)) {
            // Another view: texels came in that have had fewer, or went.
            maps.passes = int(choice.least);
            choice = choose(maps, shaders, input, maps.passes);
        }
        if (maps.passes < maps.noise_passes) {
            maps.noise = 1e30;
        }
        if (maps.passes >= goal.samples || maps.noise <= input.settings.noise) {
            break;
        }
        if (!pass.run(choice.chosen, maps.evaluations)) {
            break;
        }
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
        ++maps.passes;
        if (noise_is_due(maps)) {
            maps.noise = measure_noise(maps, shaders, input);
            maps.noise_passes = maps.passes;
        }
        if (pass.is_late()) {
            break;
        }
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    if (maps.read_texels == 0) {
        return fmt::format("none of {} texels is read", maps.all_texels);
    }
    const std::size_t lamps = input.light.lamps.size();
    return fmt::format("{} passes of {} points from {} lamp{} over {} of {} texels, {:.3g} M evaluations, noise {}",
                       maps.passes, input.settings.samples, lamps, lamps == 1 ? "" : "s", maps.read_texels,
                       maps.all_texels, 1e-6 * double(maps.evaluations - evaluations_before),
                       maps.noise < 1e29 ? fmt::format("{:.2g} %", 100.0 * maps.noise) : "unknown");
}

}  // namespace bruma::render

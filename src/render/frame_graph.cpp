#include "render/frame_graph.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace bruma::render {
namespace {

bool contains(const std::vector<int>& list, int value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

void PassAccess::note(std::string words) const {
    graph_.passes_[std::size_t(pass_)].note = std::move(words);
}

int FrameGraph::add_resource(std::string name) {
    resources_.push_back({std::move(name), 0, -1, nullptr, nullptr});
    return int(resources_.size()) - 1;
}

PassId FrameGraph::add_pass(Pass pass) {
    const int index = int(passes_.size());
    for (const int written : pass.writes) {
        Resource& resource = resources_.at(std::size_t(written));
        if (resource.writer >= 0) {
            throw std::logic_error(fmt::format("'{}' is written by '{}' already, so '{}' cannot write it",
                                               resource.name, passes_[std::size_t(resource.writer)].pass.name,
                                               pass.name));
        }
        if (!resource.make) {
            throw std::logic_error(fmt::format("'{}' is a source; '{}' cannot write it", resource.name, pass.name));
        }
        resource.writer = index;
    }
    Node node;
    node.pass = std::move(pass);
    passes_.push_back(std::move(node));
    return {index};
}

void FrameGraph::set_reads(PassId pass, std::vector<int> reads) {
    passes_.at(std::size_t(pass.index)).pass.reads = std::move(reads);
}

void FrameGraph::remove_pass(PassId pass) {
    Node& node = passes_.at(std::size_t(pass.index));
    for (const int written : node.pass.writes) {
        resources_[std::size_t(written)] = Resource{};
    }
    node = Node{};
    node.alive = false;
}

std::vector<int> FrameGraph::order_of_needed(const std::vector<int>& wanted) const {
    enum class Mark { fresh, open, done };
    std::vector<Mark> marks(passes_.size(), Mark::fresh);
    std::vector<int> order;
    // Depth first: a pass comes after the writers of all that it reads.
    const std::function<void(int)> visit = [&](int resource) {
        const int writer = resources_.at(std::size_t(resource)).writer;
        if (writer < 0 || marks[std::size_t(writer)] == Mark::done) {
            return;
        }
        const Node& node = passes_[std::size_t(writer)];
        if (marks[std::size_t(writer)] == Mark::open) {
            throw std::logic_error(fmt::format("'{}' needs its own output", node.pass.name));
        }
        marks[std::size_t(writer)] = Mark::open;
        for (const int read : node.pass.reads) {
            visit(read);
        }
        marks[std::size_t(writer)] = Mark::done;
        order.push_back(writer);
    };
    for (const int resource : wanted) {
        visit(resource);
    }
    return order;
}

std::string FrameGraph::reason_to_run(const Node& node) const {
    if (!node.has_run) {
        return "first run";
    }
    for (const int written : node.pass.writes) {
        if (!resources_[std::size_t(written)].value) {
            return fmt::format("{} had been let go", resources_[std::size_t(written)].name);
        }
    }
    if (node.pass.reads != node.seen_reads) {
        return "it reads other things now";
    }
    std::string newer;
    for (std::size_t n = 0; n < node.pass.reads.size(); ++n) {
        const Resource& resource = resources_[std::size_t(node.pass.reads[n])];
        if (resource.revision != node.seen[n]) {
            newer += (newer.empty() ? "" : ", ") + resource.name;
        }
    }
    if (!newer.empty()) {
        return newer + (newer.find(',') == std::string::npos ? " is newer" : " are newer");
    }
    const bool changed = node.same_parameters && !node.same_parameters(node.last_parameters, node.parameters);
    return changed ? "its parameters changed" : "";
}

void FrameGraph::execute(int index, const std::string& reason, const Stopwatch& stopwatch) {
    Node& node = passes_[std::size_t(index)];
    for (const int written : node.pass.writes) {
        Resource& resource = resources_[std::size_t(written)];
        if (!resource.value) {
            resource.value = resource.make();
        }
    }
    // Until it has finished it counts as never run, so that an exception leaves it stale.
    node.has_run = false;
    node.note.clear();
    PassReport report{node.pass.name, node.pass.sentence, true, reason, 0.0, -1.0, ""};
    const auto start = std::chrono::steady_clock::now();
    const auto body = [&] { node.pass.execute(PassAccess(*this, index)); };
    if (stopwatch) {
        report.gpu_ms = stopwatch(body);
    } else {
        body();
    }
    report.cpu_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    report.note = node.note;
    report_.push_back(std::move(report));
    for (const int written : node.pass.writes) {
        resources_[std::size_t(written)].revision = next_revision();
    }
    node.seen_reads = node.pass.reads;
    node.seen.clear();
    for (const int read : node.pass.reads) {
        node.seen.push_back(resources_[std::size_t(read)].revision);
    }
    node.last_parameters = node.parameters;
    node.has_run = true;
}

const RunReport& FrameGraph::run(const std::vector<int>& wanted, const Stopwatch& stopwatch) {
    report_.clear();
    const std::vector<int> order = order_of_needed(wanted);
    for (const int index : order) {
        const std::string reason = reason_to_run(passes_[std::size_t(index)]);
        if (!reason.empty()) {
            execute(index, reason, stopwatch);
        } else {
            const Node& node = passes_[std::size_t(index)];
            report_.push_back(
                {node.pass.name, node.pass.sentence, false, "nothing it reads is newer", 0.0, -1.0, node.note});
        }
    }
    for (std::size_t index = 0; index < passes_.size(); ++index) {
        const Node& node = passes_[index];
        if (!node.alive || contains(order, int(index))) {
            continue;
        }
        for (const int written : node.pass.writes) {
            resources_[std::size_t(written)].value.reset();
        }
        report_.push_back({node.pass.name, node.pass.sentence, false, "nothing needs it", 0.0, -1.0, ""});
    }
    return report_;
}

const std::shared_ptr<void>& FrameGraph::declared(int resource, int pass, bool as_output) const {
    const Node& node = passes_[std::size_t(pass)];
    if (!contains(as_output ? node.pass.writes : node.pass.reads, resource)) {
        throw std::logic_error(fmt::format("'{}' did not declare that it {} '{}'", node.pass.name,
                                           as_output ? "writes" : "reads",
                                           resource < 0 ? "?" : resources_[std::size_t(resource)].name));
    }
    const Resource& found = resources_[std::size_t(resource)];
    if (!found.value) {
        throw std::logic_error(fmt::format("'{}' reads '{}', which has no value yet", node.pass.name, found.name));
    }
    return found.value;
}

std::string FrameGraph::drawing() const {
    std::string text = "digraph bruma {\n  rankdir=LR;\n";
    for (const Node& node : passes_) {
        if (!node.alive) {
            continue;
        }
        text += fmt::format("  \"{}\" [shape=box];\n", node.pass.name);
        for (const int read : node.pass.reads) {
            text += fmt::format("  \"{}\" -> \"{}\";\n", resources_[std::size_t(read)].name, node.pass.name);
        }
        for (const int written : node.pass.writes) {
            text += fmt::format("  \"{}\" -> \"{}\";\n", node.pass.name, resources_[std::size_t(written)].name);
        }
    }
    return text + "}\n";
}

}  // namespace bruma::render

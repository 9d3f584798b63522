#include "render/frame_graph.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <stdexcept>

namespace bruma::render {
namespace {

bool contains(const std::vector<int>& list, int value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

void PassAccess::note(std::string words) const {
    graph_.passes_.at(pass_).note = std::move(words);
}

int FrameGraph::add_resource(std::string name) {
    return resources_.add({std::move(name), 0, -1, nullptr, nullptr});
}

PassId FrameGraph::add_pass(Pass pass) {
    for (const int written : pass.writes) {
        const Resource& resource = resources_.at(written);
        if (resource.writer >= 0) {
            throw std::logic_error(fmt::format("'{}' is written by '{}' already, so '{}' cannot write it",
                                               resource.name, passes_.at(resource.writer).pass.name, pass.name));
        }
        if (!resource.make) {
            throw std::logic_error(fmt::format("'{}' is a source; '{}' cannot write it", resource.name, pass.name));
        }
    }
    const std::vector<int> writes = pass.writes;
    Node node;
    node.pass = std::move(pass);
    const int index = passes_.add(std::move(node));
    for (const int written : writes) {
        resources_.at(written).writer = index;
    }
    return {index};
}

void FrameGraph::set_reads(PassId pass, std::vector<int> reads) {
    passes_.at(pass.index).pass.reads = std::move(reads);
}

void FrameGraph::remove_pass(PassId pass) {
    for (const int written : passes_.at(pass.index).pass.writes) {
        resources_.remove(written);
    }
    passes_.remove(pass.index);
}

std::string FrameGraph::name_of(int resource) const {
    const Resource* const found = resources_.find(resource);
    return found ? found->name : "what was removed";
}

Revision FrameGraph::revision_or_none(int resource) const {
    const Resource* const found = resources_.find(resource);
    return found ? found->revision : 0;
}

std::vector<int> FrameGraph::order_of_needed(const std::vector<int>& wanted) const {
    enum class Mark { fresh, open, done };
    std::map<int, Mark> marks;
    std::vector<int> order;
    // Depth first: a pass comes after the writers of all that it reads.
    const std::function<void(int)> visit = [&](int resource) {
        const Resource* const found = resources_.find(resource);
        const int writer = found ? found->writer : -1;
        if (writer < 0 || marks[writer] == Mark::done) {
            return;
        }
        const Node& node = passes_.at(writer);
        if (marks[writer] == Mark::open) {
            throw std::logic_error(fmt::format("'{}' needs its own output", node.pass.name));
        }
        marks[writer] = Mark::open;
        for (const int read : node.pass.reads) {
            visit(read);
        }
        marks[writer] = Mark::done;
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
        if (!resources_.at(written).value) {
            return fmt::format("{} had been let go", name_of(written));
        }
    }
    if (node.pass.reads != node.seen_reads) {
        return "it reads other things now";
    }
    std::string newer;
    for (std::size_t n = 0; n < node.pass.reads.size(); ++n) {
        if (revision_or_none(node.pass.reads[n]) != node.seen[n]) {
            newer += (newer.empty() ? "" : ", ") + name_of(node.pass.reads[n]);
        }
    }
    if (!newer.empty()) {
        return newer + (newer.find(',') == std::string::npos ? " is newer" : " are newer");
    }
    const bool changed = node.same_parameters && !node.same_parameters(node.last_parameters, node.parameters);
    return changed ? "its parameters changed" : "";
}

void FrameGraph::execute(int index, const std::string& reason, const Stopwatch& stopwatch) {
    Node& node = passes_.at(index);
    for (const int written : node.pass.writes) {
        Resource& resource = resources_.at(written);
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
        resources_.at(written).revision = next_revision();
    }
    node.seen_reads = node.pass.reads;
    node.seen.clear();
    for (const int read : node.pass.reads) {
        node.seen.push_back(revision_or_none(read));
    }
    node.last_parameters = node.parameters;
    node.has_run = true;
}

const RunReport& FrameGraph::run(const std::vector<int>& wanted, const Stopwatch& stopwatch) {
    report_.clear();
    const std::vector<int> order = order_of_needed(wanted);
    for (const int index : order) {
        const std::string reason = reason_to_run(passes_.at(index));
        if (!reason.empty()) {
            execute(index, reason, stopwatch);
        } else {
            const Node& node = passes_.at(index);
            report_.push_back(
                {node.pass.name, node.pass.sentence, false, "nothing it reads is newer", 0.0, -1.0, node.note});
        }
    }
    for (const int index : passes_.indices()) {
        if (contains(order, index)) {
            continue;
        }
        const Node& node = passes_.at(index);
        for (const int written : node.pass.writes) {
            resources_.at(written).value.reset();
        }
        report_.push_back({node.pass.name, node.pass.sentence, false, "nothing needs it", 0.0, -1.0, ""});
    }
    return report_;
}

const std::shared_ptr<void>& FrameGraph::declared(int resource, int pass, bool as_output) const {
    const Node& node = passes_.at(pass);
    if (!contains(as_output ? node.pass.writes : node.pass.reads, resource)) {
        throw std::logic_error(fmt::format("'{}' did not declare that it {} '{}'", node.pass.name,
                                           as_output ? "writes" : "reads", resource < 0 ? "?" : name_of(resource)));
    }
    const Resource* const found = resources_.find(resource);
    if (!found || !found->value) {
        throw std::logic_error(
            fmt::format("'{}' reads '{}', which has no value yet", node.pass.name, name_of(resource)));
    }
    return found->value;
}

std::string FrameGraph::drawing() const {
    std::string text = "digraph bruma {\n  rankdir=LR;\n";
    for (const int index : resources_.indices()) {
        text += fmt::format("  resource{} [label=\"{}\"];\n", index, name_of(index));
    }
    for (const int index : passes_.indices()) {
        const Node& node = passes_.at(index);
        text += fmt::format("  pass{} [shape=box, label=\"{}\"];\n", index, node.pass.name);
        for (const int read : node.pass.reads) {
            if (resources_.find(read)) {
                text += fmt::format("  resource{} -> pass{};\n", read, index);
            }
        }
        for (const int written : node.pass.writes) {
            text += fmt::format("  pass{} -> resource{};\n", index, written);
        }
    }
    return text + "}\n";
}

}  // namespace bruma::render

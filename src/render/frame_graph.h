#pragma once
#include <any>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/revision.h"
#include "base/slots.h"

namespace bruma::render {

/// Names a resource of type T in a FrameGraph. Below 0 it names none; the index of a resource that was removed names
/// none either, also when another has taken its place.
template <class T>
struct Handle {
    int index = -1;
    bool operator==(const Handle&) const = default;
};

struct PassId {
    int index = -1;
};

class FrameGraph;

/// What a pass gets to see while it runs: the resources that it declared, and nothing else.
class PassAccess {
  public:
    /// A declared input. Throws std::logic_error for an undeclared one.
    template <class T>
    const T& read(Handle<T> handle) const;
    /// A declared output, as the last run left it (default-constructed at first).
    template <class T>
    T& write(Handle<T> handle) const;
    /// A few words for the explanation: "4.8 M samples".
    void note(std::string words) const;

  private:
    friend class FrameGraph;
    PassAccess(FrameGraph& graph, int pass) : graph_(graph), pass_(pass) {}
    FrameGraph& graph_;
    int pass_;
};

/// What one pass did in the last run of the graph, and why.
struct PassReport {
    std::string name;
    std::string sentence;
    bool ran = false;
    std::string reason;    ///< "camera is newer", "nothing it reads is newer", "nothing needs it"
    double cpu_ms = 0.0;   ///< 0 when it did not run
    double gpu_ms = -1.0;  ///< negative: not measured
    std::string note;
};
using RunReport = std::vector<PassReport>;

/// A kept graph of passes. Sources come from outside with a revision; each product is written by one pass. `run`
/// executes, in order, those passes that the wanted products need and whose inputs are newer than what they wrote
/// last time; everything else is left as it is, and products that nothing needs any more are let go.
class FrameGraph {
  public:
    struct Pass {
        std::string name;      ///< unique
        std::string sentence;  ///< what it computes, for people
        std::vector<int> reads;
        std::vector<int> writes;
        std::function<void(const PassAccess&)> execute;
    };
    /// Runs the body and returns the GPU's time in ms, negative if unknown.
    using Stopwatch = std::function<double(const std::function<void()>& body)>;

    FrameGraph() = default;
    FrameGraph(const FrameGraph&) = delete;
    FrameGraph& operator=(const FrameGraph&) = delete;

    template <class T>
    Handle<T> add_source(std::string name) {
        return {add_resource(std::move(name))};
    }
    /// Gives a source its value; the value is taken only if the revision differs from the last one.
    template <class T>
    void set_source(Handle<T> handle, const T& value, Revision revision) {
        Resource& resource = resources_.at(handle.index);
        if (resource.revision != revision) {
            resource.value = std::make_shared<T>(value);
            resource.revision = revision;
        }
    }
    template <class T>
    Handle<T> add_product(std::string name) {
        const Handle<T> handle{add_resource(std::move(name))};
        resources_.at(handle.index).make = [] { return std::shared_ptr<void>(std::make_shared<T>()); };
        return handle;
    }
    PassId add_pass(Pass pass);
    /// A pass whose inputs depend on the scene (gradients only when it is lit) says so before each run.
    void set_reads(PassId pass, std::vector<int> reads);
    /// What a pass does, when that depends on its parameters.
    void set_execute(PassId pass, std::function<void(const PassAccess&)> execute) {
        passes_.at(pass.index).pass.execute = std::move(execute);
    }
    /// Parameters of a pass: it reruns when they differ (operator==) from those of its last run, whatever was set and
    /// taken back in between.
    template <class P>
    void set_parameters(PassId pass, const P& parameters) {
        Node& node = passes_.at(pass.index);
        node.parameters = parameters;
        node.same_parameters = [](const std::any& last, const std::any& next) {
            const auto* a = std::any_cast<P>(&last);
            const auto* b = std::any_cast<P>(&next);
            return a && b && *a == *b;
        };
    }
    /// Takes a pass and what it writes out of the graph.
    void remove_pass(PassId pass);
    void remove_source(int resource) { resources_.remove(resource); }

    /// Brings the wanted products up to date. If a pass throws, it and all behind it stay stale, and the exception
    /// goes on to the caller.
    const RunReport& run(const std::vector<int>& wanted, const Stopwatch& stopwatch = {});
    const RunReport& last_report() const { return report_; }

    template <class T>
    const T* product(Handle<T> handle) const {
        return static_cast<const T*>(resources_.at(handle.index).value.get());
    }
    Revision revision(int resource) const { return resources_.at(resource).revision; }

    /// The graph as a Graphviz drawing; resources of equal names stay apart.
    std::string drawing() const;
    /// How many places for resources and passes there are: as many as lived at once, however many came and went.
    std::size_t places() const { return resources_.places() + passes_.places(); }

  private:
    friend class PassAccess;
    struct Resource {
        std::string name;
        Revision revision = 0;  ///< of its present value; 0: none
        int writer = -1;        ///< pass index; -1: a source
        std::shared_ptr<void> value;
        std::function<std::shared_ptr<void>()> make;
    };
    struct Node {
        Pass pass;
        std::any parameters;                                                            ///< for the next run
        std::any last_parameters;                                                       ///< of the last run
        bool (*same_parameters)(const std::any& last, const std::any& next) = nullptr;  ///< null: it has none
        bool has_run = false;
        std::vector<Revision> seen;  ///< revision of each input at the last run
        std::vector<int> seen_reads;
        std::string note;
    };

    int add_resource(std::string name);
    std::vector<int> order_of_needed(const std::vector<int>& wanted) const;
    std::string name_of(int resource) const;
    Revision revision_or_none(int resource) const;
    std::string reason_to_run(const Node& node) const;
    void execute(int index, const std::string& reason, const Stopwatch& stopwatch);
    const std::shared_ptr<void>& declared(int resource, int pass, bool as_output) const;

    Slots<Resource> resources_;
    Slots<Node> passes_;
    RunReport report_;
};

template <class T>
const T& PassAccess::read(Handle<T> handle) const {
    return *static_cast<const T*>(graph_.declared(handle.index, pass_, false).get());
}
template <class T>
T& PassAccess::write(Handle<T> handle) const {
    return *static_cast<T*>(graph_.declared(handle.index, pass_, true).get());
}

}  // namespace bruma::render

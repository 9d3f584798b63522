// Shelf: closed form. The kept graph, with passes that only count and add.
#include "render/frame_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace bruma::render {
namespace {

/// The sentence of the std::logic_error that `act` throws, or an empty one.
std::string logic_fault(const std::function<void()>& act) {
    try {
        act();
    } catch (const std::logic_error& fault) {
        return fault.what();
    }
    return {};
}

/// source a -> 'double' -> twice -> 'add' (with source b) -> sum; source a -> 'negate' -> negative.
class Graph : public testing::Test {
  protected:
    Graph() {
        double_ = graph.add_pass({"double", "two times a", {a.index}, {twice.index}, [this](const PassAccess& access) {
                                      if (double_throws) {
                                          throw std::runtime_error("planned");
                                      }
                                      access.write(twice) = 2 * access.read(a);
                                      access.note("doubled");
                                  }});
        add_ = graph.add_pass({"add", "2 a + b", {twice.index, b.index}, {sum.index}, [this](const PassAccess& access) {
                                   access.write(sum) = access.read(twice) + access.read(b);
                               }});
        negate_ = graph.add_pass({"negate", "-a", {a.index}, {negative.index}, [this](const PassAccess& access) {
                                      access.write(negative) = -access.read(a);
                                  }});
        graph.set_source(a, 10, 1);
        graph.set_source(b, 1, 2);
    }

    /// Names of the passes that ran, in order.
    std::vector<std::string> run(const std::vector<int>& wanted) {
        std::vector<std::string> names;
        for (const PassReport& report : graph.run(wanted)) {
            if (report.ran) {
                names.push_back(report.name);
            }
        }
        return names;
    }
    std::string reason(const std::string& name) const {
        for (const PassReport& report : graph.last_report()) {
            if (report.name == name) {
                return report.reason;
            }
        }
        return "not in the report";
    }

    using Names = std::vector<std::string>;
    FrameGraph graph;
    Handle<int> a = graph.add_source<int>("a");
    Handle<int> b = graph.add_source<int>("b");
    Handle<int> twice = graph.add_product<int>("twice");
    Handle<int> sum = graph.add_product<int>("sum");
    Handle<int> negative = graph.add_product<int>("negative");
    PassId double_, add_, negate_;
    bool double_throws = false;
};

TEST_F(Graph, RunsWhatIsNeededInOrderAndOnce) {
    EXPECT_EQ(run({sum.index}), (Names{"double", "add"}));
    EXPECT_EQ(*graph.product(sum), 21);
    EXPECT_EQ(graph.product(negative), nullptr) << "nothing wanted it, so nothing was made";
    EXPECT_EQ(reason("double"), "first run");
    EXPECT_EQ(reason("negate"), "nothing needs it");
    EXPECT_EQ(run({sum.index}), Names{});
    EXPECT_EQ(reason("add"), "nothing it reads is newer");
}

TEST_F(Graph, ANewerSourceRerunsWhatIsBehindIt) {
    run({sum.index, negative.index});
    graph.set_source(b, 2, 3);
    EXPECT_EQ(run({sum.index, negative.index}), (Names{"add"}));
    EXPECT_EQ(reason("add"), "b is newer");
    EXPECT_EQ(*graph.product(sum), 22);
    graph.set_source(a, 11, 4);
    EXPECT_EQ(run({sum.index, negative.index}), (Names{"double", "add", "negate"}));
    EXPECT_EQ(reason("double"), "a is newer");
    EXPECT_EQ(reason("add"), "twice is newer");
    EXPECT_EQ(*graph.product(sum), 24);
    EXPECT_EQ(*graph.product(negative), -11);
    graph.set_source(a, 12, 5);
    graph.set_source(b, 3, 6);
    run({sum.index});
    EXPECT_EQ(reason("add"), "twice, b are newer");
}

TEST_F(Graph, TheSameRevisionIsNoChange) {
    run({sum.index});
    graph.set_source(a, 99, 1);
    EXPECT_EQ(run({sum.index}), Names{});
    EXPECT_EQ(*graph.product(sum), 21);
}

TEST_F(Graph, ParametersAreComparedByValue) {
    struct Parameters {
        int factor = 0;
        bool operator==(const Parameters&) const = default;
    };
    graph.set_parameters(add_, Parameters{1});
    run({sum.index});
    graph.set_parameters(add_, Parameters{1});
    EXPECT_EQ(run({sum.index}), Names{});
    graph.set_parameters(add_, Parameters{2});
    EXPECT_EQ(run({sum.index}), (Names{"add"}));
    EXPECT_EQ(reason("add"), "its parameters changed");
    graph.set_parameters(add_, 2.0);
    EXPECT_EQ(run({sum.index}), (Names{"add"})) << "another type of parameters is another value";
}

TEST_F(Graph, ParametersTakenBackBeforeARunAreNoChange) {
    graph.set_parameters(add_, 1);
    run({sum.index});
    graph.set_parameters(add_, 2);
    graph.set_parameters(add_, 1);
    EXPECT_EQ(run({sum.index}), Names{});
    graph.set_parameters(add_, 2);
    EXPECT_EQ(run({negative.index}), (Names{"negate"})) << "not needed, so not run";
    EXPECT_EQ(run({sum.index}), (Names{"double", "add"})) << "and its parameters are still newer";
}

TEST_F(Graph, UndeclaredAccessThrows) {
    graph.set_execute(add_, [this](const PassAccess& access) { access.read(a); });
    EXPECT_EQ(logic_fault([&] { run({sum.index}); }), "'add' did not declare that it reads 'a'");
    graph.set_execute(add_, [this](const PassAccess& access) { access.write(negative) = 1; });
    EXPECT_EQ(logic_fault([&] { run({sum.index}); }), "'add' did not declare that it writes 'negative'");
    graph.set_execute(add_, [this](const PassAccess& access) { access.write(twice) = 1; });
    EXPECT_EQ(logic_fault([&] { run({sum.index}); }), "'add' did not declare that it writes 'twice'")
        << "what is read cannot be written";
    EXPECT_EQ(*graph.product(twice), 20);
}

TEST_F(Graph, AnInputWithoutValueThrows) {
    const Handle<int> unset = graph.add_source<int>("unset");
    graph.set_reads(add_, {twice.index, b.index, unset.index});
    graph.set_execute(add_, [&](const PassAccess& access) { access.read(unset); });
    EXPECT_EQ(logic_fault([&] { run({sum.index}); }), "'add' reads 'unset', which has no value yet");
}

TEST_F(Graph, TwoWritersAreRefused) {
    EXPECT_EQ(logic_fault([&] {
                  graph.add_pass({"again", "", {}, {twice.index}, {}});
              }),
              "'twice' is written by 'double' already, so 'again' cannot write it");
    EXPECT_EQ(logic_fault([&] {
                  graph.add_pass({"again", "", {}, {a.index}, {}});
              }),
              "'a' is a source; 'again' cannot write it");
}

TEST_F(Graph, ACircleIsRefused) {
    graph.set_reads(double_, {a.index, sum.index});
    EXPECT_TRUE(logic_fault([&] { run({sum.index}); }).ends_with("needs its own output"));
    graph.set_reads(double_, {a.index});
    EXPECT_EQ(run({sum.index}), (Names{"double", "add"})) << "after that the graph still works";
}

TEST_F(Graph, WhatNothingNeedsIsLetGoAndComesBack) {
    run({sum.index, negative.index});
    EXPECT_EQ(run({sum.index}), Names{});
    EXPECT_EQ(graph.product(negative), nullptr);
    EXPECT_EQ(reason("negate"), "nothing needs it");
    EXPECT_EQ(run({sum.index, negative.index}), (Names{"negate"}));
    EXPECT_EQ(reason("negate"), "negative had been let go");
    EXPECT_EQ(*graph.product(negative), -10);
}

TEST_F(Graph, AnExceptionLeavesItStaleAndNothingElse) {
    run({sum.index, negative.index});
    graph.set_source(a, 20, 7);
    double_throws = true;
    EXPECT_THROW(run({negative.index, sum.index}), std::runtime_error);
    EXPECT_EQ(*graph.product(negative), -20) << "it came before";
    EXPECT_EQ(*graph.product(sum), 21) << "the old one stays";
    EXPECT_THROW(run({sum.index, negative.index}), std::runtime_error) << "still stale";
    double_throws = false;
    EXPECT_EQ(run({negative.index, sum.index}), (Names{"double", "add"}));
    EXPECT_EQ(*graph.product(sum), 41);
    EXPECT_EQ(run({negative.index, sum.index}), Names{});
}

TEST_F(Graph, OtherReadsAreAChange) {
    run({sum.index});
    graph.set_reads(add_, {b.index, twice.index});
    EXPECT_EQ(run({sum.index}), (Names{"add"}));
    EXPECT_EQ(reason("add"), "it reads other things now");
    graph.set_reads(add_, {b.index, twice.index});
    EXPECT_EQ(run({sum.index}), Names{});
    graph.set_execute(add_, [this](const PassAccess& access) { access.write(sum) = access.read(b); });
    graph.set_reads(add_, {b.index});
    EXPECT_EQ(run({sum.index}), (Names{"add"}));
    EXPECT_EQ(reason("double"), "nothing needs it") << "a dropped input is no longer made";
    EXPECT_EQ(graph.product(twice), nullptr);
}

TEST_F(Graph, ARemovedPassIsGone) {
    run({sum.index, negative.index});
    graph.remove_pass(negate_);
    EXPECT_EQ(run({sum.index}), Names{});
    EXPECT_EQ(reason("negate"), "not in the report");
    EXPECT_EQ(graph.drawing().find("negate"), std::string::npos);
}

TEST_F(Graph, ReportsNotesAndTimes) {
    int timed = 0;
    graph.run({sum.index}, [&](const std::function<void()>& body) {
        ++timed;
        body();
        return 1.5;
    });
    EXPECT_EQ(timed, 2);
    EXPECT_EQ(graph.last_report()[0].gpu_ms, 1.5);
    EXPECT_EQ(graph.last_report()[0].note, "doubled");
    EXPECT_EQ(graph.last_report()[0].sentence, "two times a");
    run({sum.index});
    EXPECT_LT(graph.last_report()[0].gpu_ms, 0.0) << "not measured";
    EXPECT_EQ(graph.last_report()[0].note, "doubled") << "what the last run said";
}

TEST_F(Graph, DrawsItself) {
    const std::string drawing = graph.drawing();
    EXPECT_TRUE(drawing.starts_with("digraph"));
    // A box or a plain node with this label; its name in the drawing.
    const auto node = [&](const std::string& label, const std::string& sort) {
        const std::size_t at = drawing.find("label=\"" + label + "\"];");
        const std::size_t line = drawing.rfind('\n', at) + 1;
        EXPECT_TRUE(at != std::string::npos && drawing.compare(line, sort.size() + 2, "  " + sort) == 0) << label;
        return drawing.substr(line + 2, drawing.find(' ', line + 2) - line - 2);
    };
    const auto expect_arrow = [&](const std::string& from, const std::string& to) {
        EXPECT_NE(drawing.find("  " + from + " -> " + to + ";\n"), std::string::npos) << from << ' ' << to;
    };
    expect_arrow(node("a", "resource"), node("double", "pass"));
    expect_arrow(node("double", "pass"), node("twice", "resource"));
    expect_arrow(node("twice", "resource"), node("add", "pass"));
    expect_arrow(node("b", "resource"), node("add", "pass"));
    expect_arrow(node("add", "pass"), node("sum", "resource"));
}

TEST_F(Graph, DrawsResourcesOfEqualNamesApart) {
    const auto count = [](const std::string& text, const std::string& what) {
        int found = 0;
        for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
            ++found;
        }
        return found;
    };
    graph.add_source<int>("a");
    EXPECT_EQ(count(graph.drawing(), "label=\"a\""), 2);
}

TEST_F(Graph, PlacesAreUsedAgain) {
    const std::size_t before = graph.places();
    for (int n = 0; n < 200'000; ++n) {
        const Handle<int> source = graph.add_source<int>("s");
        const Handle<int> product = graph.add_product<int>("p");
        const PassId pass = graph.add_pass({"come and go", "", {source.index}, {product.index}, {}});
        graph.remove_pass(pass);
        graph.remove_source(source.index);
    }
    EXPECT_EQ(graph.places(), before + 3) << "a source, a product and a pass lived at once";
}

TEST_F(Graph, AnOldIndexDoesNotNameWhatTookItsPlace) {
    const Handle<int> gone = graph.add_source<int>("gone");
    graph.set_source(gone, 1, 7);
    graph.remove_source(gone.index);
    const Handle<int> next = graph.add_source<int>("next");
    graph.set_source(next, 2, 8);
    EXPECT_NE(gone.index, next.index);
    EXPECT_THROW(graph.revision(gone.index), std::out_of_range);
    EXPECT_THROW(graph.remove_source(gone.index), std::out_of_range);
    graph.set_reads(negate_, {a.index, gone.index});
    EXPECT_EQ(run({negative.index}), std::vector<std::string>{"negate"})
        << "reads of nothing are no fault by themselves";
    graph.set_execute(negate_, [&](const PassAccess& access) { access.write(negative) = access.read(gone); });
    graph.set_source(a, 11, 9);
    EXPECT_NE(logic_fault([&] { run({negative.index}); }).find("has no value yet"), std::string::npos);
}

}  // namespace
}  // namespace bruma::render

// Shelf: closed form. Numbers that only grow, and values that know when they changed.
#include "base/revision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

namespace bruma {
namespace {

TEST(Revision, EachIsNewerThanAllBefore) {
    const Revision first = next_revision();
    EXPECT_GT(first, 0U) << "0 means 'never'";
    EXPECT_GT(next_revision(), first);
}

TEST(Revision, ThreadsNeverShareOne) {
    std::vector<std::vector<Revision>> drawn(4);
    std::vector<std::thread> threads;
    for (auto& mine : drawn) {
        threads.emplace_back([&mine] {
            for (int n = 0; n < 10000; ++n) {
                mine.push_back(next_revision());
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    std::vector<Revision> all;
    for (const auto& mine : drawn) {
        EXPECT_TRUE(std::is_sorted(mine.begin(), mine.end()));
        all.insert(all.end(), mine.begin(), mine.end());
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

TEST(Revision, AnEqualValueIsNoChange) {
    Tracked<std::string> name(std::string("bonsai"));
    const Revision before = name.revision();
    EXPECT_FALSE(name.set("bonsai"));
    EXPECT_FALSE(name.edit([](std::string& text) { text += ""; }));
    EXPECT_EQ(name.revision(), before);
    EXPECT_TRUE(name.set("engine"));
    EXPECT_GT(name.revision(), before);
    EXPECT_EQ(*name, "engine");
}

TEST(Revision, AnEditThatThrowsChangesNothing) {
    Tracked<int> number(1);
    const Revision before = number.revision();
    EXPECT_THROW(number.edit([](int& value) {
        value = 2;
        throw 0;
    }),
                 int);
    EXPECT_EQ(*number, 1);
    EXPECT_EQ(number.revision(), before);
}

TEST(Revision, ACopyIsAsOldAsTheOriginal) {
    const Tracked<int> number(7);
    const Tracked<int> copy = number;
    EXPECT_EQ(copy.revision(), number.revision());
}

}  // namespace
}  // namespace bruma

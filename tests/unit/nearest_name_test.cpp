#include "base/nearest_name.h"

#include <gtest/gtest.h>

namespace bruma {
namespace {

const std::vector<std::string> known{"lighting", "density_scale", "ambient"};

TEST(NearestName, FindsATypingSlip) {
    EXPECT_EQ(nearest_name("lightning", known), "lighting");
    EXPECT_EQ(nearest_name("ligthing", known), "lighting");
    EXPECT_EQ(nearest_name("Ambient", known), "ambient");
}

TEST(NearestName, FindsNothingForAStranger) {
    EXPECT_EQ(nearest_name("qqqqqqqq", known), "");
}

TEST(NearestName, SuggestionListsWhatIsKnownWhenNothingIsNear) {
    EXPECT_EQ(suggestion("qqqqqqqq", known), "; known are lighting, density_scale, ambient");
    EXPECT_EQ(suggestion("ambiant", known), "; did you mean 'ambient'?");
}

}  // namespace
}  // namespace bruma

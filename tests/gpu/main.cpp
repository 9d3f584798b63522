#include <gtest/gtest.h>

#include "offscreen.h"

int main(int count, char** arguments) {
    testing::InitGoogleTest(&count, arguments);
    testing::AddGlobalTestEnvironment(new bruma::render::Offscreen);
    return RUN_ALL_TESTS();
}

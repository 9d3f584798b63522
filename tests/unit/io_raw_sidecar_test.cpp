#include "io/volume/raw_sidecar.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/log.h"
#include "io/volume/raw_layout.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

std::size_t times_said(const std::filesystem::path& file, const std::string& part) {
    const std::vector<LogLine> lines = logged_lines();
    return std::size_t(std::count_if(lines.begin(), lines.end(), [&](const LogLine& line) {
        return contains(line.text, file.string() + ":") && contains(line.text, part);
    }));
}

TEST(RawSidecar, AnotherProgramsFileIsPassedOverAndSaidOnce) {
    const std::pair<const char*, const char*> cases[]{
        {R"({"EchoTime": 0.003})", "its 'EchoTime' is unknown"},
        {R"({"EchoTime": 0.003, "RepetitionTime": 2, "Manufacturer": "x", "SliceTiming": [1]})", "and 1 more"},
        {R"({"type": "bold", "EchoTime": 0.003, "Modality": "MR"})", "'EchoTime', 'Modality' are unknown"},
        {R"([{"name": "a"}])", "it holds no object"},
        {"17", "it holds no object"},
        {"subject: 7, not JSON", "it is no JSON"},
        {"{\"EchoTime\": 0.003,}", "it is no JSON"},
        {"", "it is empty"},
    };
    for (const auto& [text, why] : cases) {
        SCOPED_TRACE(text);
        const TemporaryFolder folder;
        const auto raw = folder.write("v_2x2x2_uint8.raw", "12345678");
        const auto json = folder.write("v_2x2x2_uint8.json", text);
        EXPECT_FALSE(read_sidecar(raw));
        EXPECT_EQ(find_raw_layout(raw, {}).size, glm::ivec3(2));
        EXPECT_EQ(times_said(json, why), 1U);
    }
}

TEST(RawSidecar, OursAmongUnknownKeysIsReadAndTheRestIsSaid) {
    const TemporaryFolder folder;
    const auto raw = folder.write("v_2x2x2_uint8.raw", "12345678");
    const auto json =
        folder.write("v_2x2x2_uint8.json", R"({"spacing_mm": [1, 2, 3], "Modality": "MR", "Patient": "x"})");
    EXPECT_EQ(find_raw_layout(raw, {}).spacing_m, glm::dvec3(1e-3, 2e-3, 3e-3));
    EXPECT_EQ(times_said(json, "its 'Modality', 'Patient' are unknown, but for 'spacing_mm'"), 1U);
}

TEST(RawSidecar, WhatWasMeantForUsIsStillTold) {
    const std::pair<const char*, const char*> cases[]{
        {R"({"spacng_mm": [1, 1, 2]})", "spacng_mm: unknown key; did you mean 'spacing_mm'?"},
        {R"({"spacing-mm": [1, 1, 2], "comment": "x"})", "did you mean 'spacing_mm'?"},
        {R"({"type": "uint7", "comment": "x"})", "type: unknown word 'uint7'"},
        {R"({"spacing_mm": [1, 1, 2})", "broken JSON"},
        {R"({"size": [2, 2, 2], "size": [2, 2, 2]})", "given twice"},
    };
    for (const auto& [text, what] : cases) {
        const TemporaryFolder folder;
        const auto raw = folder.write("v_2x2x2_uint8.raw", "12345678");
        folder.write("v_2x2x2_uint8.json", text);
        const std::string sentence = refusal([&] { read_sidecar(raw); });
        EXPECT_TRUE(contains(sentence, what)) << text << ": " << sentence;
    }
}

// NAME.raw.json goes first, but a foreign one does not hide our NAME.json.
TEST(RawSidecar, AForeignFileDoesNotHideOurs) {
    const TemporaryFolder folder;
    const auto raw = folder.write("v_2x2x2_uint8.raw", "12345678");
    folder.write("v_2x2x2_uint8.raw.json", R"({"EchoTime": 0.003})");
    folder.write("v_2x2x2_uint8.json", R"({"rotation": [90, 0, 0]})");
    ASSERT_TRUE(read_sidecar(raw));
    EXPECT_EQ(read_sidecar(raw)->rotation_deg, glm::dvec3(90, 0, 0));
}

}  // namespace
}  // namespace bruma::io

#include "io/json/json_text.h"

#include <gtest/gtest.h>

#include "io/open.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_json.h"
#include "io/scene/scene_settings.h"
#include "io/scene/transfer_function_file.h"
#include "io/volume/raw_sidecar.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

std::string nested(int levels) {
    return std::string(std::size_t(levels), '[') + std::string(std::size_t(levels), ']');
}

TEST(JsonText, DepthIsLimitedWhereverJsonIsRead) {
    const TemporaryFolder folder;
    EXPECT_EQ(parse_json(nested(100), "a").size(), 1U);
    EXPECT_EQ(refusal([] { parse_json(nested(101), "a"); }),
              "a: brackets stand 101 deep, but at most 100 are read; is it the right file?");
    for (const int levels : {101, 100000}) {
        const std::string deep = nested(levels);
        const auto file = folder.write("deep.json", R"({"bruma_scene": 1, "nodes": {"a": )" + deep + "}}");
        EXPECT_TRUE(contains(refusal([&] { read_scene_file(file); }), "brackets stand 101 deep"));
        folder.write("v.json", "{\"size\": " + deep + "}");
        EXPECT_TRUE(contains(refusal([&] { read_sidecar(folder / "v.raw"); }), "brackets stand 101 deep"));
        folder.write("p.json", "{\"bruma_transfer_function\": " + deep + "}");
        EXPECT_TRUE(contains(refusal([&] { load_transfer_function(folder / "p.json"); }), "brackets stand 101 deep"));
        const scene::Scene scene = open_files(std::vector<std::string>{"builtin:bucky"}, {}, {});
        EXPECT_TRUE(contains(refusal([&] {
                                 with_settings(scene,
                                               std::vector<std::string>{"volume.transfer_function.opacity=" + deep});
                             }),
                             "--set volume.transfer_function.opacity: brackets stand 101 deep"));
        // Objects within objects, and brackets that nothing closes.
        std::string objects;
        for (int n = 0; n < levels; ++n) {
            objects += "{\"a\":";
        }
        EXPECT_TRUE(contains(refusal([&] { parse_json(objects, "a"); }), "brackets stand 101 deep"));
    }
}

TEST(JsonText, MessagesHoldNoWordsOfTheLibrary) {
    for (const char* text :
         {"", "{", "{\"a\" 1}", "[1e999]", "\"\xff\"", "{\"a\": 1, \"a\": 2}", "\"\\ud800\"", "nul"}) {
        const std::string sentence = refusal([&] { parse_json(text, "a.json"); });
        EXPECT_TRUE(sentence.starts_with("a.json:")) << sentence;
        EXPECT_FALSE(contains(sentence, "exception")) << sentence;
    }
    const std::string sentence = refusal([] { json_text(nlohmann::json("\xff")); });
    EXPECT_TRUE(contains(sentence, "is not UTF-8")) << sentence;
    EXPECT_FALSE(contains(sentence, "exception")) << sentence;
}

}  // namespace
}  // namespace bruma::io

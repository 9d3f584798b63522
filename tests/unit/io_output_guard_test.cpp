#include "io/output_guard.h"

#include <sys/stat.h>

#include "io/atomic_file.h"
#include "io/input_file.h"
#include "io/picture/picture_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/transfer_function_file.h"
#include "io_temporary_folder.h"
#include "scene/builtin/builtin.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

Picture8 small_picture() {
    return {2, 1, std::vector<std::uint8_t>(8, 200)};
}

OutputStanding standing(const fs::path& path, FileContent content, const std::vector<fs::path>& inputs = {}) {
    return judge_output(path, content, inputs).standing;
}

TEST(FileContent, IsToldFromTheBytes) {
    const TemporaryFolder folder;
    // Names that say something else, since names do not count.
    write_png((folder / "picture.png").string(), small_picture());
    write_hdr((folder / "picture.hdr").string(), Image(2, 1));
    write_exr((folder / "picture.exr").string(), Image(2, 1));
    fs::rename(folder / "picture.png", folder / "a.raw");
    save_scene_file(scene::Scene(), folder / "b.json");
    save_transfer_function(scene::TransferFunction(), folder / "c.json");
    EXPECT_EQ(content_of(folder / "a.raw"), FileContent::png);
    EXPECT_EQ(content_of(folder / "picture.hdr"), FileContent::hdr);
    EXPECT_EQ(content_of(folder / "picture.exr"), FileContent::exr);
    EXPECT_EQ(content_of(folder / "b.json"), FileContent::scene);
    EXPECT_EQ(content_of(folder / "c.json"), FileContent::transfer_function);
    EXPECT_EQ(content_of(folder.write("d", R"({"driver":{},"passes":[]})")), FileContent::statistics);
    EXPECT_EQ(content_of(folder.write("e", R"({"bench":"light","machine":{}})")), FileContent::bench_record);
    EXPECT_EQ(content_of(folder.write("f", "digraph bruma {\n}\n")), FileContent::graph);
    EXPECT_EQ(content_of(folder.write("g", "<!doctype html><title>Bruma: x</title>")), FileContent::bench_page);
    EXPECT_EQ(content_of(folder.write("h", "technique,step_m,rmse,bias,ms,cpu_ms,light_per_pixel\nx,1\n")),
              FileContent::bench_table);
    EXPECT_EQ(content_of(folder.write("i", "#version 450 core\n#define X 1\n#line 2 0\n")), FileContent::shader);
    EXPECT_EQ(content_of(folder.write("j", "")), FileContent::nothing);
}

TEST(FileContent, OfOthersIsSomethingElse) {
    const TemporaryFolder folder;
    const std::string deep(100'000, '[');
    for (const std::string& text :
         {std::string(64, '\0'), std::string("v 0 0 0\n"), std::string(R"({"EchoTime":0.003})"),
          std::string(R"({"inner":{"bruma_scene":1}})"), std::string(R"({"bruma_scene":1)"),
          std::string("time,ms\n1,2\n"), std::string("#version 450 core\nvoid main() {}\n"), std::string("\x89PNG"),
          R"({"a":)" + deep, std::string("{")}) {
        EXPECT_EQ(content_of(folder.write("file", text)), FileContent::other) << text.substr(0, 60);
    }
    EXPECT_EQ(content_of(folder / "missing"), FileContent::other);
    EXPECT_EQ(content_of(folder.path()), FileContent::other);
}

TEST(OutputGuard, ReplacesItsOwnKindOnly) {
    const TemporaryFolder folder;
    const std::string picture = (folder / "a.png").string();
    EXPECT_EQ(standing(picture, FileContent::png), OutputStanding::free);
    write_png(picture, small_picture());
    EXPECT_EQ(standing(picture, FileContent::png), OutputStanding::same_kind);
    EXPECT_EQ(standing(picture, FileContent::scene), OutputStanding::another_kind);
    EXPECT_EQ(standing(folder.write("empty", ""), FileContent::png), OutputStanding::free);
    EXPECT_EQ(standing("/dev/null", FileContent::png), OutputStanding::free);
    const OutputVerdict verdict = judge_output(folder.write("scan.raw", "voxels"), FileContent::scene, {});
    EXPECT_EQ(verdict.standing, OutputStanding::another_kind);
    EXPECT_TRUE(contains(verdict.sentence, "scan.raw: holds something else than a scene")) << verdict.sentence;
}

TEST(OutputGuard, NeverReplacesAnInputByAnyOfItsNames) {
    const TemporaryFolder folder;
    const fs::path input = folder.write("scan.raw", "voxels");
    fs::create_symlink("scan.raw", folder / "link.raw");
    fs::create_hard_link(input, folder / "hard.raw");
    fs::create_directory(folder / "sub");
    for (const fs::path& name : {input, folder / "link.raw", folder / "hard.raw", folder / "sub" / ".." / "scan.raw"}) {
        EXPECT_EQ(standing(name, FileContent::png, {input}), OutputStanding::input) << name;
        EXPECT_EQ(standing(input, FileContent::png, {name}), OutputStanding::input) << name;
    }
    // Also when the kinds are alike: a texture is not a place for a picture.
    write_png((folder / "texture.png").string(), small_picture());
    EXPECT_EQ(standing(folder / "texture.png", FileContent::png, {folder / "texture.png"}), OutputStanding::input);
    fs::remove(input);
    EXPECT_EQ(standing(input, FileContent::png, {input}), OutputStanding::free);
}

TEST(OutputGuard, LetsASceneReplaceTheSceneThatWasRead) {
    const TemporaryFolder folder;
    const fs::path scene = folder / "scene.json";
    save_scene_file(scene::Scene(), scene);
    EXPECT_EQ(standing(scene, FileContent::scene, {scene}), OutputStanding::same_kind);
    EXPECT_EQ(standing(scene, FileContent::statistics, {scene}), OutputStanding::input);
    EXPECT_EQ(standing(scene, FileContent::transfer_function, {scene}), OutputStanding::input);
}

TEST(OutputGuard, KnowsEveryFileThatWasRead) {
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl red\nKd 1 0 0\nmap_Kd t.png\n");
    write_png((folder / "t.png").string(), small_picture());
    folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1\n");
    folder.write("v.raw", std::string(8, 'x'));
    folder.write("v.json", R"({"size":[2,2,2],"type":"uint8"})");
    write_png((folder / "w.png").string(), {8, 8, std::vector<std::uint8_t>(256, 200)});
    folder.write("s.json", R"({"bruma_scene":1,"nodes":{"m":{"kind":"mesh","source":{"file":"a.obj"}},
        "v":{"kind":"volume","source":{"file":"v.raw","size":[2,2,2],"type":"uint8"}},
        "c":{"kind":"clouds","weather":{"file":"w.png"}}}})");
    ASSERT_EQ(refusal([&] { read_scene_file(folder / "s.json"); }), "");
    for (const char* name : {"a.obj", "a.mtl", "t.png", "v.raw", "w.png", "s.json"}) {
        EXPECT_EQ(judge_output(folder / name, FileContent::statistics).standing, OutputStanding::input) << name;
    }
}

TEST(OutputGuard, RefusesTwoOutputsInOneFile) {
    const TemporaryFolder folder;
    fs::create_symlink("a.png", folder / "link.png");
    const auto both = [&](const fs::path& first, const fs::path& second) {
        return refusal([&] {
            OutputGuard guard(true);
            guard.add("-o", first, FileContent::png);
            guard.add("--stats", second, FileContent::statistics);
        });
    };
    const std::string sentence = both(folder / "a.png", folder / "a.png");
    EXPECT_TRUE(contains(sentence, "--stats") && contains(sentence, "of -o")) << sentence;
    EXPECT_NE(both(folder / "a.png", folder / "link.png"), "");
    EXPECT_NE(both(folder / "a.png", folder / "." / "a.png"), "");
    folder.write("a.png", "");
    EXPECT_NE(both(folder / "a.png", folder / "link.png"), "");
    EXPECT_EQ(both(folder / "a.png", folder / "a.json"), "");
    EXPECT_EQ(both("/dev/null", "/dev/null"), "");
}

TEST(OutputGuard, NamesTheOptionAndTheWayOut) {
    const TemporaryFolder folder;
    const fs::path text = folder.write("notes.txt", "mine");
    const auto add = [&](bool force, const fs::path& path) {
        return refusal([&] { OutputGuard(force).add("--stats", path, FileContent::statistics); });
    };
    const std::string sentence = add(false, text);
    EXPECT_TRUE(contains(sentence, "--stats") && contains(sentence, "notes.txt") && contains(sentence, "--force"))
        << sentence;
    EXPECT_EQ(add(true, text), "");
    announce_input(text);
    EXPECT_TRUE(contains(add(true, text), "one of the files that were read")) << add(true, text);
}

TEST(OutputGuard, JudgesAgainWhatWasReadLater) {
    const TemporaryFolder folder;
    const fs::path texture = folder / "late.png";
    write_png(texture.string(), small_picture());
    OutputGuard guard(false);
    guard.add("-o", texture, FileContent::png);
    EXPECT_EQ(refusal([&] { guard.check(); }), "");
    read_text_file(texture, 1 << 20);
    EXPECT_NE(refusal([&] { guard.check(); }), "");
}

}  // namespace
}  // namespace bruma::io

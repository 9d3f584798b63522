#include "io/mesh/obj_mesh.h"
#include "io/mesh/off_mesh.h"
#include "measure/stress/stress_mesh.h"
#include "measure/stress/stress_mesh_folder.h"

namespace bruma::measure {
namespace {

const std::string corners = "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\n";
const std::string good = corners + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

struct FileCase {
    const char* name;
    const char* what;
    std::string text;
    bool loads;
};

std::vector<FileCase> obj_cases() {
    return {
        {"empty", "no byte at all", "", false},
        {"blank", "blank lines alone", "\n\n# nothing\n\n", false},
        {"no-faces", "vertices without faces", corners, false},
        {"lines-only", "lines and points, no faces", corners + "l 1 2 3\np 4\n", false},
        {"binary", "zero bytes", std::string("v 1 2 3\0\0\1\xff", 11), false},
        {"noise", "bytes that are no text",
         "\xff\xfe\x80\x81 v f vt \x01\x02\n\x7f"
         "ELF",
         false},
        {"cut-short", "a file that ends in the middle of a number", corners + "f 1 2 3\nf 1 2 4\nv 1.", true},
        {"one-triangle", "a single triangle", corners + "f 1 2 3\n", true},
        {"no-area", "one triangle on a line", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", false},
        {"no-area-among", "a face without area among good ones", good + "f 1 1 2\nf 2 2 2\n", true},
        {"two-corners", "faces of one and of two corners", good + "f 1\nf 1 2\n", true},
        {"two-corners-only", "faces of two corners alone", corners + "f 1 2\n", false},
        {"nan", "a vertex of NaN that a face uses", good + "v nan nan nan\nf 1 2 5\n", true},
        {"inf", "a vertex at infinity that a face uses", good + "v inf 0 -inf\nf 1 2 5\n", true},
        {"1e999", "a number too large for doubles", good + "v 1e999 0 0\nf 1 2 5\n", true},
        {"1e300", "a number too large for floats", good + "v 1e300 0 0\nf 1 2 5\n", true},
        {"all-nan", "nothing but NaN", "v nan 0 0\nv 0 nan 0\nv 0 0 nan\nf 1 2 3\n", false},
        {"nan-normals", "normals of NaN and of no length",
         good + "vn nan 0 0\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1//2 2//2 4//2\n", true},
        {"out-of-range", "one index behind the last vertex", good + "f 1 2 5\n", true},
        {"out-of-range-only", "no other face", corners + "f 1 2 5\n", false},
        {"index-0", "index 0", good + "f 0 1 2\n", true},
        {"negative", "indices from behind", corners + "f -4 -3 -2\n", true},
        {"negative-beyond", "before the first vertex", good + "f -5 -1 -2\n", true},
        {"index-huge", "indices beyond 64 bits", good + "f 1 2 99999999999999999999\nf -99999999999999999999 1 2\n",
         true},
        {"attributes-beyond", "texture coordinates and normals that are not there", corners + "f 1/9/9 2/9/9 3/9/9\n",
         true},
        {"no-library", "a material library that does not exist", "mtllib gone.mtl\nusemtl gold\n" + good, true},
        {"library-is-folder", "a material library that is a folder", "mtllib .\nusemtl gold\n" + good, true},
        {"nonconvex", "a pentagon with a dent, not flat",
         "v 0 0 0\nv 10 0 1\nv 10 10 0\nv 5 1 1\nv 0 10 0\nf 1 2 3 4 5\n", true},
        {"crossing", "a polygon that crosses itself", "v 0 0 0\nv 10 10 0\nv 10 0 0\nv 0 10 0\nf 1 2 3 4\n", true},
        {"repeated", "the same face a hundred times",
         [] {
             std::string text = good;
             for (int n = 0; n < 100; ++n) {
                 text += "f 1 3 2\n";
             }
             return text;
         }(),
         true},
    };
}

}  // namespace

void stress_mesh_files(MeshCases& cases) {
    const StressFolder folder;
    const auto load = [&](const std::string& name, const std::string& text) {
        scene::MeshSource source;
        source.millimetres_per_unit = 1.0;
        return io::load_obj_mesh(folder.write(name + ".obj", text), source).mesh;
    };
    for (const FileCase& one : obj_cases()) {
        if (one.loads) {
            cases.sound(one.name, one.what, [&] { return mesh_scene(load(one.name, one.text)); });
        } else {
            cases.refused(one.name, one.what, [&] { load(one.name, one.text); });
        }
    }
    cases.refused("missing", "a file that does not exist",
                  [&] { io::load_obj_mesh(folder.path() / "gone.obj", scene::MeshSource{}); });
    cases.refused("folder", "a folder", [&] { io::load_obj_mesh(folder.path(), scene::MeshSource{}); });
    int number = 0;
    for (const char* head : {"OFF\n-3 1 0\n", "OFF\n3 -1 0\n", "OFF\n99999999999999999999 1 0\n", "OFF\n3 1 0\nnan"}) {
        cases.refused("off-counts-" + std::to_string(++number), "an OFF file of counts that cannot be",
                      [&] { io::load_off_mesh(folder.write("a.off", head), scene::MeshSource{}); });
    }
}

}  // namespace bruma::measure

#include <algorithm>

#include "base/error.h"
#include "io/foreign_format.h"
#include "io/json/json_text.h"
#include "io/mesh/mesh_source.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_json.h"
#include "io/scene/scene_settings.h"
#include "io/scene/transfer_function_file.h"
#include "io/volume/raw_layout.h"
#include "io/volume/raw_name.h"
#include "io/volume/raw_proposals.h"
#include "io/volume/raw_volume.h"
#include "io/volume/volume_header.h"
#include "io_picture_samples.h"
#include "readers.h"
#include "scene/builtin/builtin.h"

namespace bruma::fuzz {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> json_words{"{",
                                          "}",
                                          "[",
                                          "]",
                                          "[[[[[[[[",
                                          "null",
                                          "true",
                                          "\"\"",
                                          "\"\\ud800\"",
                                          ",",
                                          ":",
                                          "\"kind\": \"volume\"",
                                          "1e400",
                                          "-0",
                                          "\"bruma_scene\": 1",
                                          "\xff",
                                          std::string(200, '['),
                                          "\"preset\"",
                                          "\"\\u0000\""};

std::string scene_text() {
    return R"({"bruma_scene": 1, "camera": {"eye": [0, 0, 1], "target": [0, 0, 0]}, "time": {"end": 2},
 "lights": {"key": {"kind": "point", "intensity": 2}},
 "nodes": {"v": {"kind": "volume", "source": {"file": "v_4x4x4_uint8.raw"}, "lighting": "gradient",
                 "transfer_function": {"domain": [0, 255], "opacity": [[0, 0], [1, 0.5]]}},
           "m": {"kind": "mesh", "source": {"file": "m.obj", "texture": "t.png"}, "parent": "g"},
           "g": {"kind": "group", "transform": {"scale": [1, 1, 1]}}}})";
}

const std::string box_obj =
    "mtllib m.mtl\no box\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nvt 0 0\nvt 1 0\nvn 0 0 1\n"
    "usemtl red\ns 1\nf 1/1/1 2/2/1 3//1 4\nf -1 -2 -3\ng top\nusemtl none\nf 1 2 5\nl 1 2\np 1\n";
const std::string box_mtl =
    "newmtl red\nKa 0 0 0\nKd 0.9 0.1 0.1\nKs 0.5 0.5 0.5\nNs 20\nd 0.5\nTr 0.5\nillum 2\nmap_Kd -s 1 1 1 t.png\n"
    "newmtl none\nKd spectral f.rfl 1\nKe 1 1 1\nmap_Kd \"t.png\" # comment\n";

void put_companions(const fs::path& folder) {
    put(folder, "v_4x4x4_uint8.raw", io::samples::noise(64));
    put(folder, "t.png", io::samples::png(2, 2, 8, 2, io::samples::png_rows(2, 6)));
    put(folder, "m.mtl", box_mtl);
    put(folder, "m.obj", box_obj);
}

/// A mesh file by its ending.
void read_mesh(const fs::path& path) {
    scene::MeshSource source;
    source.file = path.string();
    io::load_mesh(source, {});
}

Reader scene_document() {
    Reader reader{"scene", {scene_text()}, json_words, {}};
    for (const std::string& name : scene::builtin_scene_names()) {
        reader.sound.push_back(io::json_text(io::to_json(scene::builtin_scene(name))));
        if (reader.sound.size() == 4) {
            break;
        }
    }
    reader.read = [](const std::string& input, const fs::path&) {
        const scene::Scene scene = io::from_json(io::parse_json(input, "scene.json"), "scene.json");
        // What has been read can be written, and read again.
        io::from_json(io::parse_json(io::json_text(io::to_json(scene)), "again"), "again");
    };
    return reader;
}

Reader scene_file() {
    return {"scene-file", {scene_text()}, json_words, [](const std::string& input, const fs::path& folder) {
                put_companions(folder);
                // Maps of clouds are made, not read, and large ones take their time.
                if (input.find("clouds") == std::string::npos && input.find("builtin:") == std::string::npos) {
                    io::read_scene_file(put(folder, "s.json", input));
                }
            }};
}

Reader setting() {
    return {"setting",
            {"camera.eye=[0, 0.1, 0.5]", "nodes.v.transfer_function.opacity.1.0=0.3", "volume.density_scale=2",
             "mesh.material=cream", "light.intensity=1", "volume.source.spacing=1,1,2", "sky.model=look",
             "volume.lighting=none", "nodes.m.parent=g"},
            json_words,
            [](const std::string& input, const fs::path&) {
                static const nlohmann::json document = io::parse_json(scene_text(), "scene");
                nlohmann::json changed = io::to_json(io::from_json(document, ""));
                io::apply_setting(changed, input);
                io::from_json(changed, "--set");
            }};
}

Reader sidecar() {
    return {
        "sidecar",
        {R"({"size": [4, 4, 4], "type": "u8", "spacing_mm": [1, 1, 2], "rotation": [-90, 0, 180]})",
         R"({"EchoTime": 0.003, "size": [8, 4, 2], "type": "uint8", "endian": "big", "offset": 0, "spacing": [0.001, 0.001, 0.002]})"},
        json_words,
        [](const std::string& input, const fs::path& folder) {
            const fs::path raw = put(folder, "v.raw", io::samples::noise(64));
            put(folder, "v.json", input);
            io::load_raw_volume(raw, {});
        }};
}

Reader curve() {
    return {"preset",
            {R"({"bruma_transfer_function": 1, "domain": [0, 255], "opacity": [[0, 0], [0.5, 0.2], [1, 1]],
 "color": [[0, 1, 0, 0], [1, 0, 0, 1]], "emission": [[0, 0], [1, 2]], "reference_length": 0.001})"},
            json_words,
            [](const std::string& input, const fs::path& folder) {
                const auto curve = io::load_transfer_function(put(folder, "p.json", input));
                io::read_transfer_function(io::transfer_function_json(curve), "again");
            }};
}

/// The first line is the file's name, the rest its bytes.
Reader raw_volume() {
    std::string bell;
    for (int n = 0; n < 16 * 16 * 16; ++n) {
        const int x = n % 16 - 8, y = n / 16 % 16 - 8, z = n / 256 - 8;
        bell += char(255 / (1 + (x * x + y * y + z * z) / 8));
    }
    return {
        "raw",
        {"a_4x4x4_uint8.raw\n" + io::samples::noise(64), "b_4x2x4_float32_be_1x1x2mm.raw\n" + io::samples::noise(128),
         "c.raw\n" + bell, "d_8x8x8_int16.raw\nhead" + io::samples::noise(1024)},
        {"2x2x2", "uint16", "float32", "_be", "_le", "1x1x2mm", "0x0x0", "\x7f\xc0\x00\x00", "\xff\x80", "int8", "um",
         "99999x99999x99999", "\n"},
        [](const std::string& input, const fs::path& folder) {
            const std::size_t end = std::min(input.find('\n'), input.size());
            std::string name = input.substr(0, end);
            std::replace_if(
                name.begin(), name.end(), [](char c) { return c == '/' || c == '\0'; }, '_');
            name = name.substr(0, 200);
            const fs::path path = put(folder, name.ends_with(".raw") ? name : name + ".raw",
                                      input.substr(std::min(input.size(), end + 1)));
            each({[&] { io::load_raw_volume(path, {}); }, [&] { io::layout_from_name(path); },
                  [&] { io::propose_layouts(path, {}, 3); },
                  [&] {
                      scene::VolumeSource hints;
                      hints.type = scene::VoxelType::float32;
                      io::propose_layouts(path, hints, 3);
                  }});
        }};
}

/// MetaImage and NRRD, beside a raw file of 64 samples and before its own.
Reader volume_header() {
    const std::string metaimage =
        "ObjectType = Image\nNDims = 3\nDimSize = 4 4 4\nElementType = MET_UCHAR\nElementSpacing = 1 1 2\n"
        "BinaryDataByteOrderMSB = False\nHeaderSize = 0\nElementDataFile = v.raw\n";
    const std::string nrrd =
        "NRRD0004\n# comment\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nspacings: 1 1 2\nencoding: raw\n";
    return {"volume-header",
            {metaimage, nrrd + "data file: v.raw\n\n", nrrd + "\n" + io::samples::noise(64)},
            {"ElementDataFile = LOCAL\n",
             "ElementDataFile = LIST\n",
             "MET_FLOAT",
             "MET_SHORT",
             "CompressedData = True\n",
             "TransformMatrix = 1 0 0 0 1 0 0 0 1\n",
             "NDims = 4\n",
             "HeaderSize = -1\n",
             "endian: big\n",
             "space directions: (1,0,0) (0,1,0) (0,0,2)\n",
             "space: left-posterior-superior\n",
             "byte skip: -1\n",
             "line skip: 3\n",
             "encoding: gzip\n",
             "data file: %d.raw 0 3 1\n",
             "kinds: domain domain domain\n",
             "nan",
             "none",
             "v.raw",
             "../",
             "\n"},
            [](const std::string& input, const fs::path& folder) {
                put(folder, "v.raw", io::samples::noise(64));
                const fs::path path = put(folder, "v.mhd", input);
                each({[&] { io::read_volume_header(path); }, [&] { io::load_raw_volume(path, {}); },
                      [&] { io::load_raw_volume(folder / "v.raw", {}); }});
            }};
}

/// What a file of another program's is, by the bytes at its beginning; no fault is told.
Reader foreign() {
    return {"foreign",
            {"\x5c\x01\x00\x00" + io::samples::noise(400), "\x1f\x8b\x08\x00" + io::samples::noise(60),
             "PK\x03\x04" + io::samples::noise(60), "# vtk DataFile Version 3.0\nx\nASCII\n", "ply\nformat ascii 1.0\n",
             std::string(128, '\0') + "DICM" + io::samples::noise(60), "solid x\nfacet normal 0 0 1\n"},
            {"n+1", "ni1", "GIF89a", "\x89HDF", "CDF\x01", "II*", "glTF", "BZh", "\x28\xb5\x2f\xfd",
             "version https://git-lfs"},
            [](const std::string& input, const fs::path& folder) { io::foreign_format(put(folder, "f.raw", input)); }};
}

Reader mesh(const std::string& name, const std::string& file, std::vector<std::string> sound,
            std::vector<std::string> words) {
    return {name, std::move(sound), std::move(words), [file](const std::string& input, const fs::path& folder) {
                put_companions(folder);
                const fs::path path = put(folder, file, input);
                read_mesh(file == "m.mtl" ? folder / "m.obj" : path);
            }};
}

}  // namespace

std::vector<Reader> text_readers() {
    return {
        scene_document(),
        scene_file(),
        setting(),
        sidecar(),
        curve(),
        raw_volume(),
        volume_header(),
        foreign(),
        mesh("obj", "m.obj", {box_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
             {"f ",      "v ",    "vt ",  "vn ", "\n",      "/",         "//",  "-1",          "usemtl ",  "mtllib ",
              "l 1 2\n", "p 1\n", "\\\n", "o ",  "s off\n", "f 1 1 1\n", "nan", "99999999999", "vp 0 0\n", "t "}),
        mesh("mtl", "m.mtl", {box_mtl},
             {"newmtl ", "map_Kd ", "Kd ", "Ks ", "Ns 0\n", "-s ", "-o 1 1 1 ", "-clamp on ", "-bm 1 ", "\n",
              "spectral ", "xyz 1 1 1", "illum 9\n", "map_d t.png\n", "-mm 0 1 ", "#"}),
        mesh("off", "m.off",
             {"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 2 255 0 0\n",
              "COFF # c\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n"},
             {"OFF", "NOFF", "STOFF", "4OFF", "nOFF\n3\n", "BINARY", "\n", "#", "-1", "99999999999", "nan"}),
        mesh("triangles", "m.raw", {"0 0 0 1 0 0 0 1 0\n# comment\n0 0 0 0 1 0 0 0 1\r\n\n1 1 1 2 2 2 3 3 4\n"},
             {"\n", "#", "nan", "1e39", " ", "\t", "\r\n", "0 0 0 1 0 0 0 1 0 7\n", "x"}),
    };
}

}  // namespace bruma::fuzz

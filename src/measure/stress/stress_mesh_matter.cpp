#include <fmt/core.h>

#include "io/scene/scene_json.h"
#include "measure/stress/stress_mesh.h"

namespace bruma::measure {
namespace {

scene::Scene made_of(const std::function<void(scene::SubsurfaceMedium&)>& change) {
    scene::Scene scene = ball_scene();
    set_medium(scene, change);
    return scene;
}

/// Reads the scene with another value in the mesh's node, as a file or --set would bring it.
void read_with(const std::string& key, const nlohmann::json& value) {
    scene::Scene scene = ball_scene();
    nlohmann::json document = io::to_json(scene);
    document["nodes"]["mesh"][key] = value;
    io::from_json(document, "");
}

nlohmann::json all(double value) {
    return {value, value, value};
}

}  // namespace

void stress_mesh_matter(MeshCases& cases) {
    // Coefficients of 1e-9 to 1e9 per metre.
    for (const double sigma : {1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        for (const double albedo : {1e-6, 0.5, 1.0}) {
            cases.sound(fmt::format("sigma-{:g}-albedo-{:g}", sigma, albedo), "extinction per mm, and reduced albedo",
                        [=] {
                            return made_of([=](scene::SubsurfaceMedium& medium) {
                                medium.reduced_scattering = glm::dvec3(albedo * sigma);
                                medium.absorption = glm::dvec3((1.0 - albedo) * sigma);
                            });
                        });
        }
    }
    cases.sound("colours-apart", "a colour of each extreme", [] {
        return made_of([](scene::SubsurfaceMedium& medium) {
            medium.reduced_scattering = {1e-12, 1.0, 1e6};
            medium.absorption = {1e6, 0.0, 1e-12};
        });
    });
    for (const double g : {-0.99, 0.0, 0.99}) {
        cases.sound(fmt::format("g{:+g}", g), "mean cosine of scattering", [g] {
            return made_of([g](scene::SubsurfaceMedium& medium) { medium.asymmetry = glm::dvec3(g); });
        });
    }
    for (const double eta : {1.0, 1.0001, 1.05, 1.3, 2.5}) {
        cases.sound(fmt::format("eta-{:g}", eta), "index of refraction", [eta] {
            return made_of([eta](scene::SubsurfaceMedium& medium) { medium.refraction_index = eta; });
        });
    }
    for (int n = 1; n < int(scene::enum_words<scene::Material>().size()); ++n) {
        cases.sound(std::string(scene::enum_words<scene::Material>()[std::size_t(n)]), "matter by name", [n] {
            scene::Scene scene = ball_scene();
            stress_mesh(scene).surface.edit(
                [n](scene::MeshSurface& surface) { surface.material = scene::Material(n); });
            return scene;
        });
    }
    cases.rig().number("read-back", "the scene as it is written is read", 0.0, [] {
        read_with("asymmetry", all(0.5));
        return 0.0;
    });
    cases.refused("albedo-0", "matter that scatters nothing", [] {
        scene::check(made_of([](scene::SubsurfaceMedium& medium) { medium.reduced_scattering.y = 0.0; }));
    });
    struct Beyond {
        const char *key, *name;
        nlohmann::json value;
    };
    const Beyond beyonds[] = {{"reduced_scattering", "scattering-negative", all(-1e-9)},
                              {"reduced_scattering", "scattering-1e7", all(1e7)},
                              {"absorption", "absorption-negative", all(-1e-9)},
                              {"absorption", "absorption-1e7", all(1e7)},
                              {"absorption", "absorption-two", {1.0, 1.0}},
                              {"asymmetry", "g-1", all(1.0)},
                              {"asymmetry", "g+-1", all(-1.0)},
                              {"asymmetry", "g-1e300", all(1e300)},
                              {"asymmetry", "g-null", nullptr},
                              {"refraction_index", "eta-0.99", 0.99},
                              {"refraction_index", "eta-0", 0.0},
                              {"refraction_index", "eta-3", 3.0},
                              {"material", "material-unknown", "granite"}};
    for (const Beyond& beyond : beyonds) {
        cases.refused(beyond.name, "a value beyond the range", [&] { read_with(beyond.key, beyond.value); });
    }
    const auto maps = [](const std::function<void(scene::SubsurfaceSettings&)>& change) {
        scene::Scene scene = ball_scene();
        stress_mesh(scene).subsurface.edit(change);
        return scene;
    };
    cases.sound("one-map", "one map of 16 texels, one point", [&] {
        return maps([](auto& settings) {
            settings.maps = settings.samples = 1;
            settings.map_size = settings.light_map_size = 16;
        });
    });
    cases.sound("most-maps", "32 maps, 256 points", [&] {
        return maps([](auto& settings) {
            settings.maps = 32;
            settings.samples = 256;
            settings.map_size = 16;
        });
    });
    cases.sound(
        "disk", "points on the exponential disk",
        [&] { return maps([](auto& settings) { settings.sampling = scene::SubsurfaceSampling::exponential_disk; }); },
        1e3);  // fireflies are what the other density is for
}

}  // namespace bruma::measure

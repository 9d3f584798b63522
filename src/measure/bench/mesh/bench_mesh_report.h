#pragma once
#include <filesystem>

#include "measure/bench/bench_table.h"
#include "measure/bench/mesh/bench_mesh.h"

namespace bruma::measure {

std::string_view words_of(scene::SubsurfaceModel model);

/// All rows of a scene.
BenchTable table_of(const MeshBenchScene& scene);
BenchTable table_of(const std::vector<MeshCombination>& combinations);
BenchTable table_of(const std::vector<SamplingNoise>& noise);
BenchTable table_of(const std::vector<SamplingRace>& races);

/// A page with plots, findings and the tables; complete in itself.
std::string page_of(const MeshBench& bench);

/// mesh.csv, mesh_sampling.csv, mesh.json and mesh.html in a folder, which is made if need be; each appears whole or
/// not at all.
void write_mesh_bench(const MeshBench& bench, const std::filesystem::path& folder);

/// Of one model the row of the most maps, texels and passes; null if there is none.
const MeshBenchRow* finest_row(const MeshBenchScene& scene, scene::SubsurfaceModel model);

/// How near the finest setting comes to quadrature of the same model, and what a sixteenth of the points gives.
std::string finding_quadrature(const MeshBenchScene& scene);
/// What the maps themselves add, once noise is gone.
std::string finding_maps(const MeshBenchScene& scene);
/// How near each model comes to photons.
std::string finding_walk(const MeshBenchScene& scene);
std::string finding_combination(const MeshBenchScene& scene);
/// Times fewer evaluations on the lit side, or behind, in double precision; and whether that is what was wanted.
std::string finding_noise(const std::vector<SamplingNoise>& noise, const std::string& material, bool is_lit);
std::string finding_race(const SamplingRace& race);

}  // namespace bruma::measure

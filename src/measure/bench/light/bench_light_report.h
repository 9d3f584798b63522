#pragma once
#include <filesystem>
#include <string>

#include "measure/bench/bench_table.h"
#include "measure/bench/light/bench_light.h"

namespace bruma::measure {

/// All rows of a scene.
BenchTable table_of(const LightBenchScene& scene);
std::string csv_of(const LightBench& bench);
std::string json_of(const LightBench& bench);
/// A page with plots, findings and the tables; complete in itself.
std::string page_of(const LightBench& bench);

/// light.csv, light.json and light.html in a folder, which is made if need be; each appears whole or not at all.
void write_light_bench(const LightBench& bench, const std::filesystem::path& folder);

/// The row of a way at a resolution; null if it was not measured.
const LightBenchRow* row_of(const LightBenchScene& scene, LightProvider provider, scene::LightResolution resolution,
                            std::int64_t near_steps);

/// 'direct light at half resolution is 0.012 (RMSE) from single scattering, within 0.02', or what is true instead.
std::string finding_single(const LightBenchScene& scene);
/// Which way comes nearest to all of the light, and what part single scattering leaves out.
std::string finding_multiple(const LightBenchScene& scene);
std::string finding_cost(const LightBenchScene& scene);
std::string finding_build(const LightBuildRow& row);
std::string finding_batches(const LightBench& bench);

}  // namespace bruma::measure

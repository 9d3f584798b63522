#pragma once
#include <filesystem>
#include <string>

#include "measure/bench/volume/bench_volume.h"

namespace bruma::measure {

std::string csv_of(const VolumeBench& bench);
std::string json_of(const VolumeBench& bench);
/// A page with plots, findings and the table; complete in itself.
std::string page_of(const VolumeBench& bench);

/// volume.csv, volume.json and volume.html in a folder, which is made if need be; each appears whole or not at all.
void write_volume_bench(const VolumeBench& bench, const std::filesystem::path& folder);

}  // namespace bruma::measure

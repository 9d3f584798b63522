#pragma once
#include "gl/shader_library.h"
#include "measure/bench/light/bench_light.h"

/// Private to the bench of light.
namespace bruma::measure {

/// Sweeps of small grids over the data of one scene, in launches of one slice, of several, and as the program chooses.
std::vector<LightBatchRow> measure_batches(gl::ShaderLibrary& shaders, const BenchScene& scene,
                                           const LightBenchOptions& options);

/// Building the usual light volume of every scene that is lit from afar, with its transfer function and with one that
/// is nearly opaque.
std::vector<LightBuildRow> measure_builds(gl::ShaderLibrary& shaders, const std::vector<BenchScene>& scenes,
                                          const LightBenchOptions& options);

}  // namespace bruma::measure

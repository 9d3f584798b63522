#pragma once
#include "scene/volume/transfer_function.h"
#include "scene/volume/volume_grid.h"

/// Transfer functions for volumes whose user has not chosen one. Private to `suggested_transfer_function`.
namespace bruma::scene {

/// Hand-made ones, for the builtin volumes; opacities are per voxel of 1 mm.
TransferFunction engine_transfer_function();
TransferFunction bucky_transfer_function();
TransferFunction hydrogen_transfer_function();
TransferFunction knot_transfer_function();
TransferFunction blobs_transfer_function();
TransferFunction marschner_lobb_transfer_function();
TransferFunction marschner_lobb_256_transfer_function();
TransferFunction sphere_transfer_function();
TransferFunction cube_transfer_function();

/// From the histogram alone: air is transparent, then what is soft, a cool veil, then what is dense, warm and firm.
/// The data split into three classes by two thresholds: the upper end of the background's peak, and Otsu's threshold
/// (A threshold selection method from gray-level histograms, 1979) among the values above it.
TransferFunction transfer_function_of_histogram(const VolumeGrid& grid);

}  // namespace bruma::scene

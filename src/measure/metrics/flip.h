#pragma once
#include <vector>

#include "base/image.h"

/// The difference that a person sees when two pictures are shown in turn at one place.
///
/// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild: FLIP: A Difference Evaluator for Alternating
/// Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020; the variant for pictures of display range [0, 1].
/// The paper starts from sRGB and undoes its curve first; our pictures are linear already, and only clamped to [0, 1]
/// as the display would.
namespace bruma::measure {

/// A screen of 0.7 m width and 3840 pixels seen from 0.7 m, as in the paper.
constexpr double flip_pixels_per_degree = 67.0;

/// One value in [0, 1] per pixel, row by row: 0 means no visible difference. Pixels that are not finite count as 1.
/// Throws InputError for pictures of different size.
std::vector<float> flip_map(const Image& a, const Image& reference, double pixels_per_degree = flip_pixels_per_degree);

/// Mean of the map.
double mean_flip(const Image& a, const Image& reference, double pixels_per_degree = flip_pixels_per_degree);

}  // namespace bruma::measure

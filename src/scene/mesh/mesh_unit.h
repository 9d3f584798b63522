#pragma once
#include <string>
#include <string_view>

namespace bruma::scene {

/// How long a unit of a mesh file is, and who says so.
struct UnitLength {
    double millimetres = 1.0;
    std::string from;  ///< "the scene", "a comment of the file", or why it is proposed
    bool is_proposed = false;
};

/// A proposal for a file that tells nothing, from the longest side of the box around the mesh in units. From about 10
/// to 2000, from a ring to a person, the numbers are plausible millimetres and are taken for these. Else the power of
/// ten that makes it 32 to 316 mm: a thing for the hand, the size at which the materials of scene/subsurface/material.h
/// look translucent.
UnitLength proposed_unit(double longest_side);

/// The unit that a comment at the head of a file names, as in "# File units = centimeters"; 0 when there is none.
double commented_unit_mm(std::string_view head);

}  // namespace bruma::scene

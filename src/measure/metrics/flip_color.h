#pragma once
#include <glm/glm.hpp>

namespace bruma::measure {

/// Linear Rec.709 to YCxCz, the opponent space of FLIP: Y in [-16, 100], Cx red-green, Cz yellow-blue.
glm::dvec3 ycxcz_of_rgb(glm::dvec3 rgb);
glm::dvec3 rgb_of_ycxcz(glm::dvec3 ycxcz);

/// Linear Rec.709 to CIE L*a*b* with the white of the display.
glm::dvec3 lab_of_rgb(glm::dvec3 rgb);

/// The same with chroma lowered in the dark, after Hunt: a and b times 0.01 L.
glm::dvec3 hunt_lab_of_rgb(glm::dvec3 rgb);

/// Distance for large colour differences (Abasi, Tehran, Fairchild 2020): |dL| + sqrt(da^2 + db^2).
double hyab(glm::dvec3 lab_a, glm::dvec3 lab_b);

}  // namespace bruma::measure

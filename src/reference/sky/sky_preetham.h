#pragma once
#include <glm/glm.hpp>

namespace bruma::reference {

/// The fit of Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight", as luminance Y in kcd/m2 and
/// chromaticity x, y. From the ground, sun above the horizon, turbidity from 2 on: below that it turns negative.
glm::dvec3 preetham_zenith_Yxy(double turbidity, double sun_zenith_angle);
/// Angles in radians: of the view and of the sun from the zenith, and `gamma` between view and sun.
glm::dvec3 preetham_Yxy(double turbidity, double view_zenith_angle, double sun_zenith_angle, double gamma);
/// Linear Rec.709, in the unit of Y.
glm::dvec3 rec709_from_Yxy(const glm::dvec3& Yxy);

}  // namespace bruma::reference

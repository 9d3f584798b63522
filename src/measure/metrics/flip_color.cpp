#include "measure/metrics/flip_color.h"

#include <cmath>

namespace bruma::measure {
namespace {

/// Columns are the primaries of Rec.709 with white D65 (IEC 61966-2-1), in XYZ with Y of white 1.
const glm::dmat3 xyz_from_rgb{{0.4123907992659595, 0.2126390058715104, 0.0193308187155918},
                              {0.3575843393838780, 0.7151686787677559, 0.1191947797946259},
                              {0.1804807884018343, 0.0721923153607337, 0.9505321522496608}};
const glm::dmat3 rgb_from_xyz = glm::inverse(xyz_from_rgb);
const glm::dvec3 white_xyz = xyz_from_rgb * glm::dvec3(1.0);

double lab_curve(double t) {
    constexpr double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

}  // namespace

glm::dvec3 ycxcz_of_rgb(glm::dvec3 rgb) {
    const glm::dvec3 xyz = xyz_from_rgb * rgb / white_xyz;
    return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

glm::dvec3 rgb_of_ycxcz(glm::dvec3 ycxcz) {
    const double y = (ycxcz.x + 16.0) / 116.0;
    return rgb_from_xyz * (glm::dvec3(y + ycxcz.y / 500.0, y, y - ycxcz.z / 200.0) * white_xyz);
}

glm::dvec3 lab_of_rgb(glm::dvec3 rgb) {
    const glm::dvec3 xyz = xyz_from_rgb * rgb / white_xyz;
    const double x = lab_curve(xyz.x);
    const double y = lab_curve(xyz.y);
    const double z = lab_curve(xyz.z);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

glm::dvec3 hunt_lab_of_rgb(glm::dvec3 rgb) {
    const glm::dvec3 lab = lab_of_rgb(rgb);
    return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

double hyab(glm::dvec3 lab_a, glm::dvec3 lab_b) {
    const glm::dvec3 d = lab_a - lab_b;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

}  // namespace bruma::measure

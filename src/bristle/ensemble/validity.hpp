#pragma once

#include "bristle/ensemble/point.hpp"

#include <array>

namespace bristle {

// Tells whether a point is beyond a limit within which the model describes bristles. unknown: the point has
// no values.
enum class Exceeds {
  no,
  yes,
  unknown
};
template <>
inline Words words<Exceeds>() {
  static constexpr const char* list[] = {"no", "yes", "unknown"};
  return list;
}

// A limit of the model. The flag in result files and the remarks of `run` and of figures follow from its row.
struct ValidityRow {
  const char *name, *meaning;            // name of the flag; what is wrong beyond the limit, in words
  double (*excess)(const PointResult&);  // positive beyond the limit, in the unit of the limited quantity
};

// Axial force over Euler's load beyond which the friction of a linear radial spring is not the friction of a
// shaft that bends: R_x_norm is wrong by 17 % between 2 and 4, and by 74 % between 4 and 8, in the median of
// brushes whose bristles were computed as elastic rods, too (docs/limitations.md).
constexpr double kBucklingFactor = 4;

// Each limit is compared with the mean over the bristles.
inline constexpr std::array kValidity = {
    // By Hertz, the contact radius is pi p R_c/(2 E*) under the largest pressure p.
    ValidityRow{"exceeds_R_c", "contact larger than the tip",
                [](const PointResult& p) {
                  return M_PI * p.value[observable("hertz_pressure_peak")] / (2 * p.parameters.E_star) - 1;
                }},
    ValidityRow{
        "exceeds_spacing", "tips travel farther than the spacing",
        [](const PointResult& p) { return p.value[observable("tip_travel")] - p.parameters.spacing; }},
    ValidityRow{
        "exceeds_strain_limit", "strain at the root above strain_limit",
        [](const PointResult& p) { return p.value[observable("root_strain")] - p.parameters.strain_limit; }},
    ValidityRow{"exceeds_stretch_limit", "elongation above stretch_limit",
                [](const PointResult& p) {
                  return p.value[observable("stretch_peak")] - p.parameters.stretch_limit;
                }},
    ValidityRow{"exceeds_pressure_limit", "contact pressure above pressure_limit",
                [](const PointResult& p) {
                  return p.value[observable("hertz_pressure_peak")] - p.parameters.pressure_limit;
                }},
    ValidityRow{
        "exceeds_buckling", "axial force above 4 times Euler's buckling load",
        [](const PointResult& p) { return p.value[observable("axial_over_euler")] - kBucklingFactor; }},
    ValidityRow{"exceeds_load", "friction above the load",
                [](const PointResult& p) { return std::abs(p.value[R_X]) - p.value[R_N]; }},
};

Exceeds exceeds(const ValidityRow& row, const PointResult& point);

}  // namespace bristle

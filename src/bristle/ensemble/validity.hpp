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
    ValidityRow{"exceeds_load", "friction above the load",
                [](const PointResult& p) { return std::abs(p.value[R_X]) - p.value[R_N]; }},
};

Exceeds exceeds(const ValidityRow& row, const PointResult& point);

}  // namespace bristle

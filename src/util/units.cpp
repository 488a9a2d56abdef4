#include "util/units.hpp"

#include <cmath>

namespace bristle {
namespace {

struct UnitRow {
  const char* units;
  double from, to;  // the values, as magnitudes, that are read in this unit
  ReadableUnit unit;
};

const UnitRow kReadable[] = {
    {"Pa", 1e3, 1e6, {"kPa", 1e3}},      {"Pa", 1e6, 1e9, {"MPa", 1e6}},  {"Pa", 1e9, 1e13, {"GPa", 1e9}},
    {"N", 1e-8, 1e-4, {"uN", 1e-6}},     {"N", 1e-4, 0.1, {"mN", 1e-3}},  {"m", 1e-5, 1, {"mm", 1e-3}},
    {"kg", 1e-8, 1e-5, {"mg", 1e-6}},    {"kg", 1e-5, 1e-2, {"g", 1e-3}}, {"degree", 0, 1e9, {"degrees", 1}},
    {"m-2", 0, 1e12, {"per cm^2", 1e4}}, {"1", 0, 1e300, {"", 1}}};

}  // namespace

ReadableUnit readable_unit(const std::string& units, double value) {
  for (const UnitRow& row : kReadable)
    if (units == row.units && row.from <= std::abs(value) && std::abs(value) < row.to) return row.unit;
  return {units, 1};
}

std::string without_unit(const std::string& key, const std::string& units) {
  std::string suffix = "_";
  for (const char c : units == "degree" ? "deg" : units) {
    if (c == '/') suffix += "_per_";
    else if (c == ' ') suffix += '_';
    else if (c != '^') suffix += c;
  }
  return key.ends_with(suffix) ? key.substr(0, key.size() - suffix.size()) : key;
}

}  // namespace bristle

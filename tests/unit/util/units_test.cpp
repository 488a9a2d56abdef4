// Units and keys as people read them.
#include "util/units.hpp"

#include "catch.hpp"

namespace bristle::units_test {
namespace {

std::pair<std::string, double> unit(const std::string& units, double value) {
  const ReadableUnit found = readable_unit(units, value);
  return {found.name, found.size};
}

}  // namespace

TEST_CASE("units: a value for people has a unit of its size") {
  using Pair = std::pair<std::string, double>;
  CHECK(unit("m", 0.00105) == Pair("mm", 1e-3));
  CHECK(unit("m", -0.00105) == Pair("mm", 1e-3));
  CHECK(unit("m", 2) == Pair("m", 1));
  CHECK(unit("Pa", 5e7) == Pair("MPa", 1e6));
  CHECK(unit("kg", 1e-4) == Pair("g", 1e-3));
  CHECK(unit("degree", 80) == Pair("degrees", 1));
  CHECK(unit("N/m", 1000) == Pair("N/m", 1));
}

TEST_CASE("units: a key for people is without its unit") {
  CHECK(without_unit("R_m", "m") == "R");
  CHECK(without_unit("V0_m_per_s", "m/s") == "V0");
  CHECK(without_unit("rho_kg_per_m3", "kg/m^3") == "rho");
  CHECK(without_unit("phi_0_deg", "degree") == "phi_0");
  CHECK(without_unit("k_r", "1") == "k_r");
  CHECK(without_unit("spacing", "m") == "spacing");
}

}  // namespace bristle::units_test

#pragma once

#include "bristle/model/friction/coulomb.hpp"
#include "bristle/model/friction/custom.hpp"
#include "bristle/model/friction/nss.hpp"
#include "bristle/model/friction/stribeck.hpp"

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

namespace bristle {

// The registered friction laws, in the order of FrictionLaw. Experiments select a law by Law::name. A law is
//   F_f = factor modulation(V_R/V_scale) load(F_n)
// where modulation tends to 1 at speeds far above V_scale (not for "custom") and factor is
// proportional to the parameter strength. rigid() is the friction force of rigid bristles
// (docs/extending.md).
using FrictionLaws = std::tuple<Nss, Coulomb, Stribeck, Custom>;
enum class FrictionLaw : int {
  nss,
  coulomb,
  stribeck,
  custom,
  count
};
static_assert(std::tuple_size_v<FrictionLaws> == std::size_t(FrictionLaw::count));

// Calls visit(Law()) with the type of this law.
template <std::size_t I = 0, class Visit>
decltype(auto) with_law(FrictionLaw law, const Visit& visit) {
  if constexpr (I + 1 < std::tuple_size_v<FrictionLaws>)
    if (std::size_t(law) != I) return with_law<I + 1>(law, visit);
  return visit(std::tuple_element_t<I, FrictionLaws>());
}

template <>
inline Words words<FrictionLaw>() {
  static constexpr auto list =
      std::apply([](auto... law) { return std::array{decltype(law)::name...}; }, FrictionLaws());
  return list;
}

// Returns the modulation of the friction law of p at the sliding speed V_R, dimensionless.
inline double modulation(const Parameters& p, double V_R) {
  return with_law(p.friction,
                  [&](auto law) { return law.modulation(V_R / law.V_scale(p), law.constants(p)); });
}

}  // namespace bristle

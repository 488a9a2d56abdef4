#pragma once

#include "model/friction/table.hpp"
#include "simd/lanes.hpp"

#include <cstring>

namespace bristle::HWY_NAMESPACE {

// The modulation of friction at the speed V_R, by a table.
struct Modulation {
  Lanes value, secant, slope;  // secant: value/V_R, also at V_R = 0; slope: derivative by V_R
};

inline Modulation modulation_at(const ModulationTable& table, const Lanes& V_R) {
  const hn::RebindToSigned<Lanes::D> integers;
  const Lanes intervals = double(table.intervals()), V_s = table.V_s();
  const Lanes inverse = 1.0 / (V_R + V_s);
  const Lanes t = V_R * inverse, scaled = t * intervals;
  // A state that is not finite uses the first interval; its step is rejected.
  const auto index = hn::ConvertTo(integers, hn::IfThenElseZero(hn::Le(scaled.v, intervals.v), scaled.v));
  const Lanes u = scaled - Lanes(hn::ConvertTo(Lanes::tag, index));
  // Copying and transposing the coefficients is faster than gathering them.
  alignas(64) std::int64_t interval[Lanes::kWidth];
  alignas(64) double copied[4 * Lanes::kWidth];
  hn::Store(index, integers, interval);
  for (int i = 0; i < Lanes::kWidth; ++i)
    std::memcpy(copied + std::ptrdiff_t(4) * i, table.coefficients() + 4 * interval[i], 4 * sizeof(double));
  hn::Vec<Lanes::D> c_0, c_1, c_2, c_3;
  hn::LoadInterleaved4(Lanes::tag, copied, c_0, c_1, c_2, c_3);
  const Lanes c[4] = {c_0, c_1, c_2, c_3};
  const Lanes q = c[0] + u * Lanes(c[1] + u * Lanes(c[2] + u * c[3]));
  const Lanes dq = intervals * Lanes(c[1] + u * Lanes(2.0 * c[2] + u * Lanes(3.0 * c[3])));
  return {t * q, q * inverse, Lanes(q + t * dq) * Lanes(V_s * Lanes(inverse * inverse))};
}

}  // namespace bristle::HWY_NAMESPACE

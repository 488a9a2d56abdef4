#pragma once

#include "bristle/model/friction/table.hpp"
#include "bristle/simd/lanes.hpp"

#include <cstring>

namespace bristle::HWY_NAMESPACE {

// The modulation of friction at one speed V_R, by a table.
struct Modulation {
  Lanes value, secant, slope;  // secant: value/V_R, also at V_R = 0; slope: derivative by V_R
};

// The interval of the table at one speed. Loading what has just been stored in other portions is slow:
// computations between look_up() and modulation_of() hide that.
struct TableEntry {
  Lanes t, inverse, position;  // inverse is 1/(V_R + V_scale); position in the interval
  alignas(64) double coefficients[4 * Lanes::kWidth];  // of one lane after the other
};

inline void look_up(const ModulationTable& table, Lanes V_R, Lanes V_scale, TableEntry& out) {
  const hn::RebindToSigned<Lanes::D> integers;
  const Lanes intervals = table.intervals();
  out.inverse = 1.0 / (V_R + V_scale);
  out.t = V_R * out.inverse;
  const Lanes scaled = out.t * intervals;
  // A state that is not finite uses the first interval; its step is rejected.
  const auto index = hn::ConvertTo(integers, hn::IfThenElseZero(hn::Le(scaled.v, intervals.v), scaled.v));
  out.position = scaled - Lanes(hn::ConvertTo(Lanes::tag, index));
  alignas(64) std::int64_t interval[Lanes::kWidth];
  hn::Store(index, integers, interval);
  // Copying and transposing the coefficients is faster than gathering them, and a vector that has been stored
  // as a whole is loaded faster than one stored in two portions.
  const auto row = [&](int i) { return table.coefficients() + 4 * interval[i]; };
#if HWY_TARGET == HWY_AVX3
  const hn::Half<Lanes::D> half;
  for (int i = 0; i < Lanes::kWidth; i += 2)
    hn::Store(hn::Combine(Lanes::tag, hn::LoadU(half, row(i + 1)), hn::LoadU(half, row(i))), Lanes::tag,
              out.coefficients + std::ptrdiff_t(4) * i);
#else
  for (int i = 0; i < Lanes::kWidth; ++i)
    std::memcpy(out.coefficients + std::ptrdiff_t(4) * i, row(i), 4 * sizeof(double));
#endif
}

inline Modulation modulation_of(const ModulationTable& table, Lanes V_scale, const TableEntry& at) {
  hn::Vec<Lanes::D> c_0, c_1, c_2, c_3;
  hn::LoadInterleaved4(Lanes::tag, at.coefficients, c_0, c_1, c_2, c_3);
  const Lanes x = at.position, c0 = c_0, c1 = c_1, c2 = c_2, c3 = c_3;
  const Lanes q = c0 + x * Lanes(c1 + x * Lanes(c2 + x * c3));
  const Lanes dq = table.intervals() * Lanes(c1 + x * Lanes(2.0 * c2 + x * Lanes(3.0 * c3)));
  return {at.t * q, q * at.inverse, Lanes(q + at.t * dq) * Lanes(V_scale * Lanes(at.inverse * at.inverse))};
}

}  // namespace bristle::HWY_NAMESPACE

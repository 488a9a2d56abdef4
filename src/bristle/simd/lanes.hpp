#pragma once

// To be included only by sources that are compiled once per
// instruction set: the namespace has the name of the instruction set.
#include "bristle/model/elementary.hpp"

#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR
#include <cmath>

// Highway rounds the product here, unlike everywhere else. These are preferred to its templates, also by its
// elementary functions. std::fma is exact on every processor.
namespace hwy::HWY_NAMESPACE {
inline Vec1<double> MulAdd(Vec1<double> a, Vec1<double> b, Vec1<double> c) {
  return Vec1<double>(std::fma(a.raw, b.raw, c.raw));
}
inline Vec1<double> MulSub(Vec1<double> a, Vec1<double> b, Vec1<double> c) {
  return Vec1<double>(std::fma(a.raw, b.raw, -c.raw));
}
inline Vec1<double> NegMulAdd(Vec1<double> a, Vec1<double> b, Vec1<double> c) {
  return Vec1<double>(std::fma(-a.raw, b.raw, c.raw));
}
inline Vec1<double> NegMulSub(Vec1<double> a, Vec1<double> b, Vec1<double> c) {
  return Vec1<double>(std::fma(-a.raw, b.raw, -c.raw));
}
}  // namespace hwy::HWY_NAMESPACE
#endif

#include <hwy/contrib/math/math-inl.h>

namespace bristle::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A number type for the equations with one bristle per lane: a vector. A product has its own type, so that
// adding to it is one fused multiply-add, whatever the compiler does. Every operation gives the same bits on
// every instruction set.
class Lanes {
 public:
  using D = hn::CappedTag<double, 8>;
  static constexpr D tag{};
  static constexpr int kWidth = int(hn::MaxLanes(tag));

  struct Product;
  struct Mask;

  Lanes() = default;
  // Converts implicitly, like built-in numbers.
  Lanes(double value) : v(hn::Set(tag, value)) {}
  Lanes(hn::Vec<D> vector) : v(vector) {}
  Lanes(const Product& p);

  static Lanes load(const double* from) { return hn::Load(tag, from); }
  void store(double* to) const { hn::Store(v, tag, to); }

  friend Lanes operator-(Lanes a) { return hn::Neg(a.v); }
  friend Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
  friend Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
  friend Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.v, b.v); }
  template <class Other>
  Lanes& operator+=(const Other& o) {
    return *this = *this + o;
  }
  template <class Other>
  Lanes& operator-=(const Other& o) {
    return *this = *this - o;
  }

  hn::Vec<D> v;
};

struct Lanes::Product {
  Lanes a, b;
};

inline Lanes::Lanes(const Product& p) : v(hn::Mul(p.a.v, p.b.v)) {}

inline Lanes::Product operator*(Lanes a, Lanes b) { return {a, b}; }

inline Lanes operator+(const Lanes::Product& p, Lanes c) { return hn::MulAdd(p.a.v, p.b.v, c.v); }
inline Lanes operator-(const Lanes::Product& p, Lanes c) { return hn::MulSub(p.a.v, p.b.v, c.v); }
inline Lanes operator-(Lanes c, const Lanes::Product& p) { return hn::NegMulAdd(p.a.v, p.b.v, c.v); }
inline Lanes operator+(Lanes c, const Lanes::Product& p) { return p + c; }
inline Lanes operator+(const Lanes::Product& p, const Lanes::Product& q) { return p + Lanes(q); }
inline Lanes operator-(const Lanes::Product& p, const Lanes::Product& q) { return Lanes(p) - q; }

// One truth value per lane.
struct Lanes::Mask {
  hn::Mask<D> m;

  friend Mask operator&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
  friend Mask operator|(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
  friend Mask operator!(Mask a) { return {hn::Not(a.m)}; }
  // Returns the mask with lane i as bit i.
  std::uint32_t bits() const {
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(tag, m, byte);
    return byte[0];
  }
};

inline Lanes::Mask operator<(Lanes a, Lanes b) { return {hn::Lt(a.v, b.v)}; }
inline Lanes::Mask operator>=(Lanes a, Lanes b) { return {hn::Ge(a.v, b.v)}; }
inline Lanes select(Lanes::Mask m, Lanes yes, Lanes no) { return hn::IfThenElse(m.m, yes.v, no.v); }
inline Lanes min(Lanes a, Lanes b) { return select(a < b, a, b); }
inline Lanes max(Lanes a, Lanes b) { return select(a < b, b, a); }
inline Lanes abs(Lanes x) { return hn::Abs(x.v); }

// Returns exp(x) for x <= 0; 0 below kNegligible. A vector with only such lanes skips the exponential.
inline Lanes decay(Lanes x) {
  const auto not_negligible = hn::Ge(x.v, hn::Set(Lanes::tag, kNegligible));
  if (hn::AllFalse(Lanes::tag, not_negligible)) return 0.0;
  return hn::IfThenElseZero(not_negligible, hn::Exp(Lanes::tag, x.v));
}

// Returns 1/sqrt(x), from a first guess by the exponent (error 3 %), by an iteration of order 4 and one of
// order 3: only rounding errors remain. Much cheaper than a square root and a division, and, unlike the
// processors' own estimates, the same on every processor.
inline Lanes inverse_sqrt(Lanes x) {
  const hn::RebindToSigned<Lanes::D> integers;
  const auto magic = hn::Set(integers, 0x5FE6EB50C7B537A9);
  Lanes y = hn::BitCast(Lanes::tag, hn::Sub(magic, hn::ShiftRight<1>(hn::BitCast(integers, x.v))));
  const Lanes first = 1.0 - x * Lanes(y * y);
  y = y + Lanes(y * first) * Lanes(0.5 + first * Lanes(0.375 + 0.3125 * first));
  const Lanes second = 1.0 - x * Lanes(y * y);
  return y + Lanes(y * second) * Lanes(0.5 + 0.375 * second);
}

}  // namespace bristle::HWY_NAMESPACE

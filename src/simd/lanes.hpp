#pragma once

// To be included only by sources that are compiled once per
// instruction set: the namespace has the name of the instruction set.
#include "model/number.hpp"

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

#include <Eigen/Core>

namespace bristle::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A number type for the equations with one bristle per lane. It consists of two vectors, so that the latency
// of one overlaps with operations on the other. A product has its own type, so that adding to it is one fused
// multiply-add, whatever the compiler does. Every operation gives the same bits on every instruction set.
class Lanes {
 public:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using Flags = hn::Mask<D>;
  static constexpr D tag{};
  static constexpr int kVectors = 2;
  static constexpr int kWidth = int(hn::MaxLanes(tag));
  static constexpr int kSize = kVectors * kWidth;  // numbers in one Lanes

  struct Product;
  struct Mask;

  Lanes() = default;
  // Converts implicitly, like built-in numbers.
  Lanes(double value) : Lanes(make([&](int) { return hn::Set(tag, value); })) {}
  Lanes(const Product& p);

  static Lanes load(const double* from) {
    return make([&](int i) { return hn::Load(tag, from + std::ptrdiff_t(i) * kWidth); });
  }
  void store(double* to) const {
    for (int i = 0; i < kVectors; ++i) hn::Store(v[i], tag, to + std::ptrdiff_t(i) * kWidth);
  }

  template <class F>
  static Lanes make(F f) {
    Lanes out;
    for (int i = 0; i < kVectors; ++i) out.v[i] = f(i);
    return out;
  }

  friend Lanes operator-(const Lanes& a) {
    return make([&](int i) { return hn::Neg(a.v[i]); });
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return make([&](int i) { return hn::Add(a.v[i], b.v[i]); });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return make([&](int i) { return hn::Sub(a.v[i], b.v[i]); });
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return make([&](int i) { return hn::Div(a.v[i], b.v[i]); });
  }
  template <class Other>
  Lanes& operator+=(const Other& o) {
    return *this = *this + o;
  }
  template <class Other>
  Lanes& operator-=(const Other& o) {
    return *this = *this - o;
  }
  Lanes& operator*=(const Lanes& o);

  V v[kVectors];
};

struct Lanes::Product {
  Lanes a, b;
};

inline Lanes::Lanes(const Product& p) : Lanes(make([&](int i) { return hn::Mul(p.a.v[i], p.b.v[i]); })) {}

inline Lanes::Product operator*(const Lanes& a, const Lanes& b) { return {a, b}; }
inline Lanes& Lanes::operator*=(const Lanes& o) { return *this = *this * o; }

inline Lanes operator+(const Lanes::Product& p, const Lanes& c) {
  return Lanes::make([&](int i) { return hn::MulAdd(p.a.v[i], p.b.v[i], c.v[i]); });
}
inline Lanes operator-(const Lanes::Product& p, const Lanes& c) {
  return Lanes::make([&](int i) { return hn::MulSub(p.a.v[i], p.b.v[i], c.v[i]); });
}
inline Lanes operator-(const Lanes& c, const Lanes::Product& p) {
  return Lanes::make([&](int i) { return hn::NegMulAdd(p.a.v[i], p.b.v[i], c.v[i]); });
}
inline Lanes operator+(const Lanes& c, const Lanes::Product& p) { return p + c; }
inline Lanes operator+(const Lanes::Product& p, const Lanes::Product& q) { return p + Lanes(q); }
inline Lanes operator-(const Lanes::Product& p, const Lanes::Product& q) { return Lanes(p) - q; }

// One truth value per lane.
struct Lanes::Mask {
  Flags m[kVectors];

  template <class F>
  static Mask make(F f) {
    Mask out;
    for (int i = 0; i < kVectors; ++i) out.m[i] = f(i);
    return out;
  }
  friend Mask operator&(const Mask& a, const Mask& b) {
    return make([&](int i) { return hn::And(a.m[i], b.m[i]); });
  }
  friend Mask operator|(const Mask& a, const Mask& b) {
    return make([&](int i) { return hn::Or(a.m[i], b.m[i]); });
  }
  friend Mask operator!(const Mask& a) {
    return make([&](int i) { return hn::Not(a.m[i]); });
  }
  // Bit i is lane i.
  std::uint32_t bits() const {
    std::uint32_t out = 0;
    for (int i = 0; i < kVectors; ++i) {
      std::uint8_t byte[8] = {};
      hn::StoreMaskBits(tag, m[i], byte);
      out |= std::uint32_t(byte[0]) << (i * kWidth);
    }
    return out;
  }
};

inline Lanes::Mask operator<(const Lanes& a, const Lanes& b) {
  return Lanes::Mask::make([&](int i) { return hn::Lt(a.v[i], b.v[i]); });
}
inline Lanes::Mask operator>=(const Lanes& a, const Lanes& b) {
  return Lanes::Mask::make([&](int i) { return hn::Ge(a.v[i], b.v[i]); });
}
inline Lanes select(const Lanes::Mask& m, const Lanes& yes, const Lanes& no) {
  return Lanes::make([&](int i) { return hn::IfThenElse(m.m[i], yes.v[i], no.v[i]); });
}
inline Lanes min(const Lanes& a, const Lanes& b) { return select(a < b, a, b); }
inline Lanes max(const Lanes& a, const Lanes& b) { return select(a < b, b, a); }

inline Lanes abs(const Lanes& x) {
  return Lanes::make([&](int i) { return hn::Abs(x.v[i]); });
}
inline Lanes sin(const Lanes& x) {
  return Lanes::make([&](int i) { return hn::Sin(Lanes::tag, x.v[i]); });
}
inline Lanes cos(const Lanes& x) {
  return Lanes::make([&](int i) { return hn::Cos(Lanes::tag, x.v[i]); });
}
inline Lanes atan(const Lanes& x) {
  return Lanes::make([&](int i) { return hn::Atan(Lanes::tag, x.v[i]); });
}

// exp(x) for x <= 0; 0 below kNegligible. A vector with only such lanes skips the exponential.
inline Lanes decay(const Lanes& x) {
  return Lanes::make([&](int i) {
    const auto not_negligible = hn::Ge(x.v[i], hn::Set(Lanes::tag, kNegligible));
    if (hn::AllFalse(Lanes::tag, not_negligible)) return hn::Zero(Lanes::tag);
    return hn::IfThenElseZero(not_negligible, hn::Exp(Lanes::tag, x.v[i]));
  });
}

// Newton's iteration from a first guess by the exponent (error 3 %); after 4
// iterations only rounding errors remain. Much cheaper than a square root and a
// division, and, unlike the processors' own estimates, the same on every processor.
inline Lanes inverse_sqrt(const Lanes& x) {
  const hn::RebindToSigned<Lanes::D> integers;
  const auto magic = hn::Set(integers, 0x5FE6EB50C7B537A9);
  Lanes y = Lanes::make([&](int i) {
    return hn::BitCast(Lanes::tag, hn::Sub(magic, hn::ShiftRight<1>(hn::BitCast(integers, x.v[i]))));
  });
  const Lanes half = x * 0.5;
  for (int i = 0; i < 4; ++i) y *= 1.5 - half * Lanes(y * y);
  return y;
}

}  // namespace bristle::HWY_NAMESPACE

namespace Eigen {
template <>
struct NumTraits<bristle::HWY_NAMESPACE::Lanes> : GenericNumTraits<double> {
  using Real = bristle::HWY_NAMESPACE::Lanes;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum {
    RequireInitialization = 0
  };
};
}  // namespace Eigen

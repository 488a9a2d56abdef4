#include "bristle/simd/probe.hpp"

#include "bristle/dynamics/passage.hpp"
#include "bristle/simd/dispatch.hpp"
#include "bristle/simd/engine.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace bristle {
namespace {

// Returns the number, which the compiler then does not know.
double unknown(double number) {
  volatile double stored = number;
  return stored;
}

// Returns the sum of numbers that the compiler does not know. This and each following operation rounds
// otherwise, or is folded to a constant, under a flag that allows it.
double sum(double a, double b) { return unknown(a) + unknown(b); }
double product(double a, double b) { return unknown(a) * unknown(b); }
double product_and_sum(double a, double b, double c) { return unknown(a) * unknown(b) + unknown(c); }
double sum_and_difference(double a, double b) {
  const double large = unknown(a);
  return (large + unknown(b)) - large;
}
double product_and_quotient(double a, double b) {
  const double factor = unknown(b);
  return unknown(a) * factor / factor;
}
double sum_of_quotients(double a, double b, double c, double d) {
  const double divisor = unknown(d);
  return unknown(a) / divisor + unknown(b) / divisor + unknown(c) / divisor;
}
double is_nan(double a) { return std::isnan(unknown(a)) ? 1 : 0; }
double is_infinite(double a) { return unknown(a) > std::numeric_limits<double>::max() ? 1 : 0; }
double plus_zero(double a) { return unknown(a) + 0.0; }
double tenths(double a) { return unknown(a) * 0.1; }

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Returns the first of these operations whose bits differ from IEEE 754; empty if none does.
std::string wrong_operation() {
  const double a_tenth = std::bit_cast<double>(std::uint64_t(0x3FB999999999999A));
  const struct {
    const char* what;
    double computed, expected;
  } operations[] = {
      {"constants have single precision", tenths(1), a_tenth},
      {"sums are not rounded to the nearest number", sum(1, 0x1p-53), 1},
      {"sums are not rounded to the nearest number", sum(1, 0x1.8p-53), 0x1.0000000000001p0},
      {"subnormal numbers become zero", product(0x1p-1022, 0.5), 0x1p-1023},
      {"subnormal numbers become zero", product(0x1p-1074, 0x1p60), 0x1p-1014},
      {"a product and a sum are rounded once", product_and_sum(0x1.00000004p0, 0x1.fffffff8p-1, -1), 0},
      {"sums are reordered", sum_and_difference(0x1p53, 1), 0},
      {"numbers have more digits or a larger range than double precision", product_and_quotient(0x1p1023, 4),
       kInfinity},
      {"quotients are products with a reciprocal", sum_of_quotients(49, 98, 147, 49), 6},
      {"NaN is not noticed", is_nan(sum(kInfinity, -kInfinity)), 1},
      {"infinity is not noticed", is_infinite(product(0x1p1023, 4)), 1},
      {"the sign of zero is lost", plus_zero(-0.0), 0},
  };
  for (const auto& operation : operations)
    if (std::bit_cast<std::uint64_t>(operation.computed) != std::bit_cast<std::uint64_t>(operation.expected))
      return operation.what;
  return "";
}

// Returns the passage of a bristle that starts far from the pole, comes near it, and leaves the slab after
// 180 steps.
template <class Run>
Passage one_passage(const Run& run) {
  Parameters parameters;
  parameters.C = 0;  // its table of the modulation is the smallest
  parameters.phi_0 = 1.48;
  parameters.L_x = 0.1;
  const auto bristle = make_bristle(parameters, 0.8, 3.12);
  return run(PassageTask{
      &parameters, bristle, static_equilibrium(bristle), {1e-3, 1e-5, Method::automatic, 100'000}});
}

// Returns FNV-1a over the bits of the numbers, which do not depend on the order of bytes in memory.
std::uint64_t digest_of(const Passage& passage) {
  std::uint64_t digest = 0xcbf29ce484222325;
  const auto add = [&](double value) {
    digest = (digest ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3;
  };
  for (const double value : passage.end) add(value);
  for (const double value : {passage.contact_time, passage.gamma_1, passage.gamma_2, passage.gamma_3,
                             passage.energy_residual, double(passage.steps)})
    add(value);
  return digest;
}

// Returns what differs from every other build; empty if nothing does.
std::string difference() {
  if (const std::string operation = wrong_operation(); !operation.empty()) return operation;
  if (const Kernels& kernels = best_kernels(); passage_bits(kernels) != kPassageBits)
    return std::string("a passage has other bits with the instruction set ") + kernels.target;
  if (reference_passage_bits() != kReferencePassageBits)
    return "a passage of the reference engine has other bits";
  return "";
}

}  // namespace

std::uint64_t passage_bits(const Kernels& kernels) {
  return digest_of(one_passage([&](const PassageTask& task) {
    Passage passage;
    SimdEngine engine(kernels, [&](std::size_t, Passage&& ended) { passage = std::move(ended); });
    engine.submit(task, 0);
    while (engine.advance()) {
    }
    return passage;
  }));
}

std::uint64_t reference_passage_bits() {
  return digest_of(one_passage([](const PassageTask& task) { return run_passage(task); }));
}

void require_same_bits() {
  if (const std::string what = difference(); !what.empty())
    throw ArithmeticError(
        "this program does not compute the numbers of its version: " + what +
        "; build it without flags that change arithmetic, such as -ffast-math (CXXFLAGS, LDFLAGS), and "
        "run it without LD_PRELOAD; nothing was computed");
}

}  // namespace bristle

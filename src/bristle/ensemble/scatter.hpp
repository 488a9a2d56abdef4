#pragma once

#include "bristle/ensemble/observables.hpp"
#include "bristle/model/parameters.hpp"

#include <array>
#include <cstdint>
#include <vector>

// Scatter within a brush: its bristles differ from each other, and all meet the slab at the same gap
// (docs/model.md).
namespace bristle {

// A property in which the bristles of a brush may differ.
struct ScatteredProperty {
  const char *name, *symbol, *description;
};
inline constexpr std::array kScattered = {
    ScatteredProperty{"r0", "r_0", "length of the bristles"},
    ScatteredProperty{"R", "R", "radius of the shafts"},
    ScatteredProperty{"E", "E", "Young's modulus"},
    ScatteredProperty{"phi_0_deg", R"(\varphi_0)", "undeformed polar angle"},
};

// How one bristle deviates from the nominal one: a number for each row of kScattered, relative to its nominal
// value.
using Deviations = std::array<double, kScattered.size()>;

// How much the bristles of a brush differ.
struct Scatter {
  Deviations width{};  // standard deviation of each property, or its greatest deviation; 0: none
  std::array<bool, kScattered.size()> uniform{};  // otherwise normal
  long bristles = 16;                             // different bristles that stand for the brush; even

  // Returns whether any property scatters.
  bool any() const;
};

// Normal deviations are within this many standard deviations.
constexpr double kWidestDeviation = 5;
// Returns the largest deviation of a property, whose index in kScattered is given.
double reach(const Scatter& scatter, std::size_t property);

// Returns the deviations of scatter.bristles bristles that stand for the brush with equal weights: a Sobol
// sequence, with each point's mirror image next to it. Means over them are exact for polynomials of the
// third degree in each deviation alone.
std::vector<Deviations> representative_deviations(const Scatter& scatter);
// Returns the deviations of the bristle with this index. They depend on the seed and the index only.
Deviations random_deviations(const Scatter& scatter, std::uint64_t seed, std::uint64_t index);

// Returns the standard error of the mean of the values of representative_deviations(): the terms of the
// second degree in each deviation are exact, and the rest counts as random. Dimension as the values.
double scatter_error(const std::vector<Deviations>& at, const std::vector<double>& values);

// A bristle that deviates: its parameters, in units of its own length, time and force, and these units in
// units of the nominal bristle. Dimensionless.
struct DeviatingBristle {
  Parameters parameters;
  SiScales unit;
};

// Returns the bristle with these deviations. Its shaft has the stiffness and the mass that follow from
// length, radius and modulus: k_phi is E R^4/r_0, the ratios of the stiffnesses stay, and the mass is R^2
// r_0, each over the nominal value. What belongs to the slab and the contact stays: tau_f, mu_c, V_s, R_c,
// the wall, and the size of the slab.
DeviatingBristle deviating(const Parameters& nominal, const Deviations& by);

// Returns the unit of each observable of this bristle, in units of the nominal bristle.
ObservableArray units_of(const DeviatingBristle& bristle);

}  // namespace bristle

#include "bristle/ensemble/scatter.hpp"

#include "bristle/ensemble/normal_quantile.hpp"
#include "bristle/ensemble/sobol.hpp"
#include "bristle/random.hpp"

#include <cmath>
#include <numeric>

namespace bristle {
namespace {

// Indices of kScattered.
enum Property {
  LENGTH,
  RADIUS,
  MODULUS,
  ANGLE
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// Removes from `vector` its component along `unit`, a vector of length 1.
void project_out(std::vector<double>& vector, const std::vector<double>& unit) {
  const double component = dot(vector, unit);
  for (std::size_t i = 0; i < vector.size(); ++i) vector[i] -= component * unit[i];
}

}  // namespace

bool Scatter::any() const { return width != Deviations{}; }

double reach(const Scatter& scatter, std::size_t property) {
  return scatter.width[property] * (scatter.uniform[property] ? 1 : kWidestDeviation);
}

std::vector<Deviations> representative_deviations(const Scatter& scatter) {
  constexpr std::uint64_t seed = 0;
  const std::size_t pairs = std::size_t(scatter.bristles) / 2;
  std::vector<Deviations> out(2 * pairs, Deviations{});
  const auto points = sobol_points(pairs, kScattered.size(), seed);
  for (std::size_t property = 0; property < kScattered.size(); ++property) {
    if (scatter.width[property] == 0) continue;
    const bool uniform = scatter.uniform[property];
    double squares = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
      // Each of the intervals of the sequence has a point at a quarter of it, and a mirror image at three
      // quarters.
      const double interval = std::floor(points[i][property] * double(pairs));
      const double at = uniform ? 2 * (interval + 0.25) / double(pairs) - 1
                                : normal_quantile((interval + 0.25) / double(pairs));
      out[2 * i][property] = at;
      squares += at * at / double(pairs);
    }
    const double variance = uniform ? 1. / 3 : 1;
    const double scale = scatter.width[property] * std::sqrt(variance / squares);
    for (std::size_t i = 0; i < pairs; ++i) {
      out[2 * i][property] *= scale;
      out[2 * i + 1][property] = -out[2 * i][property];
    }
  }
  return out;
}

Deviations random_deviations(const Scatter& scatter, std::uint64_t seed, std::uint64_t index) {
  constexpr double least_share = 2.9e-7;  // of the normal distribution, at kWidestDeviation
  Deviations out{};
  for (std::size_t property = 0; property < kScattered.size(); ++property) {
    const std::uint64_t bits = split_mix(split_mix(split_mix(seed) + index) - (property + 1));
    const double share = (double(bits >> 11) + 0.5) * 0x1p-53;
    const double at = scatter.uniform[property]
                          ? 2 * share - 1
                          : normal_quantile(least_share + (1 - 2 * least_share) * share);
    out[property] = scatter.width[property] * at;
  }
  return out;
}

double scatter_error(const std::vector<Deviations>& at, const std::vector<double>& values) {
  const std::size_t pairs = values.size() / 2;
  std::vector<double> rest(pairs);
  for (std::size_t i = 0; i < pairs; ++i) rest[i] = (values[2 * i] + values[2 * i + 1]) / 2;
  // Gram and Schmidt: the columns of a fit by least squares, made orthogonal one after the other.
  std::vector<std::vector<double>> basis;
  const auto fit = [&](std::vector<double> column) {
    for (const std::vector<double>& unit : basis) project_out(column, unit);
    const double length = std::sqrt(dot(column, column));
    if (length == 0) return;
    for (double& value : column) value /= length;
    project_out(rest, column);
    basis.push_back(std::move(column));
  };
  fit(std::vector<double>(pairs, 1.0));
  for (std::size_t property = 0; property < kScattered.size(); ++property) {
    std::vector<double> squares(pairs);
    for (std::size_t i = 0; i < pairs; ++i) squares[i] = at[2 * i][property] * at[2 * i][property];
    fit(std::move(squares));
  }
  return std::sqrt(dot(rest, rest) / double(pairs - basis.size()) / double(pairs));
}

DeviatingBristle deviating(const Parameters& nominal, const Deviations& by) {
  const double length = 1 + by[LENGTH], radius = 1 + by[RADIUS], modulus = 1 + by[MODULUS];
  const double mass = radius * radius * length;
  const double bending = modulus * radius * radius * radius * radius / length;  // torsional stiffness
  DeviatingBristle out{nominal, {.length = length, .velocity = 1, .energy = mass}};
  out.unit.force = mass / length;
  out.unit.stiffness = out.unit.force / length;
  out.unit.stress = out.unit.stiffness / length;
  Parameters& p = out.parameters;
  for (double* stiffness : {&p.k_r, &p.k_theta, &p.k_phi}) *stiffness *= bending / out.unit.energy;
  p.phi_0 *= 1 + by[ANGLE];
  p.E_star *= modulus / out.unit.stress;
  p.tau_f /= out.unit.stress;
  p.beta /= out.unit.energy;
  for (double* distance : {&p.R_c, &p.lambda_z, &p.L_x, &p.L_y, &p.spacing}) *distance /= length;
  p.R *= radius / length;
  return out;
}

ObservableArray units_of(const DeviatingBristle& bristle) {
  ObservableArray out;
  out.fill(1);
  for (Observable k = 0; k < kObservables.size(); ++k) {
    if (kObservables[k].si) out[k] = bristle.unit.*kObservables[k].si->scale;
    if (kObservables[k].unpinned != Unpinned::none) out[unpinned(k)] = out[k];
    if (kObservables[k].unpinned == Unpinned::contribution) out[pinned(k)] = out[k];
  }
  return out;
}

}  // namespace bristle

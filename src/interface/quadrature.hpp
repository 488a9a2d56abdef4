#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace bristle {

// Adaptive Gauss-Kronrod quadrature of several functions at once, for integrands that are smooth between
// jumps. A sample carries a label; where neighbouring labels differ there is a jump, which is located by
// bisecting on the label (one sample a step) and becomes a panel border.
template <std::size_t N>
struct Sample {
  std::array<double, N> value{};
  int label = 0;
  bool valid = true;  // false ends the quadrature: its result would mean nothing
};

template <std::size_t N>
struct QuadratureOptions {
  std::array<double, N> rtol{};  // per component; 0: not controlled
  std::array<int, N> scale{};    // component whose integral rtol refers to
  std::vector<double> edges;     // first panels: ascending, at least two
  // Enough is known of a component once its error is a quarter of its distance from this value: what
  // a root-finder or a scan asks for.
  std::optional<double> decide_about;
  long max_samples = 16000;
};

enum class QuadratureStatus {
  converged,
  not_converged,
  invalid
};

template <std::size_t N>
struct QuadratureResult {
  QuadratureStatus status = QuadratureStatus::converged;
  // error: root of the sum of squares over the panels and over the jumps' unknown places. A panel's is
  // |Kronrod - Gauss|, which can be small by accident where the integrand is rough, and not less than
  // the misfit between the samples and the polynomial through the Gauss nodes says (Gonnet 2010).
  std::array<double, N> integral{}, error{};
  std::vector<double> jumps;  // ascending
  long samples = 0;
};

// Nodes and weights on [-1, 1]; gauss_weight is 0 at the nodes that Kronrod added. interpolation[i][j] is the
// factor of the value at Gauss node j in the value, at node i, of the polynomial through the Gauss nodes.
struct KronrodRule {
  std::vector<double> node, weight, gauss_weight;
  std::vector<std::vector<double>> interpolation;
};

// The rule for a panel of this width: many nodes for wide panels, few for slivers. width in the
// integrand's own variable (rad).
const KronrodRule& kronrod_rule(double width);

template <std::size_t N>
class Quadrature {
 public:
  using Function = std::function<Sample<N>(double)>;

  Quadrature(const Function& f, const QuadratureOptions<N>& options) : f_(f), options_(options) {}

  QuadratureResult<N> integrate();

 private:
  struct Node {
    double at = 0;
    Sample<N> sample{};
  };
  struct Panel {
    double from, to;
    std::array<double, N> integral{}, error{};
    std::vector<Node> nodes;
  };
  using Change = std::pair<Node, Node>;  // neighbours with different labels

  Node evaluate(double at);
  Panel make_panel(double from, double to);
  void locate(Change change);
  void find_changes();
  static double place(const Change& jump) { return jump.first.at + (jump.second.at - jump.first.at) / 2; }
  static std::array<double, N> uncertainty(const Change& change);
  void sum();
  double allowed(std::size_t component) const;
  double severity(const std::array<double, N>& error) const;
  double lacking(std::array<double, N> error) const;
  std::optional<std::size_t> worse(const std::vector<Change>& changes, double& most) const;
  void refine_worst();

  const Function& f_;
  const QuadratureOptions<N>& options_;
  std::vector<Panel> panels_;    // ascending, adjoining
  std::vector<Change> jumps_;    // located: a panel border lies between the two
  std::vector<Change> changes_;  // not located
  std::array<Node, 2> ends_{};   // samples at the two ends of the range
  QuadratureResult<N> result_;
};

}  // namespace bristle

#include "interface/quadrature_impl.hpp"

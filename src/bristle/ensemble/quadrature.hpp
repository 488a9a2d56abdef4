#pragma once

#include "bristle/ensemble/observables.hpp"

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace bristle {

// Adaptive quadrature of several functions at once, for integrands that are smooth between jumps and
// expensive to evaluate. Samples are requested in batches and all of them are kept. A panel has 2, 3, 5 or 9
// equidistant nodes, including its ends. It is refined by nodes in the middle between its nodes; a panel of
// 17 nodes becomes two of 9. Each sample has a label. A difference between the labels of neighbours is a jump
// of the integrand, which is located by bisection on the label (one sample per step). Each batch refines all
// panels and jumps without which the goal cannot be met.
// Labels may also alternate at every scale. Each jump would then stand for many, so that neither the integral
// nor its error could be trusted. A range with such labels becomes one panel of equidistant nodes with a
// statistical error.
struct Sample {
  ObservableArray value{};
  int label = 0;
  bool sensitive = false;  // whether a small shift of the sample may change its label
  bool valid = true;       // false ends the quadrature: its result would be invalid
};

struct QuadratureGoal {
  ObservableArray rtol{};                       // per component; 0: not controlled
  std::array<Observable, OBSERVABLES> scale{};  // component to whose integral rtol is relative
  // Returns whether a panel from left to right is to be divided. Limits the distance between nodes.
  std::function<bool(double left, double right)> too_wide = [](double, double) { return false; };
  // If set, an error of a quarter of the distance between the integral and this value also suffices, as a
  // root-finder or a scan only needs to know on which side of it the integral lies.
  std::optional<double> threshold;
  // Maximum number of nodes of an alternating panel, whose error falls only with the square root of that
  // number. If its error is then still too large, the other panels are refined as if it had none, and the
  // quadrature ends as not converged.
  std::size_t most_alternating = 2048;
};

enum class QuadratureStatus {
  converged,
  not_converged,
  invalid
};

struct QuadratureResult {
  QuadratureStatus status = QuadratureStatus::converged;
  // error is the root of the sum of the squares of the errors of jumps and panels. Jumps: the uncertain
  // position counts by the spread of the values beside the jump. Panels: the difference between the rule of
  // the panel and the rule of every second node, but at least an error from the misfit between its nodes and
  // the polynomial through every second node, because for a rough integrand the difference can be small by
  // accident (Gonnet 2010). Alternating panels: the standard error of a sum of independent values, by the
  // differences between neighbours (von Neumann).
  ObservableArray integral{}, error{};
  std::vector<double> jumps;  // ascending
  long samples = 0;
};

class Quadrature {
 public:
  using Function = std::function<std::vector<Sample>(const std::vector<double>&)>;
  using Values = ObservableArray;

  // Prepares the quadrature of f. edges are the boundaries of the initial panels: at least two, ascending.
  Quadrature(Function f, std::vector<double> edges, long max_samples = 16000)
      : f_(std::move(f)), edges_(std::move(edges)), max_samples_(max_samples) {}

  // Samples until the goal is met. A later call with another goal continues from the existing samples.
  const QuadratureResult& refine(const QuadratureGoal& goal);

  // Returns whether a range has alternating labels. Its error is statistical, and so holds with any number of
  // nodes.
  bool alternates() const;
  // Returns the result of the samples so far, as not converged. To be called after the function has thrown.
  const QuadratureResult& interrupted();

  // Returns the integral of the difference between the integrand of `other` and this integrand, at the nodes
  // of this quadrature: most of the errors of both integrals cancel. Returns none if `other` lacks one of
  // these nodes.
  std::optional<QuadratureResult> difference_to(const Quadrature& other) const;

 private:
  struct Node {
    double at = 0;
    Sample sample{};
  };
  struct Panel {
    std::vector<Node> nodes;  // 2^k + 1, equidistant
    Values integral{}, error{};
    bool initial = false;      // has only half of its nodes
    bool alternating = false;  // has any number of nodes; label changes between them are not jumps
    double width() const { return nodes.back().at - nodes.front().at; }
  };
  // Neighbouring nodes with different labels. Once the change is located as a jump, panels end at left and
  // continue at right. spread is the spread of the values in the panel in which the change was found, because
  // the values beside the change may be equal by accident.
  struct LabelChange {
    Node left, right;
    Values spread{};
    double gap = 0;  // distance of the nodes between which the change was found
  };

  // A range of neighbouring panels and jumps with sensitive samples or changes of the label.
  struct SensitiveRange {
    double from, to;
    std::size_t changes = 0;
    bool alternating = false;  // the range is already one alternating panel
  };

  struct Selection {
    std::vector<std::size_t> panels, jumps;  // indices; of panels ascending
  };

  // Returns nodes with samples at these places. Samples in kept_ are not computed again.
  std::vector<Node> evaluate(const std::vector<double>& at);
  std::vector<double> initial_nodes(std::size_t panel) const;
  void sample_initial_panels();
  void evaluate_panel(Panel& panel) const;
  static void evaluate_alternating(Panel& panel);
  Values rule(const Panel& panel, std::size_t stride) const;
  Panel make_panel(std::vector<Node> nodes) const;
  void refine_in_batch(const std::vector<std::size_t>& panels, const std::vector<std::size_t>& jumps);
  void split_at_changes(const std::vector<std::size_t>& panels);
  void sort_panels();
  Selection largest() const;
  std::vector<std::size_t> too_wide() const;
  std::vector<std::size_t> beside(const std::vector<std::size_t>& jumps) const;
  void refine_largest();
  void append_panels(std::vector<Panel>& out, const std::vector<Node>& nodes, bool from_right) const;
  // Returns the label changes in a panel that may become jumps: none if the panel is alternating.
  static std::vector<LabelChange> changes_in(const Panel& panel);
  std::vector<SensitiveRange> sensitive_ranges() const;
  std::vector<double> equidistant(const SensitiveRange& range) const;
  void make_alternating(const SensitiveRange& range);
  void find_alternating_ranges();
  std::optional<LabelChange> largest_change(const Panel& panel) const;
  static Values uncertainty(const LabelChange& change);
  static Values squares(const Values& error);
  static Values squares(const Panel& panel);
  void sum();
  void list_jumps();
  bool is_complete(const Panel& panel) const;
  double asked(std::size_t component) const;
  double tolerance(std::size_t component) const;
  double severity(const Values& error) const;
  double unmet_severity(Values error) const;
  double unmet_severity(const Panel& panel) const;

  Function f_;
  std::vector<double> edges_;
  long max_samples_;
  QuadratureGoal goal_;
  std::vector<Panel> panels_;       // ascending
  std::vector<LabelChange> jumps_;  // label changes that have been located
  Values complete_{};               // squares of the errors of panels that are not refined further
  std::map<double, Sample> kept_;   // samples of panels and jumps that an alternating panel has replaced
  QuadratureResult result_;
};

}  // namespace bristle

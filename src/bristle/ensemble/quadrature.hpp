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
// nor its error could be trusted. Such a range becomes one panel of equidistant nodes with a statistical
// error.
struct Sample {
  ObservableArray value{};
  int label = 0;
  bool sensitive = false;  // whether a small change of the place may change the label
  bool valid = true;       // false ends the quadrature: its result would be invalid
};

struct QuadratureGoal {
  ObservableArray rtol{};                       // per component; 0: not controlled
  std::array<Observable, OBSERVABLES> scale{};  // component whose integral rtol refers to
  // Limits the distance between nodes: whether a panel from left to right is to be divided.
  std::function<bool(double left, double right)> too_wide = [](double, double) { return false; };
  // An error of a quarter of the distance between the integral and this value also suffices, as a root-finder
  // or a scan only needs the side on which the integral lies.
  std::optional<double> threshold;
  // Nodes of an alternating panel, whose error falls with the square root of their number only. If its error
  // is too large with as many, the rest is refined as if it had none, and the quadrature ends as not
  // converged.
  std::size_t most_alternating = 2048;
};

enum class QuadratureStatus {
  converged,
  not_converged,
  invalid
};

struct QuadratureResult {
  QuadratureStatus status = QuadratureStatus::converged;
  // error: root of the sum of squares of the errors of the panels and of the uncertain positions of the
  // jumps, which count by the spread of the values beside them. The error of a panel is the difference
  // between its rule and the rule of every second node, with a lower bound from the misfit between its nodes
  // and the polynomial through every second node: for a rough integrand the difference can be small by
  // accident (Gonnet 2010). Where labels alternate it is the standard error of a sum of independent values,
  // by the differences between neighbours (von Neumann).
  ObservableArray integral{}, error{};
  std::vector<double> jumps;  // ascending
  long samples = 0;
};

class Quadrature {
 public:
  using Function = std::function<std::vector<Sample>(const std::vector<double>&)>;
  using Values = ObservableArray;

  // edges: boundaries of the initial panels, ascending, at least two.
  Quadrature(Function f, std::vector<double> edges, long max_samples = 16000)
      : f_(std::move(f)), edges_(std::move(edges)), max_samples_(max_samples) {}

  // Samples until the goal is met. A later call, with another goal, continues from the existing samples.
  const QuadratureResult& refine(const QuadratureGoal& goal);

  // Whether a range has alternating labels. Its error is statistical, and so holds with any number of nodes.
  bool alternates() const;
  // The result of the samples so far, as not converged, after the function has thrown.
  const QuadratureResult& interrupted();

  // The integral of the other's integrand minus this one's, by the rule of this one's nodes: most of the
  // errors of both integrals cancel. None if the other lacks one of these nodes.
  std::optional<QuadratureResult> difference_to(const Quadrature& other) const;

 private:
  struct Node {
    double at = 0;
    Sample sample{};
  };
  struct Panel {
    std::vector<Node> nodes;  // 2^k + 1, equidistant
    Values integral{}, error{};
    bool initial = false;      // with half of the nodes only
    bool alternating = false;  // any number of nodes, and changes of the label between them that are no jumps
    double width() const { return nodes.back().at - nodes.front().at; }
  };
  // Neighbouring nodes with different labels. For a located jump: panels end at left and continue at right.
  // spread: of the values in the panel in which the change was found; the values beside the change may be
  // equal by accident.
  struct LabelChange {
    Node left, right;
    Values spread{};
    double gap = 0;  // distance of the nodes between which it was found
  };

  // A range of neighbouring panels and jumps whose samples are sensitive, or which have changes of the label.
  struct SensitiveRange {
    double from, to;
    std::size_t changes = 0;
    bool alternating = false;  // one alternating panel already
  };

  struct Selection {
    std::vector<std::size_t> panels, jumps;  // indices, those of the panels ascending
  };

  // The samples at these places. Those in kept_ are not computed again.
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
  // The changes that may become jumps: none in an alternating panel.
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
  std::vector<LabelChange> jumps_;  // located
  Values complete_{};               // squares of the errors of panels that are not refined further
  std::map<double, Sample> kept_;   // of panels and jumps that an alternating panel has replaced
  QuadratureResult result_;
};

}  // namespace bristle

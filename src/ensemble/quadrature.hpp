#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace bristle {

// Adaptive quadrature of several functions at once, for integrands that are smooth between jumps and dear to
// sample. Samples are asked for in batches and never thrown away: a panel holds 3, 5 or 9 equidistant nodes,
// ends included; it is refined by nodes between them, and at 17 becomes two. A sample carries a label; where
// neighbours' labels differ there is a jump, which is located by bisecting on the label (one sample a step).
template <std::size_t N>
struct Sample {
  std::array<double, N> value{};
  int label = 0;
  bool valid = true;  // false ends the quadrature: its result would mean nothing
};

template <std::size_t N>
struct QuadratureGoal {
  std::array<double, N> rtol{};  // per component; 0: not controlled
  std::array<int, N> scale{};    // component whose integral rtol refers to
  double widest = 100;           // of a panel: what lies between its nodes is not seen
  // Enough is known of a component once its error is a quarter of its distance from this value: what
  // a root-finder or a scan asks for.
  std::optional<double> decide_about;
};

enum class QuadratureStatus {
  converged,
  not_converged,
  invalid
};

template <std::size_t N>
struct QuadratureResult {
  QuadratureStatus status = QuadratureStatus::converged;
  // error: root of the sum of squares over the panels and over the jumps' unknown places. A panel's is the
  // difference between its rule and that of every second node, but not less than what the misfit between its
  // nodes and the polynomial through every second one says: where the integrand is rough that difference can
  // be small by accident (Gonnet 2010).
  std::array<double, N> integral{}, error{};
  std::vector<double> jumps;  // ascending
  long samples = 0;
};

// Romberg's rules of 2, 3, 5 or 9 equidistant nodes on [0, 1], exact up to degree 1, 3, 5 and 7.
struct NestedRule {
  std::vector<double> weight;
  const NestedRule* coarse;  // the rule of every second node; none for 2 nodes
  // between[i][j]: factor of the value at node 2 j in the value, at node 2 i + 1, of the polynomial through
  // them.
  std::vector<std::vector<double>> between;
};
const NestedRule& nested_rule(std::size_t nodes);

template <std::size_t N>
class Quadrature {
 public:
  using Function = std::function<std::vector<Sample<N>>(const std::vector<double>&)>;
  using Values = std::array<double, N>;

  // edges: of the first panels, ascending, at least two.
  Quadrature(Function f, std::vector<double> edges, long max_samples = 16000)
      : f_(std::move(f)), edges_(std::move(edges)), max_samples_(max_samples) {}

  // Samples until the goal is met. Called again with another goal it goes on from what is there.
  const QuadratureResult<N>& refine(const QuadratureGoal<N>& goal);

 private:
  struct Node {
    double at = 0;
    Sample<N> sample{};
  };
  struct Panel {
    std::vector<Node> nodes;  // 2^k + 1, equidistant
    Values integral{}, error{};
    double width() const { return nodes.back().at - nodes.front().at; }
  };
  // Neighbours with different labels. As a jump: the panels end here and go on there.
  struct Change {
    Node left, right;
  };

  std::vector<Node> evaluate(const std::vector<double>& at);
  void start();
  void measure(Panel& panel) const;
  Values rule(const Panel& panel, std::size_t stride) const;
  Panel make_panel(std::vector<Node> nodes) const;
  void densify(std::size_t panel);
  void replace(std::size_t panel, const std::vector<Panel>& panels);
  void refine_worst();
  void locate(std::size_t panel);
  void narrow(Change& jump);
  void bisect(Change& change, std::vector<Node>& left_trail, std::vector<Node>& right_trail);
  void cut(std::vector<Panel>& out, const std::vector<Node>& nodes, bool from_right) const;
  std::optional<Change> change_in(const Panel& panel) const;
  static Values uncertainty(const Change& change);
  void sum();
  double allowed(std::size_t component) const;
  double severity(const Values& error) const;
  double lacking(Values error) const;

  Function f_;
  std::vector<double> edges_;
  long max_samples_;
  QuadratureGoal<N> goal_;
  std::vector<Panel> panels_;  // ascending
  std::vector<Change> jumps_;  // located
  QuadratureResult<N> result_;
};

}  // namespace bristle

#pragma once

#include "sweep/sweepable.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bristle::sweep {

constexpr const char* kSample = "sample";  // name of the axis whose columns vary together

// One dimension of a sweep: the name of a Sweepable, and its ascending values or, for a choice, the indices
// of its options. The axis "sample" has the numbers of its points as values, and a column for each quantity
// that they vary together, with a value for each point in any order.
struct Axis {
  std::string name;
  std::vector<double> values;
  std::vector<Axis> columns{};

  const Sweepable& quantity() const;
  // Returns true if this axis, or a column of it, varies the quantity.
  bool varies(const std::string& quantity) const;
  // Assigns the value, or the values of all columns, at this index.
  void set(PointInput& point, std::size_t index) const;
  void keep_first();  // value only
};

// Returns whether an axis, or a column of one, varies the quantity.
bool varies(const std::vector<Axis>& axes, const std::string& quantity);

// The points to be computed: one point, and the axes along which its input changes.
struct Sweep {
  PointInput base;             // before the values of the axes
  std::vector<Axis> axes;      // the last varies fastest
  bool C_peaks_at_V_s = true;  // C follows from A, so that chi peaks at V_R = V_s
  Recording record;
  Engine engine = Engine::fast;
  std::shared_ptr<const ModulationTable> friction_law;  // of the word "custom"; null: no point has it
  std::string friction_law_text;                        // what the experiment says of it, for keys

  std::size_t size() const;  // number of points
  std::vector<std::size_t> shape() const;
  PointInput point(std::size_t index) const;
  // Returns the coordinates of a point for messages: "k_r = 2, friction = nss".
  std::string place(std::size_t index) const;
  // Returns exactly the input that determines the numbers of a point, as text: the same text for equal points
  // of any two sweeps, regardless of axes and their order. Choices are written as words, so that inserting or
  // reordering friction laws does not change the meaning of stored keys.
  std::string key(std::size_t index) const;

  bool varies(const std::string& quantity) const;
  bool on_lattice() const;  // for at least one point
  // Returns the number of the axis; axes.size() if there is none of this name.
  std::size_t axis_number(const std::string& name) const;

  // Returns the sweep with this axis in place of the axis of its name or, if there is none, as the first.
  Sweep with(Axis axis) const;
  // Returns the sweep without the axis of this name, if it has one: with the value that base has.
  Sweep without(const std::string& name) const;
  // Returns the sweep with one value, the first, of each axis that varies none of these quantities.
  Sweep first_values(const std::vector<std::string>& except) const;
};

// Sets mu_c or tau_f of the point such that rigid bristles have its local friction at its target load. Does
// nothing for a point without a local friction.
void apply_nominal_friction(PointInput& point);

// Returns whether two points of sweeps that differ in points only have the same numbers.
bool same_effect(const PointInput& a, const PointInput& b);
// Returns the names of axes, and of columns of samples, along which all points have the same numbers, such as
// mu_c where no friction law reads it.
std::vector<std::string> axes_without_effect(const Sweep& sweep);

}  // namespace bristle::sweep

namespace bristle {
using sweep::Sweep;
}

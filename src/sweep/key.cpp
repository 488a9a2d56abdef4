#include "sweep/sweep.hpp"

#include "sweep/si.hpp"
#include "bristle/model/friction/laws.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

namespace bristle::sweep {
namespace {

// These fail when a member is added: without the member in the text, different points would be treated as
// equal.
static_assert(sizeof(Orientation) == 11 * sizeof(double));
static_assert(sizeof(IntegratorOptions) == 4 * sizeof(double));
static_assert(sizeof(Scatter) == 6 * sizeof(double));
static_assert(sizeof(Setup) == sizeof(Parameters) + sizeof(Orientation) + sizeof(IntegratorOptions) +
                                   sizeof(Scatter) + sizeof(double));
static_assert(sizeof(Loading) == 4 * sizeof(double));
static_assert(sizeof(Recording) == 4 * sizeof(double));

// Names and values in the order in which they are added, written like JSON but with a comma after each.
// Numbers are in the shortest form that reads back exactly.
class Text {
 public:
  // Appends the name of an object, and its members, which add() appends.
  template <class Add>
  void object(const char* name, Add add) {
    append(R"("{}":{{)", name);
    add();
    text_.append(std::string_view("},"));
  }
  void add(const char* name, const char* word) { append(R"("{}":"{}",)", name, word); }
  void add(const char* name, const std::vector<double>& numbers) {
    append(R"("{}":[{}],)", name, fmt::join(numbers, ","));
  }
  template <class Number>
  void add(const char* name, Number number) {
    append(R"("{}":{},)", name, number);
  }
  std::string text() const { return fmt::to_string(text_); }

 private:
  template <class... Values>
  void append(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  fmt::memory_buffer text_;
};

void add_parameters(Text& out, const Parameters& p) {
  for (const Parameter& one : kParameters) out.add(one.name, p.*one.member);
  for (const Choice& one : choices()) out.add(one.name, one.words[std::size_t(one.get(p))]);
}

void add_friction_law(Text& out, const Sweep& sweep, const Parameters& p) {
  if (p.friction != FrictionLaw::custom) return;
  out.add("friction_law", sweep.friction_law_text);
  if (sweep.base.friction_law_in_si) out.add("friction_law_V0", p.custom_friction.V_0);
}

void add_orientation(Text& out, const Orientation& o) {
  out.add("distribution", word(o.distribution));
  out.add("mean", o.mean);
  out.add("concentration", o.concentration);
  out.add("sampling", word(o.sampling));
  out.add("full_circle", o.full_circle);
  out.add("rtol", o.rtol);
  // A list may have many values.
  out.add("theta_0_sha256", sha256_of(fmt::format("{}", fmt::join(o.theta_0, ","))).c_str());
  out.add("seed", o.seed);
  out.add("rows", o.rows);
  out.add("t_1", o.t_1);
}

void add_integrator(Text& out, const IntegratorOptions& i) {
  out.add("rtol", i.rtol);
  out.add("atol", i.atol);
  out.add("method", word(i.method));
  out.add("max_evaluations", i.max_evaluations);
}

void add_scatter(Text& out, const Scatter& scatter) {
  for (std::size_t i = 0; i < kScattered.size(); ++i) {
    if (scatter.width[i] == 0) continue;
    out.add(kScattered[i].name, scatter.width[i]);
    out.add("uniform", scatter.uniform[i]);
  }
  out.add("bristles", scatter.bristles);
}

void add_loading(Text& out, const Loading& l) {
  if (l.z_0) {
    out.add("z_0", *l.z_0);
  } else {
    out.add("R_n", l.R_n);
    out.add("path", word(l.path));
  }
}

void add_recording(Text& out, const Recording& r) {
  out.add("bristles", r.bristles);
  out.add("slab_force", r.slab_force);
  out.add("trajectories", r.trajectories);
}

// Returns the names of the observables whose values journals have.
std::vector<const char*> observable_names() {
  std::vector<const char*> names;
  for (const ObservableRow& row : kObservables) names.push_back(row.name);
  return names;
}

}  // namespace

std::string Sweep::key(std::size_t index) const {
  const PointInput point = this->point(index);
  Text out;
  out.object("model", [&] { add_parameters(out, point.setup.parameters); });
  add_friction_law(out, *this, point.setup.parameters);
  out.object("orientation", [&] { add_orientation(out, point.setup.orientation); });
  out.object("integrator", [&] { add_integrator(out, point.setup.integrator); });
  if (const Scatter& scatter = point.setup.scatter; scatter.any())
    out.object("scatter", [&] { add_scatter(out, scatter); });
  out.object("load", [&] { add_loading(out, point.loading); });
  out.object("record", [&] { add_recording(out, record); });
  out.add("engine", word(engine));
  out.add("max_evaluations_per_point", point.setup.max_evaluations_per_point);
  if (const SiScales si = si_scales(point); !point.si.empty())
    out.object("si", [&] {
      out.add("r0_m", si.length);
      out.add("V0_m_per_s", si.velocity);
      out.add("force_N", si.force);
    });
  out.add("observables", fmt::format("{}", fmt::join(observable_names(), ",")).c_str());
  return out.text();
}

}  // namespace bristle::sweep

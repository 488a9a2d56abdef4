#include "results/variables.hpp"

#include "bristle/model/lift_off.hpp"

#include <fmt/format.h>

namespace bristle::results {
namespace {

using Variables = std::vector<ResultVariable>;
using P = const PointResult&;

// Computes one quantity of a point.
using Value = std::function<Quantity(P)>;
// Returns an ensemble mean.
Value mean_of(Observable k) {
  return [k](P p) { return Quantity{p.value[k], p.error[k], p.load_error[k]}; };
}
// Returns a number without an error.
Value exact(double PointResult::*number) {
  return [number](P p) { return Quantity{p.*number, 0, 0}; };
}

Quantity gap(P p) { return {p.z_0, p.z_0_error, p.z_0_error}; }

ResultVariable mean(const Column& column, Observable k) { return {column, mean_of(k), Errors::with_load}; }

// Returns "R_n" of "R_n/N_c0".
std::string before_slash(const std::string& symbol) { return symbol.substr(0, symbol.find('/')); }

// Returns the symbol of a dimensional quantity, without the tilde of the dimensionless one.
std::string without_tilde(std::string symbol) {
  const std::string tilde = R"(\tilde{)";
  if (const auto at = symbol.find(tilde); at != std::string::npos) {
    symbol.erase(symbol.find('}', at), 1);
    symbol.erase(at, tilde.size());
  }
  return symbol;
}

// Returns the symbol with a word added to its first subscript, a single character.
std::string with_subscript(std::string symbol, const char* word) {
  const auto at = symbol.find('_') + 1;
  return symbol.replace(at, 1, fmt::format(R"({{{},\mathrm{{{}}}}})", symbol[at], word));
}

ResultVariable pinned_share_of(Observable k) {
  const ObservableRow& row = kObservables[k];
  const std::string symbol = before_slash(without_tilde(row.symbol));
  const Column column = {fmt::format("pinned_share_{}", row.name),
                         fmt::format("share of the pinned bristles in {}", row.name),
                         with_subscript(symbol, "pinned") + "/" + symbol, ""};
  return {column, [k](P p) { return pinned_share(p, k); }, Errors::with_load};
}

// Returns the variant of an observable for the bristles that are not pinned.
ResultVariable unpinned_of(Observable k) {
  const ObservableRow& row = kObservables[k];
  const Column column = {fmt::format("{}_unpinned", row.name),
                         fmt::format("{}, without pinned bristles", row.long_name),
                         with_subscript(row.symbol, "unpinned"), ""};
  if (row.unpinned == Unpinned::contribution) return mean(column, unpinned(k));
  return {column, [k](P p) { return unpinned_mean(p, k); }, Errors::with_load, true};  // all may be pinned
}

void add_observables(Variables& variables) {
  for (Observable k = 0; k < kObservables.size(); ++k) {
    const ObservableRow& row = kObservables[k];
    variables.push_back(mean({row.name, row.long_name, row.symbol, row.equation}, k));
    if (row.unpinned == Unpinned::contribution) variables.push_back(pinned_share_of(k));
    if (row.unpinned != Unpinned::none) variables.push_back(unpinned_of(k));
  }
}

void add_norms(Variables& variables) {
  variables.push_back(
      {{"R_x_norm", "friction force relative to rigid bristles", R"(\check{R}_x)", "Eq. (20)"},
       [](P p) { return p.R_x_norm; },
       Errors::with_load});
  variables.push_back(
      {{"R_y_norm", "transverse force over the friction of rigid bristles", R"(\check{R}_y)", "Eq. (21)"},
       [](P p) { return p.R_y_norm; },
       Errors::with_load});
  variables.push_back(
      {{"R_x_norm_unpinned", "friction force relative to rigid bristles under R_n, without pinned bristles",
        R"(\check{R}_{x,\mathrm{unpinned}})", ""},
       unpinned_friction,
       Errors::with_load});
}

Column drag_column() {
  return {"drag", "force against the motion: friction, and the work of entering bristles",
          R"(\tilde{R}_x/N_{c,0} + E_0/\tilde{L}_x)", "docs/model.md"};
}

void add_load_jump(Variables& variables) {
  variables.push_back({{"jump_z_0", "last gap before R_n(z_0) jumps across the target",
                        R"(\tilde{z}_{0,\mathrm{jump}})", "Fig. 3"},
                       exact(&PointResult::jump_z_0),
                       Errors::none});
  variables.push_back(
      {{"jump_R_n", "normal load at jump_z_0", R"(\tilde{R}_{n,\mathrm{jump}}/N_{c,0})", "Fig. 3"},
       exact(&PointResult::jump_R_n),
       Errors::none});
}

// Adds the values at the other gap of an ambiguous point, without errors, because these equal the errors of
// the point.
void add_other_gap(Variables& variables) {
  const auto add = [&](const std::string& name, const std::string& long_name, const std::string& symbol,
                       const char* equation, const Value& value) {
    const auto subscript = symbol.find('_') == std::string::npos ? symbol : with_subscript(symbol, "other");
    variables.push_back(
        {{name + "_other", long_name + ", at the other gap of an ambiguous point", subscript, equation},
         value,
         Errors::none});
  };
  add("z_0", "gap between slab and ground", R"(\tilde{z}_0)", "Fig. 3", exact(&PointResult::z_0_other));
  for (Observable k = 0; k < kObservables.size(); ++k)
    if (const ObservableRow& row = kObservables[k]; row.controlled)
      add(row.name, row.long_name, row.symbol, row.equation, [k](P p) {
        return Quantity{p.value_other[k], 0, 0};
      });
  add("R_x_norm", "friction force relative to rigid bristles", R"(\check{R}_x)", "Eq. (20)",
      exact(&PointResult::R_x_norm_other));
}

void add_fluctuations(Variables& variables) {
  variables.push_back(
      {{"R_n_fluctuation", "standard deviation of R_n(t) over its mean", R"(\sigma(R_n)/R_n)", "Eq. (A3)"},
       [](P p) { return p.fluctuation; },
       Errors::estimated});
  variables.push_back(
      {{"R_n_fluctuation_of_rows",
        "standard deviation of R_n(t), averaged over the passing time of a row, over its mean",
        R"(\sigma(\langle R_n\rangle_{\mathrm{row}})/R_n)", "Eq. (A3)"},
       [](P p) { return p.fluctuation_of_rows; },
       Errors::estimated});
}

// A quantity in SI units: a dimensionless one times a factor.
struct SiRow {
  std::string name, long_name, symbol, equation, units;
  Value value;
  std::function<double(P)> factor;
};

double per_area(P p) {
  const double spacing = p.parameters.spacing * p.si.length;
  return 1 / (spacing * spacing);
}

// Returns the quantities in SI units. Forces are per bristle under a slab of rigid bristles, N_c0, with one
// bristle per area of the spacing.
std::vector<SiRow> si_rows() {
  const auto length = [](double Parameters::*member) -> Value {
    return [member](P p) { return Quantity{p.parameters.*member, 0, 0}; };
  };
  const auto in_m = [](P p) { return p.si.length; };
  const auto pressure = [](P p) { return p.si.force * per_area(p); };
  const auto power = [](P p) { return p.si.force * p.si.velocity * per_area(p); };
  std::vector<SiRow> rows;
  for (Observable k = 0; k < kObservables.size(); ++k)
    if (const ObservableRow& row = kObservables[k]; row.si)
      rows.push_back({fmt::format("{}_in_{}", row.name, row.si->suffix), row.long_name,
                      without_tilde(row.symbol), row.equation, row.si->units, mean_of(k),
                      [scale = row.si->scale](P p) { return p.si.*scale; }});
  const std::vector<SiRow> others = {
      {"z_0_in_m", "gap between slab and ground", "z_0", "Fig. 3", "m", gap, in_m},
      {"L_x_in_m", "slab length", "L_x", "", "m", length(&Parameters::L_x), in_m},
      {"spacing_in_m", "lattice spacing", R"(\Delta)", "", "m", length(&Parameters::spacing), in_m},
      {"drag_in_N", drag_column().long_name, R"(R_x/N_{c,0} + E_0/L_x)", drag_column().equation, "N", drag,
       [](P p) { return p.si.force; }},
      {"impacts_per_s", "impacts on the slab per bristle in contact and time", R"(\dot{N}_\mathrm{impacts})",
       "", "s-1", impact_rate, [](P p) { return p.si.velocity / p.si.length; }},
      {"bristles_per_m2", "bristles per area", R"(1/\Delta^2)", "", "m-2",
       [](P) {
         return Quantity{1, 0, 0};
       },
       per_area},
      {"pressure_in_Pa", "normal load per area", R"(R_n/(L_x L_y))", "Eq. (19)", "Pa", mean_of(R_N),
       pressure},
      {"friction_in_Pa", "friction force along the motion per area", R"(R_x/(L_x L_y))", "Eq. (19)", "Pa",
       mean_of(R_X), pressure},
      {"power_in_W_per_m2", "power of the slab's motion against friction, per area", R"(R_x V_0/(L_x L_y))",
       "", "W m-2", mean_of(R_X), power},
      {"wear_power_in_W_per_m2", "power of friction on the sliding tips, per area",
       R"(W_\mathrm{slide} V_0/\Delta^2)", "", "W m-2", mean_of(observable("sliding_work")), power},
  };
  rows.insert(rows.end(), others.begin(), others.end());
  return rows;
}

// Returns a variable with the values of a row in SI units.
ResultVariable in_si(const SiRow& row) {
  return {{.name = row.name,
           .long_name = row.long_name,
           .symbol = row.symbol,
           .equation = row.equation,
           .units = row.units},
          [row](P p) {
            const Quantity d = row.value(p);
            const double factor = row.factor(p);
            return Quantity{d.value * factor, d.error * factor, d.load_error * factor};
          },
          Errors::with_load};
}

void add_si(Variables& variables) {
  for (const SiRow& row : si_rows()) variables.push_back(in_si(row));
  variables.push_back({{"friction_coefficient", "friction force over normal load", R"(R_x/R_n)", "Eq. (19)"},
                       friction_coefficient,
                       Errors::estimated});
}

// Adds the greatest load that an unreachable point carries, and its gap.
void add_largest_load(Variables& variables, bool si) {
  const ResultVariable load = {{"R_n_largest",
                                "greatest load that a gap carries, where no gap carries the target",
                                R"(\tilde{R}_{n,\max}/N_{c,0})", "Fig. 3"},
                               [](P p) { return p.R_n_largest; },
                               Errors::estimated},
                       gap_of_it = {{"z_0_of_R_n_largest", "gap that carries R_n_largest",
                                     R"(\tilde{z}_{0,\max})", "Fig. 3"},
                                    exact(&PointResult::z_0_of_R_n_largest),
                                    Errors::none};
  variables.insert(variables.end(), {load, gap_of_it});
  if (!si) return;
  for (const auto& [one, suffix, units, scale] : {std::tuple{load, "_in_N", "N", &SiScales::force},
                                                  std::tuple{gap_of_it, "_in_m", "m", &SiScales::length}}) {
    variables.push_back(in_si({one.name + suffix, one.long_name, without_tilde(one.symbol), one.equation,
                               units, one.of, [scale = scale](P p) { return p.si.*scale; }}));
    variables.back().errors = one.errors;
  }
}

// Adds lift-off loads. Their errors are the scatter of computed lift-off loads about the formula.
void add_lift_off(Variables& variables, bool si) {
  const char* where = "docs/lift-off.md";
  const auto load = [](P p) {
    const double value = lift_off_load(p.parameters);
    return Quantity{value, kLiftOff.scatter * value, 0};
  };
  const auto ratio = [load](P p) {
    const double lift_off = load(p).value, value = p.value[R_N] / lift_off;
    return Quantity{value, kLiftOff.scatter * value + p.error[R_N] / lift_off, p.load_error[R_N] / lift_off};
  };
  const char* long_name = "load below which the tips bounce, by a formula";
  variables.push_back(
      {{.name = "lift_off_load",
        .long_name = long_name,
        .symbol = R"(\tilde{R}_n^*/N_{c,0})",
        .equation = where,
        .attributes = {{"formula", fmt::format("{:.2g} (k_r k_phi)^(1/2) - {:.2g} k_phi ln(k_phi)",
                                               kLiftOff.of_springs, kLiftOff.of_speed)}}},
       load,
       Errors::estimated});
  variables.push_back({{"load_over_lift_off", "normal load over the lift-off load", "R_n/R_n^*", where},
                       ratio,
                       Errors::with_load});
  if (!si) return;
  variables.push_back({{.name = "lift_off_load_in_N",
                        .long_name = long_name,
                        .symbol = R"(R_n^*/N_{c,0})",
                        .equation = where,
                        .units = "N"},
                       [load](P p) {
                         const Quantity d = load(p);
                         return Quantity{d.value * p.si.force, d.error * p.si.force, 0};
                       },
                       Errors::estimated});
}

// Adds magnitude and direction of friction. If the azimuths are not uniformly distributed, the friction force
// is not parallel to the motion.
void add_direction(Variables& variables) {
  variables.push_back(
      {{"R_norm", "magnitude of friction relative to rigid bristles", R"(|\check{R}|)", "Eqs. (20, 21)"},
       friction_magnitude,
       Errors::estimated});
  variables.push_back({{.name = "direction",
                        .long_name = "angle of the friction force relative to the motion",
                        .symbol = R"(\angle R)",
                        .equation = "Eq. (19)",
                        .units = "degree"},
                       friction_direction,
                       Errors::estimated});
}

// Adds variables that may be missing at points with values. why: in words; empty: no more than that
template <class Add>
void add_that_may_be_missing(Variables& variables, const Add& add, const std::string& why = "") {
  const std::size_t first = variables.size();
  add(variables);
  for (std::size_t i = first; i < variables.size(); ++i) {
    variables[i].may_be_missing = true;
    if (!why.empty()) variables[i].why_missing = why;
  }
}

}  // namespace

std::vector<ResultVariable> result_variables(const Sweep& sweep) {
  Variables variables = {
      {{"z_0", "gap between slab and ground", R"(\tilde{z}_0)", "Fig. 3"}, gap, Errors::with_load}};
  add_observables(variables);
  add_norms(variables);
  variables.push_back({drag_column(), drag, Errors::with_load});
  variables.push_back({{.name = "incomplete_theta_0",
                        .long_name = "undeformed azimuth of the first passage without an exit",
                        .symbol = R"(\theta_0)",
                        .equation = "",
                        .units = "rad"},
                       exact(&PointResult::incomplete_theta_0),
                       Errors::none,
                       true});
  const bool searched = !sweep.base.loading.z_0;
  const bool si = !sweep.base.si.empty();
  const bool von_mises = sweep.base.setup.orientation.distribution == Distribution::von_mises;
  if (searched) {
    add_that_may_be_missing(variables, add_load_jump, "R_n(z_0) does not jump across the load");
    add_that_may_be_missing(
        variables, [&](Variables& all) { add_largest_load(all, si); }, "a gap carries the load");
    add_that_may_be_missing(variables, add_other_gap, "no other gap carries the load");
  }
  if (sweep.on_lattice()) add_that_may_be_missing(variables, add_fluctuations);
  if (si) add_si(variables);
  if (von_mises) add_direction(variables);
  else add_that_may_be_missing(variables, [&](Variables& all) { add_lift_off(all, si); });
  return variables;
}

}  // namespace bristle::results

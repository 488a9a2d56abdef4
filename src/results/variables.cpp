#include "results/variables.hpp"

#include "ensemble/derived.hpp"

namespace bristle::results {
namespace {

using Value = ResultVariable::Value;

ResultVariable mean(const char* name, const char* long_name, const char* symbol, const char* equation,
                    Observable k) {
  return {name,
          long_name,
          symbol,
          equation,
          [k](const PointResult& p) { return p.value[k]; },
          [k](const PointResult& p) { return p.error[k]; },
          [k](const PointResult& p) { return p.load_error[k]; }};
}

ResultVariable derived(const char* name, const char* long_name, const char* symbol, const char* equation,
                       const std::function<Derived(const PointResult&)>& of, bool has_load_error = false,
                       const char* units = "1") {
  Value load_error;
  if (has_load_error) load_error = [of](const PointResult& p) { return of(p).load_error; };
  return {name,
          long_name,
          symbol,
          equation,
          [of](const PointResult& p) { return of(p).value; },
          [of](const PointResult& p) { return of(p).error; },
          load_error,
          units};
}

ResultVariable pinned_share(const char* name, const char* long_name, const char* symbol, Observable part,
                            Observable total) {
  return derived(
      name, long_name, symbol, "", [=](const PointResult& p) { return share_of(p, part, total); }, true);
}

ResultVariable mean_unpinned(const char* name, const char* long_name, const char* symbol,
                             Observable contribution) {
  return derived(
      name, long_name, symbol, "", [=](const PointResult& p) { return mean_of_passing(p, contribution); },
      true);
}

ResultVariable field(const char* name, const char* long_name, const char* symbol, const char* equation,
                     double PointResult::*value, double PointResult::*error = nullptr,
                     double PointResult::*load_error = nullptr) {
  const auto read = [](double PointResult::*member) -> Value {
    if (!member) return {};
    return [member](const PointResult& p) { return p.*member; };
  };
  ResultVariable v{name, long_name, symbol, equation, read(value), read(error), read(load_error)};
  return v;
}

ResultVariable fluctuation(const char* name, const char* long_name, const char* symbol,
                           Fluctuation PointResult::*member) {
  return {name,
          long_name,
          symbol,
          "Eq. (A3)",
          [member](const PointResult& p) { return (p.*member).value; },
          [member](const PointResult& p) { return (p.*member).error; },
          {}};
}

// An ensemble mean in newtons.
ResultVariable force(const char* name, const char* long_name, const char* symbol, Observable k) {
  return {name,
          long_name,
          symbol,
          "Eq. (19)",
          [k](const PointResult& p) { return p.value[k] * p.force_unit; },
          [k](const PointResult& p) { return p.error[k] * p.force_unit; },
          [k](const PointResult& p) { return p.load_error[k] * p.force_unit; },
          "N"};
}

void add_load_jump(std::vector<ResultVariable>& variables) {
  variables.push_back(field("jump_z_0", "last gap before R_n(z_0) jumps across the target",
                            R"(\tilde{z}_{0,\mathrm{jump}})", "Fig. 3", &PointResult::jump_z_0));
  variables.push_back(field("jump_R_n", "normal load at jump_z_0", R"(\tilde{R}_{n,\mathrm{jump}}/N_{c,0})",
                            "Fig. 3", &PointResult::jump_R_n));
}

void add_fluctuations(std::vector<ResultVariable>& variables) {
  variables.push_back(fluctuation("R_n_fluctuation", "standard deviation of R_n(t) over its mean",
                                  R"(\sigma(R_n)/R_n)", &PointResult::fluctuation));
  variables.push_back(
      fluctuation("R_n_fluctuation_of_rows",
                  "standard deviation of R_n(t), averaged over the passing time of a row, over its mean",
                  R"(\sigma(\langle R_n\rangle_{\mathrm{row}})/R_n)", &PointResult::fluctuation_of_rows));
}

void add_si(std::vector<ResultVariable>& variables) {
  variables.push_back(force("R_n_in_N", "normal load per bristle", R"(R_n/N_{c,0})", R_N));
  variables.push_back(
      force("R_x_in_N", "friction force per bristle along the motion", R"(R_x/N_{c,0})", R_X));
  variables.push_back(
      force("R_y_in_N", "friction force per bristle across the motion", R"(R_y/N_{c,0})", R_Y));
  variables.push_back(derived("friction_coefficient", "friction force over normal load", R"(R_x/R_n)",
                              "Eq. (19)", friction_coefficient));
}

// If the azimuths are not uniformly distributed, the friction force is not parallel to the motion.
void add_direction(std::vector<ResultVariable>& variables) {
  variables.push_back(derived("R_norm", "magnitude of friction over that of rigid bristles", R"(|\check{R}|)",
                              "Eqs. (20, 21)", friction_magnitude));
  variables.push_back(derived("direction", "angle of the friction force relative to the motion",
                              R"(\angle R)", "Eq. (19)", friction_direction, false, "degree"));
}

}  // namespace

std::vector<ResultVariable> result_variables(const Experiment& experiment) {
  using P = PointResult;
  std::vector<ResultVariable> variables = {
      field("z_0", "gap between slab and ground", R"(\tilde{z}_0)", "Fig. 3", &P::z_0, &P::z_0_error,
            &P::z_0_error),
      mean("R_n", "normal load per bristle", R"(\tilde{R}_n/N_{c,0})", "Eq. (19)", R_N),
      mean("R_x", "friction force per bristle along the motion", R"(\tilde{R}_x/N_{c,0})", "Eq. (19)", R_X),
      mean("R_y", "friction force per bristle across the motion", R"(\tilde{R}_y/N_{c,0})", "Eq. (19)", R_Y),
      field("R_x_norm", "friction force over that of rigid bristles", R"(\check{R}_x)", "Eq. (20)",
            &P::R_x_norm, &P::R_x_norm_error, &P::R_x_norm_load_error),
      field("R_y_norm", "transverse force over the friction of rigid bristles", R"(\check{R}_y)", "Eq. (21)",
            &P::R_y_norm, &P::R_y_norm_error, &P::R_y_norm_load_error),
      mean("N_c_ratio", "bristles in contact over those of rigid bristles", R"(N_c/N_{c,0})", "Eq. (A2)",
           N_C_RATIO),
      mean("gamma_1", "modulation of friction by the sliding speed", R"(\tilde{\gamma}_1)", "Eq. (24)",
           GAMMA_1),
      mean("gamma_2", "alignment of friction with the motion", R"(\tilde{\gamma}_2)", "Eq. (25)", GAMMA_2),
      mean("gamma_3", "reduction of the contact area by load fluctuations", R"(\tilde{\gamma}_3)", "Eq. (26)",
           GAMMA_3),
      mean("pinned_fraction", "fraction of bristles pinned upright at the pole", R"(f_\mathrm{pinned})", "",
           PINNED_FRACTION),
      pinned_share("pinned_share_R_n", "share of pinned bristles in R_n", R"(R_{n,\mathrm{pinned}}/R_n)",
                   PINNED_R_N, R_N),
      pinned_share("pinned_share_R_x", "share of pinned bristles in R_x", R"(R_{x,\mathrm{pinned}}/R_x)",
                   PINNED_R_X, R_X),
      mean("R_n_unpinned", "normal load of the bristles that pass, per bristle",
           R"(\tilde{R}_{n,\mathrm{unpinned}}/N_{c,0})", "", PASSING_R_N),
      mean("R_x_unpinned", "friction force of the bristles that pass, per bristle",
           R"(\tilde{R}_{x,\mathrm{unpinned}}/N_{c,0})", "", PASSING_R_X),
      derived("R_x_norm_unpinned", "friction of the bristles that pass over that of rigid bristles under R_n",
              R"(\check{R}_{x,\mathrm{unpinned}})", "", friction_of_passing, true),
      mean_unpinned("gamma_1_unpinned", "gamma_1 of the bristles that pass",
                    R"(\tilde{\gamma}_{1,\mathrm{unpinned}})", PASSING_GAMMA_1),
      mean_unpinned("gamma_2_unpinned", "gamma_2 of the bristles that pass",
                    R"(\tilde{\gamma}_{2,\mathrm{unpinned}})", PASSING_GAMMA_2),
      mean_unpinned("gamma_3_unpinned", "gamma_3 of the bristles that pass",
                    R"(\tilde{\gamma}_{3,\mathrm{unpinned}})", PASSING_GAMMA_3),
      mean("energy_residual", "mean error of the energy budget over the dissipated or initial energy",
           R"(\epsilon_E)", "Eqs. (13, 17, 18)", ENERGY_RESIDUAL),
      field("incomplete_theta_0", "undeformed azimuth of the first passage without an exit", R"(\theta_0)",
            "", &P::incomplete_theta_0),
  };
  variables.back().units = "rad";
  if (!experiment.base.loading.z_0 && !experiment.base.loading.trace) add_load_jump(variables);
  if (experiment.on_lattice()) add_fluctuations(variables);
  if (!experiment.base.si.empty()) add_si(variables);
  if (experiment.base.setup.orientation.distribution == Distribution::von_mises) add_direction(variables);
  return variables;
}

const std::vector<std::string> kPointStatusNames = texts(words<PointStatus>()),
                               kBranchNames = texts(words<Branch>()), kOutcomeNames = texts(words<Outcome>()),
                               kPhaseNames = texts(words<Phase>());

}  // namespace bristle::results

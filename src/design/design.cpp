#include "design/design.hpp"

#include "design/block.hpp"
#include "design/drawing.hpp"
#include "design/groups.hpp"
#include "design/trials.hpp"
#include "design/words.hpp"
#include "sampling/rounded.hpp"
#include "results/digest.hpp"
#include "results/reader.hpp"
#include "run/analysis.hpp"
#include "run/provenance.hpp"
#include "run/signals.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <set>
#include <nlohmann/json.hpp>

namespace bristle::design {
namespace {

constexpr std::size_t kProfileValues = 25;

// Throws InputError if the objective or a constraint names a variable that the result of this experiment
// lacks.
void require_variables(const Experiment& experiment, const Design& design) {
  const json::Node block(*experiment.source, "/design");
  std::vector<std::string> shape;
  for (const ShapeQuantity& quantity : kShape) shape.push_back(quantity.name);
  run::require_variable(experiment, block["objective"], design.objective.variable);
  for (std::size_t i = 0; i < design.constraints.size(); ++i)
    if (const std::string& name = design.constraints[i].variable; name != kJumpMargin)
      run::require_variable(experiment, block["constraints"][i]["variable"], name, shape);
}

// Returns the experiment with the rows as its sample, as the result stores it.
Experiment with_table(const Experiment& e, const Trials& trials, const std::vector<Values>& rows) {
  Json table = {{"columns", Json::array()}, {"rows", Json::array()}};
  const Sweep sampled = trials.with_rows(rows);
  for (const sweep::Axis& column : sampled.axes[sampled.axis_number(sweep::kSample)].columns)
    table["columns"].push_back(column.name);
  for (const Values& row : rows) {
    table["rows"].push_back(Json::array());
    for (const Json& name : table["columns"]) table["rows"].back().push_back(row.at(name));
  }
  Json document = *e.document, sweep = {{sweep::kSample, {{"table", table}}}};
  if (document.contains("sweep")) sweep.update(document["sweep"]);
  document["sweep"] = sweep;
  return experiment::stored_experiment(document, e.tier, e.path);
}

// Returns true if the file has the result of this design with its title and notes, complete and undamaged.
bool up_to_date(const std::string& path, const Experiment& e) {
  return results::up_to_date(path, e) && results::without_trials(results::ResultReader(path).experiment()) ==
                                             results::without_trials(*e.document);
}

// Returns the values of a quantity's profile, including the best trial's: from bound to bound for a variable
// of the design, otherwise over the quantity's deviations.
std::vector<double> profile_values(const Design& design, const std::string& quantity, double best) {
  experiment::Range range{quantity, 0, 0, false};
  const auto variable = std::ranges::find(design.variables, quantity, &experiment::Range::name);
  if (variable != design.variables.end()) range = *variable;
  else {
    const auto t = std::ranges::find(design.tolerances, quantity, &experiment::Tolerance::name);
    const double reach = std::min(0.9, (t->normal ? 4 : 1) * t->width);
    range.low = rounded(best * (1 - reach));
    range.high = rounded(best * (1 + reach));
    if (range.low > range.high) std::swap(range.low, range.high);
  }
  std::vector<double> values = {best};
  for (std::size_t i = 0; i < kProfileValues; ++i)
    values.push_back(range.at(double(i) / (kProfileValues - 1)));
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// Runs the search; keeps all trials and the solver that they share.
class Search {
 public:
  Search(const Experiment& experiment, const Design& design, const run::RunOptions& options)
      : experiment_(experiment),
        design_(design),
        options_(options),
        journal_(run::journal_path(options.output, {}), run::kCommit, options.force),
        trials_(experiment, design, solver()) {}

  // Returns the text that says what was found, and whether the recommended brush meets the constraints.
  std::pair<std::string, bool> run(std::map<std::string, std::string> entries) {
    const std::size_t scenarios = experiment_.sweep.without(sweep::kSample).size();
    progress_.emplace(experiment_.name, design_.budget * trials_.rows_of_a_trial() * scenarios,
                      options_.quiet);
    Findings found = search();
    recommend(found);

    std::vector<Values> nominal;
    for (const Trial& trial : found.trials) nominal.push_back(trial.nominal);
    const Experiment all = with_table(experiment_, trials_, trials_.rows(nominal));
    const std::vector<std::size_t> points = run::shard_points({}, all.sweep.size());
    std::string text = text_of(trials_, found);
    std::vector<results::Dataset> groups = groups_of(trials_, found);
    if (!found.chosen.empty())
      if (const std::vector<Dimension> dimensions = drawing(trials_, found); !dimensions.empty()) {
        const Sweep brush = trials_.with_rows({recommended(found).nominal});
        const std::vector<Working> range =
            working_range(brush, solver()(brush, run::shard_points({}, brush.size()), Purpose::beside));
        text += drawing_text(dimensions, brush.point(0).setup.orientation) + working_range_text(range);
        groups.push_back(drawing_group(dimensions));
        groups.push_back(working_range_group(range));
      }
    groups.front().add_text("summary", text);
    const std::string details = details_of(trials_, found);
    if (!details.empty()) {
      groups.front().add_text("details", details);
      text += fmt::format("`bristle info {}` has the shares of the tolerances and other optima\n",
                          shell_quoted(options_.output));
    }
    const run::Summary summary = run::write_result(all, options_.output, run::KeyedPoints(all.sweep, points),
                                                   {}, groups, journal_, entries, *progress_);
    if (!options_.quiet) {
      fmt::print("{}: points: {}\n{}", options_.output, summary.text(), summary.phases());
      summary.report_validity();
    }
    return {text, !found.chosen.empty() && broken_constraints(design_, found).empty()};
  }

 private:
  // Returns the solver of the trials. The progress counts only the points of the search's trials, because the
  // number of other points is not known.
  Solve solver() {
    return [this](const Sweep& sweep, const std::vector<std::size_t>& points, Purpose purpose) {
      const bool counted = searching_ && purpose == Purpose::trials;
      return run::solve_points(sweep, points, options_, journal_, counted ? *progress_ : silent_);
    };
  }

  Findings search() {
    Findings out;
    const auto evaluate = [&](const std::vector<Point>& points) {
      std::vector<Values> nominal;
      for (const Point& point : points) nominal.push_back(trials_.at(point));
      std::vector<Score> scores;
      for (Trial& trial : trials_.evaluate(nominal)) {
        scores.push_back(trials_.score_of(trial));
        out.trials.push_back(std::move(trial));
      }
      return scores;
    };
    out.optima = search_minima(design_.variables.size(), design_.budget, design_.seed, evaluate,
                               design_.objective.goal == Goal::target);
    searching_ = false;
    if (design_.start.size() == design_.variables.size()) add_start(out);
    choose(out);
    return out;
  }

  // Adds the trial of the experiment's own values, so that no worse one is recommended. Values outside the
  // bounds of the variables are only compared with.
  void add_start(Findings& found) {
    Trial trial = trials_.evaluate({trials_.with_tolerances(design_.start)}).front();
    const auto is_inside = [&](const experiment::Range& range) {
      const double value = design_.start.at(range.name);
      return range.low <= value && value <= range.high;
    };
    if (!std::ranges::all_of(design_.variables, is_inside)) {
      found.start_outside = std::move(trial);
      return;
    }
    found.start_trial = found.trials.size();
    found.trials.push_back(std::move(trial));
  }

  void choose(Findings& found) const {
    std::vector<Score> scores;
    for (const Trial& trial : found.trials) scores.push_back(trials_.score_of(trial));
    found.chosen = found.optima;
    found.best = std::size_t(std::ranges::min_element(scores, better) - scores.begin());
    std::erase_if(found.chosen, [&](std::size_t i) { return scores[i].violation > 0; });
    if (found.chosen.empty() && scores[found.best].violation == 0) found.chosen = {found.best};
    if (const auto start = found.start_trial;
        start && !found.chosen.empty() && better(scores[*start], scores[found.chosen.front()]))
      found.chosen.insert(found.chosen.begin(), *start);
    // If a local minimum of the distance from a target meets the target, only such minima are solutions.
    if (std::ranges::any_of(found.chosen, [&](std::size_t i) { return scores[i].is_met; }))
      std::erase_if(found.chosen, [&](std::size_t i) { return !scores[i].is_met; });
    if (const auto start = found.start_trial;
        found.not_worth && scores[*start].violation == 0 && !found.chosen.empty()) {
      if (!variables_matter(found, found.trials[*start])) found.chosen.clear();
      found.chosen.insert(found.chosen.begin(), *start);
    }
  }

  // Locates the jump margins of the chosen trials and of the best one. The search has judged each trial
  // by only two neighbours per quantity, between which a jump may lie. Returns true if a trial turned out to
  // be nearer to a jump than required.
  bool locate_margins(Findings& found) {
    bool any_nearer = false;
    std::set<std::size_t> reported(found.chosen.begin(), found.chosen.end());
    if (found.trials[found.best].violation == 0) reported.insert(found.best);
    for (const std::size_t i : reported) {
      if (!located_.insert(i).second) continue;
      trials_.set_jump_margin(found.trials[i], trials_.located_margin(found.trials[i].nominal));
      any_nearer = any_nearer || found.trials[i].violation > 0;
    }
    return any_nearer;
  }

  // Returns the profiles of all quantities through these values.
  std::vector<Profile> profiles_at(const Values& nominal) const {
    std::vector<Profile> out;
    for (const std::string& quantity : design_.quantities())
      out.push_back(
          trials_.profile(nominal, quantity, profile_values(design_, quantity, nominal.at(quantity))));
    return out;
  }

  // Looks beside the recommended trial. Its profiles have more values than the search for its margin; if they
  // show a jump that is nearer than required, the next trial is recommended.
  void recommend(Findings& found) {
    for (; !found.chosen.empty(); choose(found)) {
      progress_->stage("computing what is beside the recommended trial");
      if (design_.jump_margin > 0 && locate_margins(found)) continue;
      Trial& best = found.trials[found.chosen.front()];
      found.profiles = profiles_at(best.nominal);
      const double margin = least_margin(found.profiles);
      if (design_.jump_margin > 0) trials_.set_jump_margin(best, margin);
      if (margin < design_.jump_margin) continue;
      look_beside(found, best.nominal);
      if (!is_start_as_good(found)) break;
      found.not_worth_trial = found.chosen.front();
      found.not_worth = {recommended(found), std::move(found.verification)};
    }
    if (found.chosen.empty() || found.chosen.front() != found.start_trial) found.not_worth.reset();
  }

  // Returns true if the recommended brush gains nothing over the start that is worth a change: the start
  // meets the constraints, and the target if the brush meets it.
  bool is_start_as_good(const Findings& found) const {
    const auto start = found.start_trial;
    if (!start || found.chosen.front() == *start || found.trials[*start].violation > 0) return false;
    if (meets_target(design_, recommended(found)) && !meets_target(design_, found.trials[*start]))
      return false;
    if (start_alone_violates(found)) return false;
    return !is_worth(design_, *gain_of(design_, found, recommended_outcome(found)));
  }

  // Returns the best trial beside this one that can be made and meets the constraints or, if none meets them,
  // the one that comes nearest.
  Trial made(const Values& chosen) const {
    std::vector<Trial> all = trials_.evaluate(trials_.rounded_to_steps(chosen));
    for (;;) {
      std::vector<std::size_t> valid;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].violation == 0) valid.push_back(i);
      if (valid.empty()) return *std::ranges::min_element(all, {}, &Trial::violation);
      const auto cost_of = [&](std::size_t i) { return cost(design_.objective, all[i].objective.value); };
      Trial& best = all[*std::ranges::min_element(valid, {}, cost_of)];
      if (design_.jump_margin > 0) trials_.set_jump_margin(best, trials_.located_margin(best.nominal));
      if (best.violation == 0) return best;
    }
  }

  // Computes what the recommended brush is compared with, and verifies it as it can be made.
  void look_beside(Findings& found, const Values& chosen) {
    found.made.reset();
    // The start needs no rounding, because it is a brush that exists.
    if (!design_.round_to.empty() && found.chosen.front() != found.start_trial) {
      progress_->stage("computing what can be made beside the recommended trial");
      found.made = made(chosen);
      found.profiles = profiles_at(found.made->nominal);  // the margins belong to the brush that is made
    }
    const Values& best = recommended(found).nominal;
    if (!design_.tolerances.empty()) {
      progress_->stage("verifying the recommended brush by many deviations");
      const Trial* start = start_of(found);
      if (start && !found.start_verification) found.start_verification = trials_.verify(start->nominal);
      found.verification = &recommended(found) == start ? found.start_verification : trials_.verify(best);
      found.indices = trials_.indices(best);
    }
  }

  const Experiment& experiment_;
  const Design& design_;
  const run::RunOptions& options_;
  results::Journal journal_;
  std::optional<run::Progress> progress_;
  run::Progress silent_{experiment_.name, 0, true};
  bool searching_ = true;
  std::set<std::size_t> located_;  // trials whose jump margins are located
  Trials trials_;
};

}  // namespace

void validate_design(const Experiment& experiment) {
  if (experiment.ranges.empty()) return;
  const Design design = read_design(experiment);
  require_variables(experiment, design);
}

bool run_design(const Experiment& experiment, const run::RunOptions& options) {
  if (experiment.ranges.empty())
    throw InputError(fmt::format(
        "{}: /design: is missing; it says what to vary and what to look for (docs/your-own-brush.md)",
        experiment.path));
  if (experiment.document->contains(JsonPointer("/sweep/sample")))
    throw InputError(experiment.path +
                     ": /sweep/sample: the design chooses the points of the sample; remove it");
  validate_design(experiment);
  run::read_analysis(experiment);
  require_replaceable(options.output, results::result_file());
  if (options.shard || options.complete)
    throw InputError(experiment.path +
                     ": /design: a search cannot be split into shards; each trial follows from the others");
  if (!options.force && up_to_date(options.output, experiment)) {
    const results::ResultReader file(options.output);
    if (!options.quiet)
      fmt::print("{} is up to date: nothing to compute (--force computes it again)\n{}", options.output,
                 wrapped_lines(file.lines("trials", "summary"), terminal_columns()));
    return file.has("best") && !file.has(kViolated);
  }
  run::require_no_loss(experiment, options);
  run::install_signal_handlers();
  auto entries = run::provenance(options.arguments, options.threads);
  entries["started"] = run::utc_now();
  entries["experiment_file"] = experiment.path;
  const Design design = read_design(experiment);
  const auto [text, found] = Search(experiment, design, options).run(entries);
  if (!options.quiet) fmt::print("{}", wrapped_lines(text, terminal_columns()));
  return found;
}

}  // namespace bristle::design

#include "results/phases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::results {
namespace {

struct PhaseRow {
  BrushPhase phase;
  const char *name, *meaning;
};
constexpr PhaseRow kPhaseRows[] = {
    {BrushPhase::contact, "in contact", " (tips stay on the slab)"},
    {BrushPhase::bouncing, "bouncing", " (tips are off the slab for more than half of the time)"},
    {BrushPhase::mixed, "between contact and bouncing", ""}};

// Returns a number with two digits that count, without an exponent below 1e6.
std::string in_two_digits(double value) {
  const std::string text = fmt::format("{:.2g}", value);
  return text.find('e') == text.npos || std::abs(value) < 1 ? text : fmt::format("{:g}", std::stod(text));
}

// Local friction, R_rigid over R_n, below which a brush has the friction of rigid bristles at every load.
constexpr double kNothingToControl = 0.5;

// Returns the enumerator with this code, or `otherwise` of a number that is no code, as a damaged file may
// have.
template <class Enum>
Enum meaning_of(double code, Enum otherwise) {
  const bool known = code >= 0 && code < double(words<Enum>().size()) && code == std::floor(code);
  return known ? Enum(int(code)) : otherwise;
}

}  // namespace

std::string name_of(BrushPhase phase) {
  const auto* row = std::ranges::find(kPhaseRows, phase, &PhaseRow::phase);
  return row == std::end(kPhaseRows) ? "in an unknown phase" : row->name;
}

void Phases::Range::add(double value) {
  if (std::isnan(value)) return;
  from = std::min(from, value);
  to = std::max(to, value);
}

std::string Phases::Range::text() const {
  const auto low = in_two_digits(from), high = in_two_digits(to);
  return low == high ? low : low + " to " + high;
}

void Phases::add(const std::function<std::vector<double>(const std::string&)>& variable) {
  const auto phases = variable("phase"), ratios = variable("load_over_lift_off"),
             domains = variable("lift_off_domain");
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const auto phase = meaning_of(phases[i], BrushPhase::unknown);
    ++points_[std::size_t(phase)];
    if (phase == BrushPhase::unknown || i >= std::min(ratios.size(), domains.size())) continue;
    if (std::isnan(ratios[i])) {
      const auto domain = meaning_of(domains[i], LiftOffDomain::tested);
      if (domain != LiftOffDomain::tested) ++outside_[domain];
      continue;
    }
    ++tested_[std::size_t(phase)];
    bouncing_below_ += phase == BrushPhase::bouncing && ratios[i] < 1;
    in_contact_above_ += phase == BrushPhase::contact && ratios[i] >= 1;
  }
  const auto loads = variable("R_n_in_N"), speeds = variable("lift_off_speed");
  for (std::size_t i = 0; i < std::min(loads.size(), speeds.size()); ++i)
    if (!std::isnan(speeds[i])) load_of_speed_.add(loads[i]);
  const std::pair<const char*, Range*> ranges[] = {{"lift_off_load", &lift_off_},
                                                   {"lift_off_load_in_N", &lift_off_in_N_},
                                                   {"lift_off_speed", &speed_},
                                                   {"lift_off_speed_err", &speed_error_}};
  for (const auto& [name, range] : ranges)
    for (const double value : variable(name)) range->add(value);
  const auto R_n = variable("R_n"), R_x = variable("R_x"), R_x_norm = variable("R_x_norm");
  for (std::size_t i = 0; i < std::min({R_n.size(), R_x.size(), R_x_norm.size()}); ++i)
    local_friction_.add(R_x[i] / R_x_norm[i] / R_n[i]);
}

std::string Phases::text() const {
  std::vector<std::string> parts;
  for (const PhaseRow& row : kPhaseRows)
    if (const auto points = points_[std::size_t(row.phase)])
      parts.push_back(fmt::format("{} {}{}", points, row.name, row.meaning));
  if (parts.empty()) return "";
  return fmt::format("{}phases: {}\n{}", friction_text(), fmt::join(parts, ", "), lift_off_text());
}

std::string Phases::friction_text() const {
  const auto& [from, to] = local_friction_;
  if (!(from <= to)) return "";
  const std::string text =
      fmt::format("local friction coefficient (R_rigid/R_n): {}", local_friction_.text());
  if (to < kNothingToControl)
    return fmt::format(
        "{}; a brush then has nearly the friction of rigid bristles: there is nothing to control "
        "(docs/lift-off.md)\n",
        text);
  return text + (from < kNothingToControl
                     ? fmt::format("; below {} there is nothing to control\n", kNothingToControl)
                     : "\n");
}

std::string Phases::lift_off_text() const {
  const auto bouncing = tested_[std::size_t(BrushPhase::bouncing)],
             contact = tested_[std::size_t(BrushPhase::contact)];
  const bool si = lift_off_in_N_.from <= lift_off_in_N_.to;
  std::string text;
  if (lift_off_.from <= lift_off_.to) {
    text += fmt::format("lift-off load: {}{} (docs/lift-off.md)", (si ? lift_off_in_N_ : lift_off_).text(),
                        si ? " N" : "");
    std::vector<std::string> parts;
    if (bouncing)
      parts.push_back(fmt::format("{} of {} bouncing points carry less", bouncing_below_, bouncing));
    if (contact)
      parts.push_back(fmt::format("{} of {} points in contact carry more", in_contact_above_, contact));
    text += parts.empty() ? "\n" : fmt::format("; {}\n", fmt::join(parts, ", "));
  }
  // A brush has the same lift-off speed at all speeds of the slab, except for rounding.
  if (speed_.from <= speed_.to && speed_.to < speed_.from * (1 + 1e-3)) {
    const double factor = 1 + speed_error_.to / speed_.to;
    text += fmt::format("at {} N this brush lifts off above about {} m/s (between {} and {})\n",
                        load_of_speed_.text(), in_two_digits(speed_.to), in_two_digits(speed_.to / factor),
                        in_two_digits(speed_.to * factor));
  }
  for (const auto& [domain, points] : outside_)
    text += fmt::format(
        "lift-off load unknown at {} point{}: {}; a sweep of the load shows where the gap jumps\n", points,
        points == 1 ? "" : "s", outside_of(domain));
  return text;
}

}  // namespace bristle::results

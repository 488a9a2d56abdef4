#include "results/phases.hpp"

#include "sweep/si.hpp"
#include "util/units.hpp"

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

// Friction relative to rigid bristles from which on the bristles have changed too little to count.
constexpr double kNothingToControl = 0.9;
// Local friction below which nobody expects tips to lift off, so that a lift-off load is not missed.
constexpr double kWeakFriction = 1;

// Returns the enumerator with this code, or `otherwise` of a number that is no code, as a damaged file may
// have.
template <class Enum>
Enum meaning_of(double code, Enum otherwise) {
  const bool known = code >= 0 && code < double(words<Enum>().size()) && code == std::floor(code);
  return known ? Enum(int(code)) : otherwise;
}

// Returns a value in the unit in which it is read most easily.
std::string readable(double value, const char* units) {
  const ReadableUnit unit = readable_unit(units, value);
  return fmt::format("{:.3g} {}", value / unit.size, unit.name);
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
  for (const auto& [name, range] :
       {std::pair{"lift_off_load", &lift_off_}, std::pair{"lift_off_load_in_N", &lift_off_in_N_},
        std::pair{"R_x_norm", &R_x_norm_}})
    for (const double value : variable(name)) range->add(value);
  const auto R_n = variable("R_n"), R_x = variable("R_x"), R_x_norm = variable("R_x_norm");
  for (std::size_t i = 0; i < std::min({R_n.size(), R_x.size(), R_x_norm.size()}); ++i)
    local_friction_.add(R_x[i] / R_x_norm[i] / R_n[i]);
}

std::string load_text(const sweep::PointInput& point, double R_n) {
  if (point.si.empty()) return fmt::format("R_n = {:.3g}", R_n);
  return readable(R_n * sweep::si_scales(point).force, "N");
}

std::string carried_text(const sweep::PointInput& asked, double R_n, double z_0) {
  const std::string load = load_text(asked, asked.loading.R_n);
  if (std::isnan(R_n)) return fmt::format("no gap carries {} per bristle", load);
  const std::string most = fmt::format(
      "{} per bristle (gap {})", load_text(asked, R_n),
      asked.si.empty() ? fmt::format("{:.3g}", z_0) : readable(z_0 * sweep::si_scales(asked).length, "m"));
  // Where friction catches the tips of stiff bristles, the load does not rise from 0 at first contact.
  if (R_n >= asked.loading.R_n)
    return fmt::format(
        "the load does not rise from 0 at first contact, so no gap carries as little as {}; the brush "
        "carries at most {}",
        load, most);
  return fmt::format("the brush carries at most {}; you asked for {}", most, load);
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
  std::string text = fmt::format("local friction coefficient (R_rigid/R_n): {}", local_friction_.text());
  if (R_x_norm_.from >= kNothingToControl)
    text += fmt::format(
        "; at every point the brush has {} or more of the friction of rigid bristles: there is nothing to "
        "control",
        in_two_digits(std::floor(100 * R_x_norm_.from) / 100));
  return text + "\n";
}

std::string Phases::lift_off_text() const {
  const auto bouncing = tested_[std::size_t(BrushPhase::bouncing)],
             contact = tested_[std::size_t(BrushPhase::contact)];
  const bool si = lift_off_in_N_.from <= lift_off_in_N_.to;
  std::string text;
  if (lift_off_.from <= lift_off_.to) {
    text += fmt::format("lift-off load of point masses: {}{} (docs/lift-off.md)",
                        (si ? lift_off_in_N_ : lift_off_).text(), si ? " N" : "");
    std::vector<std::string> parts;
    if (bouncing)
      parts.push_back(fmt::format("{} of {} bouncing points carry less", bouncing_below_, bouncing));
    if (contact)
      parts.push_back(fmt::format("{} of {} points in contact carry more", in_contact_above_, contact));
    text += parts.empty() ? "\n" : fmt::format("; {}\n", fmt::join(parts, ", "));
  }
  const bool weak = local_friction_.from <= local_friction_.to && local_friction_.to < kWeakFriction;
  for (const auto& [domain, points] : outside_)
    if (!weak)
      text += fmt::format(
          "lift-off load unknown at {} point{}: {}; a sweep of the load shows where the gap jumps\n", points,
          points == 1 ? "" : "s", outside_of(domain));
  return text;
}

}  // namespace bristle::results

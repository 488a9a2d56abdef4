#include "run/summary.hpp"

#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle::run {
namespace {

const std::vector<PointStatus> kWithoutValues = {PointStatus::unreachable, PointStatus::incomplete,
                                                 PointStatus::work_limit};

constexpr double kPinnedShare = 0.1;  // fraction of R_x

}  // namespace

Summary::Example Summary::example_of(const results::PointRecord& record, std::size_t index) {
  const auto value = [&](const char* name) {
    return record.layout->has(name) ? record.at(name) : std::numeric_limits<double>::quiet_NaN();
  };
  return {index, value("incomplete_theta_0"), value("R_n_largest"), value("z_0_of_R_n_largest")};
}

void Summary::add(const results::PointRecord& record, std::size_t index) {
  const auto status = PointStatus(std::lround(record.at("status")));
  ++counts_[std::size_t(status)];
  if (std::ranges::count(kWithoutValues, status) > 0) first_.try_emplace(status, example_of(record, index));
  phases_.add([&](const std::string& name) {
    return record.layout->has(name) ? std::vector{record.at(name)} : std::vector<double>();
  });
  const double share = record.at("pinned_share_R_x");
  pinned_ += share > kPinnedShare;
  if (share > largest_pinned_share_) largest_pinned_share_ = share;
  judged_ += record.at(kValidity.front().name) != double(Exceeds::unknown);
  for (std::size_t row = 0; row < kValidity.size(); ++row)
    exceeding_[row] += record.at(kValidity[row].name) == double(Exceeds::yes);
  ++points_;
  if (!record.failure.empty())
    failures_.push_back(fmt::format("{}: {}", sweep_.place(index), record.failure));
}

std::string Summary::text() const {
  std::string out;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (counts_[i] > 0)
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", counts_[i], words<PointStatus>()[i]);
  return out;
}

void Summary::report_failures() const {
  constexpr std::size_t most = 10;
  if (points_ > 0 && failures_.size() == points_)
    throw RunError(fmt::format("{}: no point could be computed; {}", path_, failures_.front()));
  for (std::size_t i = 0; i < std::min(most, failures_.size()); ++i)
    write_message(fmt::format("{}: failed: {}\n", path_, failures_[i]));
  if (failures_.size() > most)
    write_message(
        fmt::format("... and {} more; `bristle info {}` names all\n", failures_.size() - most, path_));
}

std::string Summary::cause_and_remedy(PointStatus status, const Example& example) const {
  const Setup& setup = sweep_.base.setup;
  const bool si = !sweep_.base.si.empty();
  switch (status) {
    case PointStatus::unreachable:
      return results::carried_text(sweep_.point(example.index), example.R_n_largest, example.z_0);
    case PointStatus::incomplete:
      return fmt::format(
          "the bristle with theta_0 = {:.4g} deg did not leave the slab within {} evaluations of the "
          "equations; raise /integrator/max_evaluations{}",
          example.incomplete_theta_0 * 180 / M_PI, setup.integrator.max_evaluations,
          !has_pole(sweep_.point(example.index).setup.parameters.bending) ? ""
          : si ? ", or /si/alpha_J, which acts near the pole"
               : ", or /model/alpha, which acts near the pole");
    default:
      return fmt::format(
          "all bristles together needed more than {} evaluations of the equations; raise "
          "/integrator/max_evaluations_per_point",
          setup.max_evaluations_per_point);
  }
}

void Summary::report_points_without_values() const {
  for (const auto& [status, example] : first_) {
    const long more = counts_[std::size_t(status)] - 1;
    write_message(fmt::format("{}: {} at {}{}: {}\n", path_, word(status), sweep_.place(example.index),
                              more > 0 ? fmt::format(" and {} more", more) : "",
                              cause_and_remedy(status, example)));
  }
}

void Summary::report_pinned_bristles() const {
  if (pinned_ == 0) return;
  write_message(fmt::format(
      "{}: at {} of {} points bristles that stay pinned at the pole carry more than {:.0f} % of R_x, up to "
      "{:.0f} "
      "%: that friction is a property of the polar coordinates; compare with {} (docs/model.md)\n",
      path_, pinned_, points_, 100 * kPinnedShare, 100 * largest_pinned_share_,
      sweep_.varies("bending") ? "the bending \"rod\"" : "--set /model/bending=rod"));
}

void Summary::report_validity() const {
  std::string text;
  for (std::size_t row = 0; row < kValidity.size(); ++row)
    if (exceeding_[row] > 0)
      text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", kValidity[row].meaning, exceeding_[row]);
  if (!text.empty())
    write_message(fmt::format(
        "{}: beyond limits of the model (docs/results-format.md), of {} points with a value: {}\n", path_,
        judged_, text));
}

}  // namespace bristle::run

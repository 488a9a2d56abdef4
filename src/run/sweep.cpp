#include "run/sweep.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <memory>

namespace bristle {

bool run_sweep(const Experiment& experiment, int threads, const std::function<void(PointReport&&)>& sink,
               const std::function<bool()>& stop) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  std::size_t next = 0;
  bool stopped = false;
  using Report = std::shared_ptr<PointReport>;
  const auto feed = [&](tbb::flow_control& control) -> std::size_t {
    stopped = stop();
    if (stopped || next == experiment.points()) control.stop();
    return next++;
  };
  const auto solve = [&](std::size_t index) -> Report {
    auto report = std::make_shared<PointReport>();
    report->index = index;
    const PointInput input = experiment.point(index);
    auto* bristles = experiment.record_bristles ? &report->bristles : nullptr;
    report->result = solve_point(input.interface, input.loading, bristles);
    return report;
  };
  const auto hand_over = [&](const Report& report) { sink(std::move(*report)); };
  // Points differ in cost by more than ten: enough of them in flight that a dear one holds up nobody.
  const std::size_t in_flight = 16 * std::size_t(threads);
  tbb::parallel_pipeline(in_flight,
                         tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, feed) &
                             tbb::make_filter<std::size_t, Report>(tbb::filter_mode::parallel, solve) &
                             tbb::make_filter<Report, void>(tbb::filter_mode::serial_in_order, hand_over));
  return !stopped;
}

}  // namespace bristle

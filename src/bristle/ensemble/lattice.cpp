#include "bristle/ensemble/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

namespace bristle {
namespace {

constexpr long kIntervalsPerRow = 4;  // intervals of the series in the time between rows
constexpr long kBatch = 4096;         // passages whose samples are held at the same time

// Integrals, over one interval, of the forces on the slab and of the number of bristles in contact. They are
// not yet divided by the length of the interval and by N_c0.
struct Impulse {
  double R_n = 0, R_x = 0, R_y = 0, time = 0;
};

Impulse& operator+=(Impulse& a, const Impulse& b) {
  a.R_n += b.R_n;
  a.R_x += b.R_x;
  a.R_y += b.R_y;
  a.time += b.time;
  return a;
}

// Returns the impulse in units of the nominal bristle.
Impulse operator*(const Impulse& a, const SiScales& unit) {
  const double time = unit.length / unit.velocity, force = unit.force * time;
  return {a.R_n * force, a.R_x * force, a.R_y * force, a.time * time};
}

Impulse operator-(const Impulse& a, const Impulse& b) {
  return {a.R_n - b.R_n, a.R_x - b.R_x, a.R_y - b.R_y, a.time - b.time};
}

// Sums independent contributions and estimates the standard error of the sum from the differences of
// successive contributions, whose expected value may vary slowly along the sequence (von Neumann et al., Ann.
// Math. Stat. 12 (1941) 153).
class Contributions {
 public:
  void add(double value) {
    if (count_ > 0) squares_ += (value - last_) * (value - last_) / 2;
    sum_ += value;
    last_ = value;
    ++count_;
  }
  double sum() const { return sum_; }
  double error() const {
    return count_ > 1 ? std::sqrt(squares_ * double(count_) / double(count_ - 1)) : INFINITY;
  }
  long count() const { return count_; }

 private:
  double sum_ = 0, squares_ = 0, last_ = 0;
  long count_ = 0;
};

// Returns the standard deviation of the series over its mean. The error follows from the effective number of
// independent values, given by the autocorrelation up to its first zero.
Quantity fluctuation_of(const std::vector<double>& series) {
  const std::size_t n = series.size();
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / double(n);
  const auto covariance = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t i = 0; i + lag < n; ++i) sum += (series[i] - mean) * (series[i + lag] - mean);
    return sum / double(n);
  };
  const double variance = covariance(0);
  double correlated = 0.5;
  for (std::size_t lag = 1; lag < n / 2; ++lag) {
    const double c = covariance(lag);
    if (c <= 0) break;
    correlated += c / variance;
  }
  const double value = std::sqrt(variance) / mean;
  return {value, value * std::sqrt(correlated / double(n))};
}

// Returns how to average an observable or a contribution to it by outcome.
Average average_of(Observable k) {
  for (std::size_t row = 0; row < kObservables.size(); ++row)
    if (k == row || (kObservables[row].unpinned != Unpinned::none && k == unpinned(row)))
      return kObservables[row].average;
  return Average::over_time;
}

class Lattice {
 public:
  Lattice(const Setup& setup, double z_0, const PassageRunner& run)
      : setup_(setup),
        run_(run),
        p_(setup.parameters),
        z_0_(z_0),
        start_(InitialStates(p_).at(z_0)),
        row_size_(std::lround(p_.L_y / p_.spacing)),
        interval_(p_.spacing / kIntervalsPerRow),
        window_start_(std::lround(std::ceil(lattice_start(setup) / interval_ - 1e-9))),
        series_(std::size_t(setup.orientation.rows * kIntervalsPerRow)) {}

  LatticeMean average() {
    const long rows = setup_.orientation.rows, step = std::max(1L, kBatch / row_size_);
    for (long row = 0; row < rows; row += step) {
      const long first = row * row_size_, last = std::min(row + step, rows) * row_size_;
      std::deque<DeviatingBristle> bristles;
      std::vector<PassageTask> tasks;
      for (long i = first; i < last; ++i) {
        bristles.push_back(bristle(std::uint64_t(i)));
        tasks.push_back(task(bristles.back(), random_azimuth(setup_.orientation, std::uint64_t(i))));
      }
      std::vector<Passage> passages = run_(tasks);
      for (long i = first; i < last; ++i)
        add_passage(i / row_size_, passages[std::size_t(i - first)], bristles[std::size_t(i - first)]);
    }
    finish();
    return std::move(out_);
  }

 private:
  double N_c0() const { return double(row_size_) * p_.L_x / p_.spacing; }

  // Returns the bristle with this index in the lattice.
  DeviatingBristle bristle(std::uint64_t index) const {
    return deviating(p_, random_deviations(setup_.scatter, setup_.orientation.seed, index));
  }

  PassageTask task(const DeviatingBristle& bristle, double theta_0) const {
    const double length = bristle.unit.length, z_0 = z_0_ / length;
    const Parameters& p = bristle.parameters;
    return {&p, make_bristle(p, z_0, theta_0), setup_.scatter.any() ? InitialStates(p).at(z_0) : start_,
            setup_.integrator, interval_ / length};
  }

  void add_passage(long row, Passage& passage, const DeviatingBristle& bristle) {
    Impulse previous, in_window;
    std::size_t at = std::size_t(row * kIntervalsPerRow);
    const auto add_until = [&](const Impulse& now) {
      if (at < series_.size()) series_[at] += now - previous;
      if (at < series_.size() && at >= window_start_) in_window += now - previous;
      previous = now;
      ++at;
    };
    double time = 0;
    const SiScales& unit = bristle.unit;
    for (const PathSample& s : passage.samples)
      add_until(Impulse{s.normal, s.friction_x, s.friction_y, time += interval_ / unit.length} * unit);
    const OdeState& end = passage.end;
    add_until(Impulse{end[component::NORMAL], end[component::FRICTION_X], end[component::FRICTION_Y],
                      passage.contact_time} *
              unit);
    passage.samples.clear();
    passage.samples.shrink_to_fit();
    add_contribution(passage, bristle, in_window);
  }

  void add_contribution(const Passage& passage, const DeviatingBristle& bristle, const Impulse& in_window) {
    if (!passage.complete() && out_.incomplete++ == 0) out_.incomplete_theta_0 = passage.theta_0;
    ObservableArray value = observables(passage, bristle.parameters);
    const ObservableArray unit = units_of(bristle);
    for (Observable k = 0; k < OBSERVABLES; ++k) value[k] *= unit[k];
    value[R_N] = in_window.R_n;
    value[R_X] = in_window.R_x;
    value[R_Y] = in_window.R_y;
    value[N_C_RATIO] = in_window.time;
    split_by_outcome(value, passage.outcome);
    for (std::size_t k = 0; k < OBSERVABLES; ++k) contributions_[k].add(value[k]);
    out_.passages.push_back(passage);
  }

  void finish() {
    const double window = double(series_.size() - window_start_) * interval_;
    for (std::size_t k = 0; k < OBSERVABLES; ++k) {
      const double divisor =
          average_of(k) == Average::over_passages ? double(contributions_[k].count()) : window * N_c0();
      out_.mean[k] = contributions_[k].sum() / divisor;
      out_.error[k] = contributions_[k].error() / divisor;
    }
    out_.force.interval = interval_;
    const double divisor = interval_ * N_c0();
    for (const Impulse& i : series_) {
      out_.force.R_n.push_back(i.R_n / divisor);
      out_.force.R_x.push_back(i.R_x / divisor);
      out_.force.R_y.push_back(i.R_y / divisor);
      out_.force.N_c.push_back(i.time / divisor);
    }
    out_.fluctuation = fluctuation_of(window_means(1));
    out_.fluctuation_of_rows = fluctuation_of(window_means(kIntervalsPerRow));
  }

  // Returns R_n(t) within t_1..t_2, averaged over groups of `intervals` intervals.
  std::vector<double> window_means(std::size_t intervals) const {
    std::vector<double> out;
    const std::vector<double>& R_n = out_.force.R_n;
    for (std::size_t i = window_start_; i + intervals <= R_n.size(); i += intervals)
      out.push_back(std::accumulate(R_n.begin() + long(i), R_n.begin() + long(i + intervals), 0.0) /
                    double(intervals));
    return out;
  }

  const Setup& setup_;
  const PassageRunner& run_;
  const Parameters& p_;
  double z_0_;
  Equilibrium start_;
  long row_size_;             // bristles in a row
  double interval_;           // time between the values of the series, in units of r0/V0
  std::size_t window_start_;  // index of the first interval of t_1..t_2
  std::vector<Impulse> series_;
  std::array<Contributions, OBSERVABLES> contributions_;
  LatticeMean out_;
};

}  // namespace

double lattice_start(const Setup& setup) {
  const double t_1 = setup.orientation.t_1;
  return t_1 < 0 ? 2 * setup.parameters.L_x : t_1;
}

double lattice_end(const Setup& setup) { return double(setup.orientation.rows) * setup.parameters.spacing; }

double bristles_per_width(const Parameters& p) { return p.L_x / (p.spacing * p.spacing); }

LatticeMean lattice_mean(const Setup& setup, double z_0, const PassageRunner& run) {
  return Lattice(setup, z_0, run).average();
}

}  // namespace bristle

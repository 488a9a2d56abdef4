#include "run/passage_memo.hpp"

#include "bristle/random.hpp"

#include <boost/multi_index/hashed_index.hpp>
#include <boost/multi_index/member.hpp>
#include <boost/multi_index/sequenced_index.hpp>
#include <boost/multi_index_container.hpp>
#include <algorithm>
#include <bit>
#include <functional>
#include <mutex>
#include <type_traits>

namespace bristle::run {
namespace {

namespace index = boost::multi_index;

// These fail when a member is added, which a key must then contain.
static_assert(sizeof(IntegratorOptions) == 4 * sizeof(double));
static_assert(sizeof(Equilibrium) == 2 * sizeof(double));
static_assert(sizeof(PassageTask) == sizeof(void*) + sizeof(Bristle<double>) + sizeof(Equilibrium) +
                                         sizeof(IntegratorOptions) + sizeof(double));

struct Entry {
  PassageKey key;
  Passage passage;
};

// The entry, its links and its share of the hash table, and what the allocator adds.
constexpr std::size_t kBytesPerPassage = sizeof(Entry) + 8 * sizeof(void*);

template <class T>
std::string bytes_of(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

// Returns all that the passages of a brush depend on beside their tasks. The bytes of Parameters have no
// padding, as choices() requires, and tell -0 from 0.
std::string brush_of(const Parameters& parameters, Engine engine) {
  return bytes_of(parameters) + bytes_of(engine);
}

PassageKey key_of(std::uint64_t brush, const PassageTask& task) {
  const IntegratorOptions& options = task.integrator;
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  return {brush,
          bits(task.bristle.z_0),
          bits(task.bristle.theta_0),
          bits(task.start.r),
          bits(task.start.phi),
          bits(options.rtol),
          bits(options.atol),
          std::uint64_t(options.method),
          std::uint64_t(options.max_evaluations)};
}

}  // namespace

std::size_t PassageKeyHash::operator()(const PassageKey& key) const {
  std::uint64_t hash = 0;
  for (const std::uint64_t word : key) hash = (std::rotl(hash, 5) ^ word) * kSplitMixStep;
  return split_mix(hash);
}

struct PassageMemo::Store {
  // The entries by key, and from the one used last to the one used least recently.
  index::multi_index_container<
      Entry,
      index::indexed_by<index::hashed_unique<index::member<Entry, PassageKey, &Entry::key>, PassageKeyHash>,
                        index::sequenced<>>>
      entries;
  std::mutex mutex;
};

PassageMemo::PassageMemo(std::size_t bytes)
    : most_(bytes / kBytesPerPassage), store_(std::make_unique<Store>()) {}
PassageMemo::~PassageMemo() = default;

std::vector<std::size_t> PassageMemo::share(const Sweep& sweep, const std::vector<std::size_t>& points) {
  if (most_ == 0) return points;
  if (std::ranges::find(laws_, sweep.friction_law) == laws_.end()) laws_.push_back(sweep.friction_law);
  // Hash of the brush, place in points. Of brushes with one hash, the first is shared, which costs time only.
  std::vector<std::pair<std::size_t, std::size_t>> by_brush;
  for (std::size_t place = 0; place < points.size(); ++place) {
    const sweep::PointInput point = sweep.point(points[place]);
    std::string brush = brush_of(point.setup.parameters, sweep.engine);
    if (point.loading.z_0) brush += bytes_of(*point.loading.z_0);
    by_brush.emplace_back(std::hash<std::string>()(brush), place);
  }
  std::ranges::sort(by_brush);
  std::vector<std::pair<std::size_t, std::size_t>> order;  // first place of the brush, place
  for (auto from = by_brush.begin(); from != by_brush.end();) {
    const auto to =
        std::find_if(from, by_brush.end(), [&](const auto& other) { return other.first != from->first; });
    const std::size_t first = from->second;
    if (to - from > 1)
      brushes_.try_emplace(brush_of(sweep.point(points[first]).setup.parameters, sweep.engine),
                           brushes_.size());
    for (; from != to; ++from) order.emplace_back(first, from->second);
  }
  std::ranges::sort(order);
  std::vector<std::size_t> out;
  for (const auto& [first, place] : order) out.push_back(points[place]);
  return out;
}

std::vector<PassageKey> PassageMemo::keys_of(const std::vector<PassageTask>& tasks, Engine engine) const {
  if (brushes_.empty()) return {};
  std::vector<PassageKey> keys;
  const Parameters* parameters = nullptr;
  std::uint64_t brush = 0;
  for (const PassageTask& task : tasks) {
    if (task.sample_interval > 0) return {};  // samples would need much memory
    if (task.parameters != parameters) {
      const auto known = brushes_.find(brush_of(*task.parameters, engine));
      if (known == brushes_.end()) return {};
      parameters = task.parameters;
      brush = known->second;
    }
    keys.push_back(key_of(brush, task));
  }
  return keys;
}

std::optional<Passage> PassageMemo::find(const PassageKey& key) {
  const std::lock_guard lock(store_->mutex);
  const auto entry = store_->entries.find(key);
  if (entry == store_->entries.end()) return {};
  auto& by_use = store_->entries.get<1>();
  by_use.relocate(by_use.begin(), store_->entries.project<1>(entry));
  return entry->passage;
}

void PassageMemo::store(const PassageKey& key, const Passage& passage) {
  const std::lock_guard lock(store_->mutex);
  auto& by_use = store_->entries.get<1>();
  by_use.push_front({key, passage});
  if (by_use.size() > most_) by_use.pop_back();
}

std::vector<Passage> PassageMemo::run(const std::vector<PassageTask>& tasks, Engine engine,
                                      const PassageRunner& compute) {
  const std::vector<PassageKey> keys = keys_of(tasks, engine);
  if (keys.empty()) return compute(tasks);
  std::vector<Passage> out(tasks.size());
  std::vector<PassageTask> missing;
  std::vector<std::size_t> places;  // of the missing passages
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (auto known = find(keys[i])) {
      out[i] = *std::move(known);
    } else {
      missing.push_back(tasks[i]);
      places.push_back(i);
    }
  const std::vector<Passage> computed = missing.empty() ? std::vector<Passage>() : compute(missing);
  for (std::size_t i = 0; i < computed.size(); ++i) {
    out[places[i]] = computed[i];
    store(keys[places[i]], computed[i]);
  }
  return out;
}

std::size_t PassageMemo::size() const {
  const std::lock_guard lock(store_->mutex);
  return store_->entries.size();
}

}  // namespace bristle::run

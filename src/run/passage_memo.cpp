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
  RequestKey key;
  std::vector<Passage> passages;
};

// Returns the bytes of an entry with its links, its share of the hash table, and what the allocator adds.
std::size_t bytes_of_entry(const Entry& entry) {
  return sizeof(Entry) + 12 * sizeof(void*) + entry.key.size() * sizeof(entry.key.front()) +
         entry.passages.size() * sizeof(Passage);
}

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

void add_task(RequestKey& key, std::uint64_t brush, const PassageTask& task) {
  const IntegratorOptions& options = task.integrator;
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  for (const std::uint64_t word :
       {brush, bits(task.bristle.z_0), bits(task.bristle.theta_0), bits(task.start.r), bits(task.start.phi),
        bits(options.rtol), bits(options.atol), std::uint64_t(options.method),
        std::uint64_t(options.max_evaluations)})
    key.push_back(word);
}

}  // namespace

std::size_t RequestKeyHash::operator()(const RequestKey& key) const {
  std::uint64_t hash = 0;
  for (const std::uint64_t word : key) hash = (std::rotl(hash, 5) ^ word) * kSplitMixStep;
  return split_mix(hash);
}

struct PassageMemo::Store {
  // The entries by key, and from the one used last to the one used least recently.
  index::multi_index_container<
      Entry,
      index::indexed_by<index::hashed_unique<index::member<Entry, RequestKey, &Entry::key>, RequestKeyHash>,
                        index::sequenced<>>>
      entries;
  std::size_t bytes = 0;  // of all entries
  std::mutex mutex;
};

PassageMemo::PassageMemo(std::size_t bytes) : most_(bytes), store_(std::make_unique<Store>()) {}
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

RequestKey PassageMemo::key_of(const std::vector<PassageTask>& tasks, Engine engine) const {
  if (brushes_.empty()) return {};
  RequestKey key;
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
    add_task(key, brush, task);
  }
  return key;
}

std::optional<std::vector<Passage>> PassageMemo::find(const RequestKey& key) {
  const std::lock_guard lock(store_->mutex);
  const auto entry = store_->entries.find(key);
  if (entry == store_->entries.end()) return {};
  auto& by_use = store_->entries.get<1>();
  by_use.relocate(by_use.begin(), store_->entries.project<1>(entry));
  return entry->passages;
}

void PassageMemo::store(const RequestKey& key, const std::vector<Passage>& passages) {
  const std::lock_guard lock(store_->mutex);
  auto& by_use = store_->entries.get<1>();
  const auto [entry, is_new] = by_use.push_front({key, passages});
  if (is_new) store_->bytes += bytes_of_entry(*entry);
  for (; store_->bytes > most_; by_use.pop_back()) store_->bytes -= bytes_of_entry(by_use.back());
}

std::vector<Passage> PassageMemo::run(const std::vector<PassageTask>& tasks, Engine engine,
                                      const PassageRunner& compute) {
  const RequestKey key = key_of(tasks, engine);
  if (key.empty()) return compute(tasks);
  if (auto known = find(key)) return *std::move(known);
  std::vector<Passage> out = compute(tasks);
  store(key, out);
  return out;
}

std::size_t PassageMemo::size() const {
  const std::lock_guard lock(store_->mutex);
  std::size_t count = 0;
  for (const Entry& entry : store_->entries) count += entry.passages.size();
  return count;
}

}  // namespace bristle::run

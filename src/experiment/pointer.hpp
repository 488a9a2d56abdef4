#pragma once

#include <string>
#include <vector>

namespace bristle::experiment {

// Returns the changes "/json/pointer=value" for changes as people write them, where "k_r=20" stands for
// "/model/k_r=20". Throws InputError for a key that no block has, or that several have.
std::vector<std::string> with_pointers(const std::vector<std::string>& changes);

}  // namespace bristle::experiment

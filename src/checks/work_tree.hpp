#pragma once

#include <string>

namespace bristle {

// Throws InputError unless folder, which need not exist, lies in a git work tree in which nothing outside of
// it differs from the commit: what is recorded there then follows from a state that can be had again.
void require_clean_work_tree(const std::string& folder);

}  // namespace bristle

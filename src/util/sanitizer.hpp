#pragma once

namespace bristle {

// Whether this is a build with a sanitizer of addresses or threads. These sanitizers do not support coroutines'
// stacks, and reserve more address space than a limited process may have.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

}  // namespace bristle

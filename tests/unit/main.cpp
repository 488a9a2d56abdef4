#define CATCH_CONFIG_RUNNER
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "catch.hpp"

#include "results/hdf5.hpp"

#include <dlfcn.h>
#include <pthread.h>
#include <atomic>
#include <cstdlib>
#include <iostream>

namespace {
std::atomic<int> threads_started = 0;
bool any_untagged = false;

// Finds tests that start threads without the tag [threads]: the sanitizer of threads runs the tagged ones.
struct ThreadTags : Catch::TestEventListenerBase {
  using Catch::TestEventListenerBase::TestEventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo& started) override {
    test = &started;
    threads_started = 0;
  }
  void testCaseEnded(const Catch::TestCaseStats&) override {
    if (threads_started == 0 || Catch::has_tag(*test, "threads")) return;
    std::cout << "FAILED: this test starts threads; give it the tag [threads]: " << test->name << "\n";
    any_untagged = true;
  }

 private:
  const Catch::TestCaseInfo* test = nullptr;
};
CATCH_REGISTER_LISTENER(ThreadTags)
}  // namespace

// Sanitizers have a function of their own in this place.
#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
// Counts the threads that are started, and starts them as the C library does.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                              void* argument) noexcept {
  static const auto create = reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  ++threads_started;
  return create(thread, attributes, start, argument);
}
#endif

int main(int argc, char** argv) {
  bristle::h5::silence();
  // Set where a git hook runs the tests, which make repositories of their own.
  for (const char* name : {"GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE"}) unsetenv(name);
  const int failures = Catch::Session().run(argc, argv);
  return failures == 0 && any_untagged ? 1 : failures;
}

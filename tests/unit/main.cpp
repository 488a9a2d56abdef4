#define CATCH_CONFIG_RUNNER
#include "catch.hpp"

#include "results/hdf5.hpp"

#include <cstdlib>

int main(int argc, char** argv) {
  bristle::h5::silence();
  // Set where a git hook runs the tests, which make repositories of their own.
  for (const char* name : {"GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE"}) unsetenv(name);
  return Catch::Session().run(argc, argv);
}

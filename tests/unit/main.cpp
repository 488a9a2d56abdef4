#define CATCH_CONFIG_RUNNER
#include "catch.hpp"

#include "results/hdf5.hpp"

int main(int argc, char** argv) {
  bristle::h5::silence();
  return Catch::Session().run(argc, argv);
}

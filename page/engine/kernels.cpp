#include "bristle/simd/dispatch.hpp"

namespace bristle {

namespace N_EMU128 {
extern const Kernels kKernels;
}

// The page has the kernels of one instruction set.
const Kernels& best_kernels() { return N_EMU128::kKernels; }

}  // namespace bristle

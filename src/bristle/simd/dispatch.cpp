#include "bristle/simd/dispatch.hpp"

#include <hwy/targets.h>

namespace bristle {

namespace N_SCALAR {
extern const Kernels kKernels;
}
#if HWY_ARCH_X86
namespace N_AVX3 {
extern const Kernels kKernels;
}
namespace N_AVX2 {
extern const Kernels kKernels;
}
#else
namespace N_NEON {
extern const Kernels kKernels;
}
#endif

std::vector<const Kernels*> available_kernels() {
  const auto supported = hwy::SupportedTargets();
  std::vector<const Kernels*> out;
#if HWY_ARCH_X86
  if (supported & HWY_AVX3) out.push_back(&N_AVX3::kKernels);
  if (supported & HWY_AVX2) out.push_back(&N_AVX2::kKernels);
#else
  if (supported & HWY_NEON) out.push_back(&N_NEON::kKernels);
#endif
  out.push_back(&N_SCALAR::kKernels);
  return out;
}

namespace {

const Kernels* preferred = nullptr;

}  // namespace

bool prefer_kernels(const std::string& target) {
  for (const Kernels* kernels : available_kernels())
    if (kernels->target == target) preferred = kernels;
  return preferred && preferred->target == target;
}

const Kernels& best_kernels() {
  if (preferred) return *preferred;
  return *available_kernels().front();
}

}  // namespace bristle

#pragma once

#include "bristle/ensemble/point.hpp"

namespace bristle {

// Phase of a brush, of those bristles that touch the slab. contact: the tips stay on the slab, bent and
// dragged. bouncing: the tips are off the slab most of the time. mixed: neither. unknown: the point has no
// values, or the slab touches no bristle.
enum class BrushPhase {
  contact,
  bouncing,
  mixed,
  unknown
};
template <>
inline Words words<BrushPhase>() {
  static constexpr const char* list[] = {"contact", "bouncing", "mixed", "unknown"};
  return list;
}

// Largest share of the time off the slab at which a brush is in contact, and smallest at which it bounces.
constexpr double kContactShare = 0.05, kBouncingShare = 0.5;

inline BrushPhase phase_of(const PointResult& point) {
  const double untouched = point.value[observable("untouched_fraction")];
  const double share = (point.value[observable("off_slab_share")] - untouched) / (1 - untouched);
  if (std::isnan(share)) return BrushPhase::unknown;
  if (share <= kContactShare) return BrushPhase::contact;
  return share >= kBouncingShare ? BrushPhase::bouncing : BrushPhase::mixed;
}

}  // namespace bristle

#pragma once

#include "bristle/ensemble/point.hpp"

namespace bristle {

// What the bristles of a brush do: contact, their tips stay on the slab, bent and dragged; bouncing, their
// tips are off the slab most of the time; mixed, neither. Unknown without values.
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

// Shares of the time for which tips are off the slab: at most in contact, and at least where brushes bounce.
constexpr double kContactShare = 0.05, kBouncingShare = 0.5;

inline BrushPhase phase_of(const PointResult& point) {
  const double share = point.value[observable("off_slab_share")];
  if (std::isnan(share)) return BrushPhase::unknown;
  if (share <= kContactShare) return BrushPhase::contact;
  return share >= kBouncingShare ? BrushPhase::bouncing : BrushPhase::mixed;
}

}  // namespace bristle

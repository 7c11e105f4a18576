// Keys that a case may leave out, and what holds then: friction and rolling resistance, and what walls have of their
// own.
#pragma once

#include "kernel/case.hpp"

namespace fixdem::reference {

template <class Case>
double wall_friction() {
  if constexpr (requires { Case::wall_friction; })
    return Case::wall_friction;
  else
    return Case::friction;
}

template <class Case>
double wall_restitution() {
  if constexpr (requires { Case::wall_restitution; })
    return Case::wall_restitution;
  else
    return Case::restitution;
}

template <class Case>
double rolling_friction() {
  if constexpr (requires { Case::rolling_friction; })
    return Case::rolling_friction;
  else
    return 0;
}

/// A wall without friction turns nothing.
template <class Case>
double wall_rolling_friction() {
  if constexpr (requires { Case::wall_rolling_friction; })
    return Case::wall_rolling_friction;
  else
    return wall_friction<Case>() > 0 ? rolling_friction<Case>() : 0;
}

template <class Case>
bool friction_is_limited_by_elastic_force() {
  if constexpr (requires { Case::friction_limit; })
    return Case::friction_limit == FrictionLimit::elastic;
  else
    return false;
}

}  // namespace fixdem::reference

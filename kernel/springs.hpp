// Stiffness and damping of a contact at its present overlap: eqs. (15)-(22), (26)-(31); scaled as in contact_law.hpp.
#pragma once

#include "contact_bodies.hpp"

namespace fixdem {

/// Stiffness and damping of a contact at its present overlap.
template <class V>
struct Springs {
  V repulsion;             ///< K overlap^(3/2), scaled
  V damping;               ///< eta, scaled
  V tangential_stiffness;  ///< k_t, scaled
};

/// What the springs follow from: the repulsion, and the root of the overlap (linear law: one where there is overlap).
template <class V>
struct SpringBase {
  V repulsion, root;
};

/// From the overlap [m]; zero where there is none. With several sizes the root is that of overlap times R*/r_0.
template <class Law, class Case, class V, class Bodies>
FIXDEM_INLINE SpringBase<V> spring_base(V overlap, const Bodies& bodies) {
  if constexpr (Derived<Case>::is_hertz) {
    const V root = sqrt(bodies.times_radius(overlap));
    return {constant<V>(Law::stiffness) * overlap * root, root};
  } else {
    return {constant<V>(Law::stiffness) * overlap, where(overlap > V{}, splat<V>(1.0))};
  }
}

/// Stiffness and damping; zero where there is no overlap.
template <class Law, class Case, class V, class Bodies>
FIXDEM_INLINE Springs<V> springs(const SpringBase<V>& base, const Bodies& bodies) {
  const V root = base.root;
  if constexpr (Derived<Case>::is_hertz || has_sizes<Case>)
    return {base.repulsion, constant<V>(Law::damping) * sqrt(bodies.times_mass(root)),
            constant<V>(Law::tangential_stiffness) * root};
  else
    return {base.repulsion, constant<V>(Law::damping) * root, constant<V>(Law::tangential_stiffness) * root};
}

}  // namespace fixdem

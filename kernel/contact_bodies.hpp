// The two bodies of a contact: what their radii and masses make of its coefficients; eqs. (42), (43), (45), (47).
//
// The law needs the reduced mass M and the reduced radius R*, 1/M = 1/m_i + 1/m_j and 1/R* = 1/r_i + 1/r_j (a wall adds
// nothing to either), in units of the sphere of reference, m_0 and r_0 (case.hpp):
//   m_0/M    a force f scaled by time_step / m_0 changes the relative velocity by this times f, and the slip by 3.5
//            times that: a tangential force changes the spin, too, by 5/2 of it
//   R*/r_0   Hertz' stiffnesses grow with its root, eta with the root of stiffness times M
// With equal spheres all of this is known at compile time: m_0/M is 2 between them and 1 at a wall, and the
// coefficients in ContactLaw are those of the contact. With several sizes they are those for M = m_0 and R* = r_0.
//
// Rolling (rolling.hpp) needs the levers R*/r of both bodies as well.
#pragma once

#include "case.hpp"
#include "row_lanes.hpp"

namespace fixdem {

/// With equal spheres. Each function: a coefficient times `factor`, over `divisor`.
template <class Law, class Case, class V, bool several = has_sizes<Case>>
struct ContactBodies {
  FIXDEM_INLINE explicit ContactBodies(const Motion<V>&) {}
  FIXDEM_INLINE V count(double factor) const { return splat<V>(factor * Law::bodies); }  ///< m_0/M
  FIXDEM_INLINE V stiffness(double factor = 1) const { return splat<V>(factor * Law::stiffness); }
  FIXDEM_INLINE V stiffness_times_count(double factor) const { return splat<V>(factor * Law::stiffness * Law::bodies); }
  FIXDEM_INLINE V tangential_stiffness() const { return splat<V>(Law::tangential_stiffness); }
  FIXDEM_INLINE V damping(double factor = 1, double divisor = 1) const {
    return splat<V>(factor * Law::damping / divisor);
  }
  /// Of Hertz' springs: the overlap times R*, and its root times M.
  FIXDEM_INLINE V times_radius(V overlap) const { return overlap; }
  FIXDEM_INLINE V times_mass(V root) const { return root; }

  FIXDEM_INLINE V owner_lever() const { return splat<V>(1.0 / Law::bodies); }  ///< R*/r
  FIXDEM_INLINE V partner_lever() const { return splat<V>(1.0 / Law::bodies); }
  /// Half the change of the rolling velocity by a scaled rolling force, and by one of friction, which is also that of
  /// the slip by a rolling force: between equal spheres none.
  static constexpr bool rolling_meets_friction = Law::bodies == 1;
  FIXDEM_INLINE V half_rolling() const { return splat<V>(1.25 / Law::bodies); }
  FIXDEM_INLINE V half_of_both() const { return splat<V>(rolling_meets_friction ? 1.25 : 0); }
};

template <class Law, class Case, class V>
struct ContactBodies<Law, Case, V, true> {
  static constexpr bool rolling_meets_friction = true;
  V inverse_mass, mass{}, radius{};  ///< m_0/M, M/m_0, R*/r_0
  V root_of_radius{};                ///< for the impulse law, of R*/r_0
  V owner_mass{}, lever{};           ///< for rolling, m_0/m_i and R*/r_i

  FIXDEM_INLINE explicit ContactBodies(const Motion<V>& motion) : inverse_mass(motion.inverse_mass) {
    const V inverse = splat<V>(1) / (motion.inverse_mass * motion.inverse_radius);  // one quotient for both
    mass = inverse * motion.inverse_radius, radius = inverse * motion.inverse_mass;
    if constexpr (takes_impulses<Case> && Derived<Case>::is_hertz) root_of_radius = sqrt(radius);
    if constexpr (Law::has_rolling)
      owner_mass = motion.owner_inverse_mass, lever = radius * motion.owner_inverse_radius;
  }
  FIXDEM_INLINE V count(double factor) const { return splat<V>(factor) * inverse_mass; }
  FIXDEM_INLINE V stiffness(double factor = 1) const { return scaled(factor * Law::stiffness); }
  FIXDEM_INLINE V stiffness_times_count(double factor) const { return stiffness(factor) * inverse_mass; }
  FIXDEM_INLINE V tangential_stiffness() const { return scaled(Law::tangential_stiffness); }
  FIXDEM_INLINE V damping(double factor = 1, double divisor = 1) const {
    V square = mass;
    if constexpr (Derived<Case>::is_hertz) square = square * root_of_radius;
    return splat<V>(factor * Law::damping / divisor) * sqrt(square);
  }
  FIXDEM_INLINE V times_radius(V overlap) const { return overlap * radius; }
  FIXDEM_INLINE V times_mass(V root) const { return root * mass; }

  FIXDEM_INLINE V owner_lever() const { return lever; }
  FIXDEM_INLINE V partner_lever() const { return splat<V>(1) - lever; }
  FIXDEM_INLINE V half_rolling() const {
    const V other = partner_lever();
    return splat<V>(1.25) * fused(lever * lever, owner_mass, other * other * (inverse_mass - owner_mass));
  }
  FIXDEM_INLINE V half_of_both() const {
    return splat<V>(1.25) * fused(lever, owner_mass, partner_lever() * (owner_mass - inverse_mass));
  }

 private:
  FIXDEM_INLINE V scaled(double coefficient) const {
    if constexpr (Derived<Case>::is_hertz) return splat<V>(coefficient) * root_of_radius;
    return splat<V>(coefficient);
  }
};

}  // namespace fixdem

// Exact outcomes of all impacts (impacts.hpp) for each tangential law, and how sure they are.
//
// Output: one line per law and impact, `exact,law,number,normal,tangential,surface_spin,contact_time,maximum_overlap`;
// then `doubt,law,x`: the maximum change of any velocity, relative to the impact speed, when the tolerance of the
// solver is tightened from 1e-13 to 1e-15.
#include FIXDEM_CASE_HEADER

#include <fmt/format.h>

#include <cstdio>

#include "exact_impact.hpp"
#include "impacts.hpp"

namespace {

using namespace fixdem;
using Case = cases::FIXDEM_CASE;
using Scalar = long double;

frontier::Outcome outcome(const frontier::Impact& impact, TangentialLaw law, Scalar tolerance) {
  const auto sphere = reference::sphere_properties<Case, Scalar>();
  const auto coefficients =
      impact.is_pair ? reference::pair_coefficients<Case, Scalar>() : reference::wall_coefficients<Case, Scalar>();
  const Scalar effective = impact.is_pair ? sphere.mass / 2 : sphere.mass;
  frontier::ExactImpact solver(coefficients, Case::normal == NormalLaw::hertz, law, Derived<Case>::friction_limit,
                               sphere.mass, effective, tolerance);
  return solver.solve(impact.normal, impact.tangential);
}

}  // namespace

int main() {
  const std::pair<TangentialLaw, const char*> laws[] = {{TangentialLaw::displacement, "displacement"},
                                                        {TangentialLaw::force, "force"},
                                                        {TangentialLaw::rescale, "rescale"}};
  for (const auto& [law, name] : laws) {
    Scalar doubt = 0;
    for (int number = 0; number < frontier::impacts; ++number) {
      const frontier::Impact impact = frontier::impact(number);
      const auto found = outcome(impact, law, 1e-13L), finer = outcome(impact, law, 1e-15L);
      for (const Scalar change :
           {found.normal - finer.normal, found.tangential - finer.tangential, found.surface_spin - finer.surface_spin})
        doubt = std::max(doubt, std::abs(change) / impact.speed);
      fmt::print("exact,{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", name, number,
                 static_cast<double>(found.normal), static_cast<double>(found.tangential),
                 static_cast<double>(found.surface_spin), static_cast<double>(found.contact_time),
                 static_cast<double>(found.maximum_overlap));
    }
    fmt::print("doubt,{},{:.3g}\n", name, static_cast<double>(doubt));
  }
}

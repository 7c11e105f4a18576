#include "rules_of_thumb.hpp"

#include <algorithm>
#include <cmath>

#include "tools/run/contact_time.hpp"
#include "tools/run/fault_report.hpp"

namespace fixdem::stability {

std::vector<Rule> rules_of_thumb(const program::CaseFacts& facts, double youngs_modulus, double poisson_ratio,
                                 const std::vector<Contact>& contacts, double speed) {
  constexpr double pi = 3.14159265358979323846;
  std::vector<Rule> rules;
  if (facts.normal == NormalLaw::hertz) {
    const double shear = youngs_modulus / (2 * (1 + poisson_ratio));  // eq. (20)
    const double rayleigh =
        pi * facts.largest_radius() * std::sqrt(facts.density / shear) / (0.1631 * poisson_ratio + 0.8766);
    rules.push_back({"Rayleigh time", rayleigh});
    rules.push_back({"Rayleigh time / 5", rayleigh / 5});
  }
  const double hertz = program::contact_time(facts, speed);
  rules.push_back({"contact time at the maximum speed", hertz});
  rules.push_back({"contact time at the maximum speed / 20", hertz / fewest_steps_per_contact});
  if (contacts.empty()) return rules;

  const SpringNetwork network = network_of(facts, contacts);
  const std::vector<Spring>& springs = network.springs;
  const auto stiffest = std::max_element(
      springs.begin(), springs.end(), [](const Spring& a, const Spring& b) { return a.at.stiffness < b.at.stiffness; });
  const double cundall = 2 * std::sqrt(facts.mass / stiffest->at.stiffness);
  rules.push_back({"Cundall and Strack: 2 sqrt(m/k_n) of the stiffest contact", cundall});
  const double secant = facts.normal == NormalLaw::hertz ? std::sqrt(1.5) : 1;
  rules.push_back({"eq. (39): 2 sqrt(m/k) of the stiffest contact with k = force / overlap", cundall * secant});

  double shortest = INFINITY;
  for (const Spring& s : springs)
    shortest = std::min(shortest, undamped_critical_step(alone(network, s), Springs::all));
  rules.push_back({"all springs of the stiffest single contact", shortest});
  rules.push_back({"normal springs only, of all contacts", undamped_critical_step(network, Springs::normal)});
  rules.push_back({"all springs of all contacts, no damping", undamped_critical_step(network, Springs::all)});
  for (const program::StepCriterion& c : program::step_criteria)
    rules.push_back({std::string("all springs and dampers: ") + c.name, critical_step(network, c)});
  rules.push_back({"bound of the running program: blocks of single particles",
                   program::stable_step(facts, program::criterion_of(facts.integrator), contacts).seconds});
  return rules;
}

}  // namespace fixdem::stability

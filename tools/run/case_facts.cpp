#include "case_facts.hpp"

namespace fixdem::program {

const char* integrator_name(Integrator integrator) {
  switch (integrator) {
    case Integrator::leapfrog:
      return "leapfrog";
    case Integrator::impulse:
      return "impulse";
    default:
      return "euler";
  }
}

const char* precision_name(Precision precision) { return precision == Precision::mixed_precision ? "mixed" : "double"; }

std::vector<std::string> features(const CaseFacts& facts) {
  std::vector<std::string> list;
  if (facts.has_sizes()) list.push_back("several_sizes");
  list.push_back(facts.normal == NormalLaw::hertz ? "hertz" : "linear");
  if (facts.has_rotation) {
    list.push_back(facts.tangential == TangentialLaw::displacement ? "displacement"
                   : facts.tangential == TangentialLaw::force      ? "force"
                                                                   : "rescale");
    list.push_back(facts.slider == Slider::clip ? "clip" : facts.slider == Slider::exact ? "exact" : "paper");
    if (facts.friction_limit == FrictionLimit::elastic) list.push_back("elastic_friction_limit");
    list.push_back("rotation");
    if (facts.has_rolling) list.push_back("rolling_resistance");
  }
  if (facts.damping == Damping::critical) list.push_back("critical_damping");
  if (facts.damping_mass == DampingMass::particle) list.push_back("particle_damping_mass");
  if (facts.pair_contact.friction != facts.wall_contact.friction ||
      facts.pair_contact.restitution != facts.wall_contact.restitution ||
      facts.pair_contact.rolling_friction != facts.wall_contact.rolling_friction)
    list.push_back("own_walls");
  if (facts.has_wall) list.push_back("pipe_wall");
  list.push_back(facts.line.is_open ? "open_line" : facts.is_periodic ? "periodic" : "closed_ends");
  if (facts.has_gas) {
    list.push_back("gas");
    if (facts.bed_height == BedHeight::hard) list.push_back("hard_bed_height");
    if (facts.bed_height == BedHeight::strict) list.push_back("strict_bed_height");
  }
  list.push_back(integrator_name(facts.integrator));
  if (facts.energy_ledger) list.push_back("energy_ledger");
  return list;
}

}  // namespace fixdem::program

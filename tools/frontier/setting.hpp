// What the frontier varies: a case with another time step, integrator, slider, tangential law, precision, gas interval.
//
// The program is compiled with the case's header and, as macros, the names of the choices and the list of time steps in
// thousandths of the case's own:
//   -DFIXDEM_CASE=settle -DFIXDEM_CASE_HEADER='"cases/settle.hpp"' -DFIXDEM_INTEGRATOR=euler -DFIXDEM_SLIDER=clip
//   -DFIXDEM_PRECISION=double -DFIXDEM_FACTORS=500,1000,2000 [-DFIXDEM_TANGENTIAL=force]
//   [-DFIXDEM_GAS_FACTORS=200,5000]
// Intervals of the gas and of its floaters stay the same in seconds, as nearly as whole steps allow; the gas factors,
// in thousandths too, lengthen the first. The ledger is left as the case has it, since programs pay for it.
#pragma once

#include FIXDEM_CASE_HEADER

#include <utility>

namespace fixdem::frontier {

using Original = cases::FIXDEM_CASE;

#define FIXDEM_JOINED(a, b) a##b
#define FIXDEM_PRECISION_NAME(name) FIXDEM_JOINED(name, _precision)

/// Whole steps nearest to `steps` steps of the case, when the step is `permille` of the case's.
constexpr int scaled_interval(double steps, int permille) {
  const int n = static_cast<int>(steps * 1000 / permille + 0.5);
  return n < 1 ? 1 : n;
}

template <int permille, int gas_permille = 1000>
struct Setting : Original {
  static constexpr int factor = permille, gas_factor = gas_permille;
  static constexpr double time_step = Original::time_step * permille / 1000;
  static constexpr Integrator integrator = Integrator::FIXDEM_INTEGRATOR;
  static constexpr Slider slider = Slider::FIXDEM_SLIDER;
  static constexpr Precision precision = Precision::FIXDEM_PRECISION_NAME(FIXDEM_PRECISION);
#ifdef FIXDEM_TANGENTIAL
  static constexpr TangentialLaw tangential = TangentialLaw::FIXDEM_TANGENTIAL;
#endif
  static constexpr int gas_update_interval =
      scaled_interval(Original::gas_update_interval * gas_permille / 1000.0, permille);
  static constexpr int gas_floater_interval = scaled_interval(Original::gas_floater_interval, permille);
};

#ifndef FIXDEM_GAS_FACTORS
#define FIXDEM_GAS_FACTORS 1000
#endif

namespace detail {
template <int factor, class Visitor, int... gas_factors>
void visit_gas(Visitor& visit, std::integer_sequence<int, gas_factors...>) {
  (visit.template operator()<Setting<factor, gas_factors>>(), ...);
}
template <class Visitor, int... factors>
void visit_all(Visitor& visit, std::integer_sequence<int, factors...>) {
  (visit_gas<factors>(visit, std::integer_sequence<int, FIXDEM_GAS_FACTORS>{}), ...);
}
}  // namespace detail

/// Calls visit.template operator()<Setting<...>>() for every time step and gas interval of the program.
template <class Visitor>
void for_each_setting(Visitor visit) {
  detail::visit_all(visit, std::integer_sequence<int, FIXDEM_FACTORS>{});
}

}  // namespace fixdem::frontier

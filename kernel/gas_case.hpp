// What a case may say of its gas beyond velocity, density and viscosity.
//
// Members that a header has only when its key is used; a case without them compiles to what it was before.
#pragma once

#include "case.hpp"

namespace fixdem {

/// `gas_velocity_in_time`: the bulk velocity follows a table.
template <class Case>
inline constexpr bool has_velocity_in_time = requires {
  Case::gas_velocity_in_time;
};

/// `gas_compressible`: isothermal (gas_pressure.hpp). Density and viscosity are those at the outlet pressure, and so is
/// the bulk velocity: what flows in is gas_density * gas_velocity per area, whatever the pressure there.
template <class Case>
inline constexpr bool is_compressible = requires {
  requires Case::gas_compressible;
};

/// `gas_storage`: the gas held by the pipe, and by a supply volume before it, fills and empties.
template <class Case>
inline constexpr bool stores_gas = requires {
  requires Case::gas_storage;
};

/// Instead of a velocity: pressure at the inlet, or a blower that delivers less against pressure.
template <class Case>
inline constexpr bool has_inlet_pressure = requires {
  Case::gas_inlet_pressure;
};
template <class Case>
inline constexpr bool has_blower = requires {
  Case::gas_blower_flow;
};

/// Volume of gas before the inlet, m3.
template <class Case>
inline constexpr double supply_volume = [] {
  if constexpr (requires { Case::gas_supply_volume; })
    return Case::gas_supply_volume;
  else
    return 0.0;
}();

/// Of the pipe, m2.
template <class Case>
inline constexpr double section_of = Derived<Case>::pi* Derived<Case>::pipe_radius* Derived<Case>::pipe_radius;

}  // namespace fixdem

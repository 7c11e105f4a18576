// expected: supply_volume needs storage = true
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : AirLine {
  static constexpr bool gas_storage = false;
  static constexpr double gas_supply_volume = 0.1;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail

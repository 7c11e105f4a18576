// expected: outlet_pressure must be positive
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : AirLine {
  static constexpr double gas_outlet_pressure = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail

// expected: inlet_pressure and blower_flow need compressible = true
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : AirLine {
  static constexpr bool gas_compressible = false;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail

// Any scene in mixed precision.
#pragma once

#include "kernel/case.hpp"

namespace fixdem::tests {

template <class Base>
struct in_mixed_precision : Base {
  static constexpr auto precision = Precision::mixed_precision;
};

}  // namespace fixdem::tests

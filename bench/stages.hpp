// Benchmarks of the single stages of a step (stages.cpp).
#pragma once

namespace fixdem::bench {

void register_stages();

}  // namespace fixdem::bench

// Benchmarks of files of their own: the single stages of a step (stages.cpp), and pipes of any width (pipes.cpp).
#pragma once

namespace fixdem::bench {

void register_stages();
void register_pipes();

}  // namespace fixdem::bench

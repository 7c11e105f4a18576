// What a case says of an open line, as run-time values (kernel/case.hpp); nothing of it holds in another case. SI
// units.
#pragma once

#include "kernel/case.hpp"

namespace fixdem::program {

struct LineFacts {
  bool is_open = false;
  int start_count = 0;
  double feed_length = 0;
  double slice_interval = 0;    ///< between slices along the pipe; 0: none
  double statistics_from = -1;  ///< from when on means are taken; below 0: from half of the run on
  const Probe* probes = nullptr;
  int probe_count = 0;
};

template <class Case>
constexpr LineFacts line_facts() {
  LineFacts line;
  if constexpr (is_line<Case>) {
    line.is_open = true, line.start_count = Case::start_count, line.feed_length = Case::feed_length;
    if constexpr (requires { Case::slice_interval; }) line.slice_interval = Case::slice_interval;
    if constexpr (requires { Case::statistics_from; }) line.statistics_from = Case::statistics_from;
    if constexpr (requires { Case::probe_count; }) line.probes = Case::probes, line.probe_count = Case::probe_count;
  }
  return line;
}

}  // namespace fixdem::program

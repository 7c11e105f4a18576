// Small cases of several sizes for tests of the programs' parts: a closed drum with the material of the shipped cases,
// and what a case says for the program alone.
#pragma once

#include "listed_sizes.hpp"
#include "tools/run/case_facts.hpp"

namespace fixdem::tests {

struct drum : short_pipe {
  static constexpr const char *title = "a drum", *source = "", *keys = "", *start_from = "";
  static constexpr unsigned long long source_hash = 0, seed = 1;
  static constexpr double pipe_diameter = 0.075, pipe_length = 0.065;
  static constexpr Ends ends = Ends::closed;
  static constexpr double duration = 0.2, log_interval = 0.01, frame_interval = 0, sample_interval = 0.01;
  static constexpr double checkpoint_interval = 0, reference_speed = 1.2, overlap_warning = 0.1, stability_limit = 1.5;
  static constexpr double start_velocity = 0;
  static constexpr bool text_frames = false, dump = false, start_keeps_motion = false;
  static constexpr StartKind start = StartKind::random;
  static constexpr Placed placed[] = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
};

template <int micrometres, int density>
struct two_and_two {
  static constexpr const char* name = "two_species";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"large", "small"};
  static constexpr SizeRun sizes[] = {{2, 0.01, 1000, 0}, {2, 1e-6 * micrometres, density, 1}};
};
/// Two spheres of 10 mm and 1000 kg/m3, called large, and two of these micrometres and kg/m3, called small.
template <int micrometres, int density = 1000>
using TwoSpecies = sized<two_and_two<micrometres, density>, drum>;

struct four_diameters {
  static constexpr const char* name = "four_sizes";
  static constexpr int species_count = 0;
  static constexpr SizeRun sizes[] = {
      {1, 0.006, 1000, 0}, {1, 0.01, 1000, 0}, {1, 0.004, 1000, 0}, {1, 0.008, 1000, 0}};
};
/// Four spheres from 10 to 4 mm, of a distribution.
using FourSizes = sized<four_diameters, drum>;

}  // namespace fixdem::tests

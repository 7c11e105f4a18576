// Whole steps in pipes of any width: step/<scene>/<N>/<D over d>/<precision>, scenes of pipes.hpp.
#include "pipes.hpp"

#include "stages.hpp"
#include "timed_steps.hpp"

namespace fixdem::bench {
namespace {

template <class Case>
std::string name_of(const char* scene, int ratio) {
  return std::string("step/") + scene + "/" + std::to_string(Case::particle_count) + "/" + std::to_string(ratio) + "/" +
         precision_name(Case::precision);
}

template <int ratio, int particles, Precision P>
void add_bed() {
  using Case = filled<ratio, repeats_for(ratio, particles), P>;
  const std::string name = name_of<Case>("bed", ratio);
  benchmark::RegisterBenchmark(name.c_str(), [name](benchmark::State& state) {
    steady_steps<Case>(state, name, [](auto& simulation) { start_bed_of<ratio>(simulation); });
  });
}

template <int ratio, Precision P>
void add_moving() {
  using Case = filled_with_small<ratio, repeats_for(ratio, 10000), P>;
  const auto add = [](const char* scene, auto start) {
    const std::string name = name_of<Case>(scene, ratio);
    benchmark::RegisterBenchmark(
        name.c_str(), [name, start](benchmark::State& state) { first_steps<Case>(state, name, 2500, start); });
  };
  add("agitated", [](auto& simulation) { start_agitated_of<ratio>(simulation); });
  add("falling", [](auto& simulation) { start_falling_of<ratio>(simulation); });
}

template <int ratio, Precision P>
void add_all() {
  add_bed<ratio, 10000, P>();
  add_moving<ratio, P>();
}

}  // namespace

void register_pipes() {
  constexpr Precision in_double = Precision::double_precision, in_mixed = Precision::mixed_precision;
  add_all<5, in_double>();
  add_all<10, in_double>();
  add_all<17, in_double>();
  add_all<30, in_double>();
  add_all<50, in_double>();
  add_bed<5, 100000, in_double>();
  add_bed<17, 100000, in_double>();
  add_bed<30, 100000, in_double>();
  add_all<5, in_mixed>();
  add_all<17, in_mixed>();
}

}  // namespace fixdem::bench

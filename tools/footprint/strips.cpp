// The scene of strips.hpp with everything and stripped step by step.
//
// Usage: strips NUMBER size|time|STEPS      the strip, counted from 0 (measured.hpp); without arguments their names.
#include "strips.hpp"

#include "measured.hpp"

int main(int argc, char** argv) {
  int number = 0, code = 2;
  fixdem::footprint::for_each_strip([&]<class Case>(const char* name) {
    if (argc < 3) std::printf("%s\n", name);
    if (argc >= 3 && number == std::atoi(argv[1])) {
      static fixdem::Simulation<Case> simulation;
      const auto start = [] {
        for (int id = 0; id < Case::particle_count; ++id) simulation.place(id, fixdem::footprint::of_rod(id));
        return simulation.start().ok();
      };
      code = fixdem::footprint::measured(simulation, start, argv[2]);
    }
    ++number;
  });
  return argc < 3 ? 0 : code;
}

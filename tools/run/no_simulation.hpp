// A simulation without particles, for what only records, or makes up, a part of one: all that SimulationView asks for,
// each doing nothing.
#pragma once

#include "simulation_view.hpp"

namespace fixdem::program {

class NoSimulation : public SimulationView {
 public:
  void place(int, const Particle&) override {}
  Status start() override { return {}; }
  void restore_history(int, int, const double (&)[3], const double (&)[3]) override {}
  Status run(long long) override { return {}; }
  long long step() const override { return 0; }
  double time() const override { return 0; }
  Particle particle(int) const override { return {}; }
  int image(int) const override { return 0; }
  std::vector<Contact> contacts() const override { return {}; }
  Observation observe() const override { return {}; }
  Energy energy() const override { return {}; }
  double pressure_gradient(int) const override { return 0; }
  double pressure_drop() const override { return 0; }
  std::vector<CapacityUse> capacities() const override { return {}; }
};

}  // namespace fixdem::program

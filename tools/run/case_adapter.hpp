// Puts the abstract view in front of Simulation<Case>: one line per function, nothing of its own.
#pragma once

#include <type_traits>

#include "simulation_view.hpp"

namespace fixdem::program {

template <class Case>
class CaseAdapter final : public SimulationView {
 public:
  explicit CaseAdapter(Simulation<Case>& simulation) : simulation_(simulation) {}

  void place(int id, const Particle& particle) override { simulation_.place(id, particle); }
  Status start() override { return simulation_.start(); }
  void restore_history(int owner, int partner, const double (&history)[3], const double (&rolling)[3]) override {
    simulation_.restore_history(owner, partner, history, rolling);
  }
  Status run(long long steps) override { return simulation_.run(steps); }

  long long step() const override { return simulation_.step(); }
  double time() const override { return simulation_.time(); }
  Particle particle(int id) const override { return simulation_.particle(id); }
  int image(int id) const override { return simulation_.image(id); }
  std::vector<Contact> contacts() const override {
    std::vector<Contact> list;
    simulation_.for_each_contact([&](const Contact& contact) { list.push_back(contact); });
    return list;
  }
  Observation observe() const override { return simulation_.observe(); }
  Energy energy() const override { return simulation_.energy(); }
  double deepest_overlap() const override { return simulation_.deepest_overlap(); }
  double pressure_gradient([[maybe_unused]] int slice) const override {
    if constexpr (Case::has_gas) return simulation_.pressure_gradient(slice);
    return 0;
  }
  double pressure_drop() const override {
    if constexpr (Case::has_gas) return simulation_.pressure_drop();
    return 0;
  }
  bool is_line() const override { return fixdem::is_line<Case>; }
  bool is_present(int id) const override { return simulation_.is_present(id); }
  long long serial(int id) const override { return simulation_.serial(id); }
  int kind(int id) const override { return simulation_.kind(id); }
  LineTotals line() const override {
    if constexpr (fixdem::is_line<Case>) return simulation_.line();
    return {};
  }
  double gas_velocity([[maybe_unused]] int slice) const override {
    if constexpr (Case::has_gas) {
      constexpr double section = Derived<Case>::pi * Derived<Case>::pipe_radius * Derived<Case>::pipe_radius;
      const double bed = simulation_.bed_area(slice) / section;
      return bed * simulation_.gas_velocity_in_bed(slice) + (1 - bed) * simulation_.gas_velocity_above(slice);
    }
    return 0;
  }
  std::vector<CapacityUse> capacities() const override {
    std::vector<CapacityUse> list;
    for (int k = 0; k < simulation_.high_water_count(); ++k) {
      const auto use = simulation_.high_water(k);
      list.push_back({use.name, use.limit, use.high_water});
    }
    const long long size = sizeof(Simulation<Case>);
    list.push_back({"memory", size, size});
    if constexpr (requires { Case::memory_budget; }) list.back().limit = Case::memory_budget;
    return list;
  }
  bool is_consistent() const override { return simulation_.is_consistent(); }
  std::span<char> memory() override {
    static_assert(std::is_trivially_copyable_v<Simulation<Case>>, "its bytes are its state");
    return {reinterpret_cast<char*>(&simulation_), sizeof simulation_};
  }

 private:
  Simulation<Case>& simulation_;
};

}  // namespace fixdem::program

// What the program sees of a simulation: a narrow abstract face, so that all of tools/run but main.cpp is compiled
// once.
//
// CaseAdapter (case_adapter.hpp) puts it in front of Simulation<Case>. Virtual calls happen between blocks of steps
// only, so they cost nothing. Particle numbers are those of the input order; in a line they are slots, which are used
// again, and of which not all are taken (kernel/case.hpp).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kernel/fixdem.hpp"

namespace fixdem::program {

/// How full one fixed array of the kernel has ever been.
struct CapacityUse {
  std::string name;
  long long limit, high_water;
};

class SimulationView {
 public:
  virtual ~SimulationView() = default;

  virtual void place(int id, const Particle& particle) = 0;
  virtual Status start() = 0;
  virtual void restore_history(int owner, int partner, const double (&history)[3], const double (&rolling)[3]) = 0;
  virtual Status run(long long steps) = 0;

  virtual long long step() const = 0;
  virtual double time() const = 0;
  virtual Particle particle(int id) const = 0;
  virtual int image(int id) const = 0;
  virtual std::vector<Contact> contacts() const = 0;
  virtual Observation observe() const = 0;
  virtual Energy energy() const = 0;
  virtual double deepest_overlap() const { return 0; }    ///< of all contacts in all steps so far, m
  virtual double pressure_gradient(int slice) const = 0;  ///< Pa/m; 0 without gas
  virtual double pressure_drop() const = 0;               ///< Pa over the pipe; 0 without gas
  virtual std::vector<CapacityUse> capacities() const = 0;

  // What differs in a line; otherwise a number is serial number and kind as well.
  virtual bool is_line() const { return false; }
  virtual bool is_present(int) const { return true; }
  virtual long long serial(int id) const { return id; }
  virtual int kind(int id) const { return id; }
  virtual LineTotals line() const { return {}; }
  virtual double gas_velocity(int) const { return 0; }  ///< volume flux of gas and solids in a slice, m/s

  /// The whole simulation as bytes, to copy and to put back; empty where nobody needs that.
  virtual std::span<char> memory() { return {}; }
  /// Whether those bytes, once they have been written from outside, may be run.
  virtual bool is_consistent() const { return true; }
};

}  // namespace fixdem::program

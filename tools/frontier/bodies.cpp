// Many particles at every time step the program was compiled for (setting.hpp): errors, run time, observables.
//
// Usage; all output is lines of comma-separated values, factor and gas factor in thousandths of the case's step and
// interval:
//
// - `bodies errors STATE TRUTH`: `error,factor,gas,moment,rms,maximum,path`, difference of positions to the truth
//   (truth.cpp) and root mean square way since the start, m
// - `bodies time STATE`: `time,factor,gas,seconds,steps`, processor time of `steps` steps from the perturbed state
// - `bodies still STATE`: `still,factor,gas,speed`, maximum speed when the state is carried on unperturbed for 20 ms
// - `bodies chaos STATE`: `chaos,factor,gas,time,rms`, separation of two runs, one moved by 1e-12 m at random
// - `bodies long SEED SECONDS [STATE]`:
//   `long,factor,gas,seed,height,coordination,decay_time,front_velocity,layer_ratio`
//
// A run that the kernel stops: `stopped,factor,gas,mode,fault`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "long_run.hpp"
#include "perturbed.hpp"
#include "setting.hpp"
#include "tools/run/failure.hpp"

namespace {

using namespace fixdem;
using frontier::Original;
using Place = std::array<double, 3>;

struct Moment {
  long long case_steps;
  std::vector<Place> places;
};

std::vector<Moment> read_truth(const char* path) {
  std::ifstream file(path);
  std::vector<Moment> truth;
  std::string line;
  while (std::getline(file, line)) {
    int id = 0;
    double time = 0;
    Place x{};
    if (std::sscanf(line.c_str(), "at,%d,%lg", &id, &time) == 2)
      truth.push_back({std::llround(time / Original::time_step), {}});
    else if (std::sscanf(line.c_str(), "place,%d,%lg,%lg,%lg", &id, &x[0], &x[1], &x[2]) == 4 && !truth.empty())
      truth.back().places.push_back(x);
  }
  if (truth.size() != 1 + std::size(frontier::moments))
    throw std::runtime_error(std::string(path) + " is not what the program of the truth writes");
  for (const Moment& m : truth)
    if (m.places.size() != static_cast<std::size_t>(Original::particle_count))
      throw std::runtime_error(std::string(path) + " has another number of particles than the case");
  return truth;
}

struct Difference {
  double rms = 0, maximum = 0;
};
/// Of places; along a periodic pipe to the nearest image.
Difference difference(const std::vector<Place>& a, const std::vector<Place>& b) {
  Difference found;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double x = a[i][c] - b[i][c];
      if (c == 2 && Original::ends == Ends::periodic)
        x -= Original::pipe_length * std::round(x / Original::pipe_length);
      square += x * x;
    }
    found.rms += square, found.maximum = std::max(found.maximum, square);
  }
  return {std::sqrt(found.rms / static_cast<double>(a.size())), std::sqrt(found.maximum)};
}

template <class Simulation>
std::vector<Place> places(const Simulation& simulation) {
  std::vector<Place> all;
  for (int id = 0; id < Simulation::count; ++id) {
    const Particle p = simulation.particle(id);
    all.push_back({p.position[0], p.position[1], p.position[2]});
  }
  return all;
}

/// Simulations are held one at a time on the heap: a list of time steps has many.
template <class Setting>
class Bodies {
  static constexpr int factor = Setting::factor, gas = Setting::gas_factor;

 public:
  explicit Bodies(const char* mode) : mode_(mode), simulation_(std::make_unique<Simulation<Setting>>()) {}

  void errors(const program::StoredState& state, const std::vector<Moment>& truth) {
    if (!good(frontier::start_from(*simulation_, state))) return;
    for (std::size_t k = 1; k < truth.size(); ++k) {
      const long long steps = truth[k].case_steps * 1000 / factor;
      if (!good(simulation_->run(steps - simulation_->step()))) return;
      const Difference d = difference(places(*simulation_), truth[k].places);
      const double path = difference(truth[k].places, truth[0].places).rms;
      fmt::print("error,{},{},{},{:.6g},{:.6g},{:.6g}\n", factor, gas, k, d.rms, d.maximum, path);
    }
  }

  void time(const program::StoredState& state) {
    const long long steps = frontier::case_steps_until<Original>(5e-3) * 1000 / factor;
    const long long repeats = 1 + 500000 / (steps * Setting::particle_count);
    double seconds = 0;
    for (long long k = 0; k < repeats; ++k) {
      if (!good(frontier::start_from(*simulation_, state))) return;
      const std::clock_t begin = std::clock();
      if (!good(simulation_->run(steps))) return;
      seconds += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    }
    fmt::print("time,{},{},{:.6g},{}\n", factor, gas, seconds, steps * repeats);
  }

  void still(const program::StoredState& state) {
    if (!good(frontier::start_from(*simulation_, state))) return;
    if (!good(simulation_->run(frontier::case_steps_until<Original>(20e-3) * 1000 / factor))) return;
    fmt::print("still,{},{},{:.3g}\n", factor, gas, simulation_->observe().max_speed);
  }

  void chaos(const program::StoredState& state) {
    const auto other = std::make_unique<Simulation<Setting>>();
    program::StoredState moved = state;
    program::RandomNumbers random(frontier::push_seed + 1);
    for (Particle& p : moved.particles)
      for (double& x : p.position) x += random.between(-1e-12, 1e-12);
    if (!good(frontier::start_from(*simulation_, state)) || !good(frontier::start_from(*other, moved))) return;
    for (int k = 1; k <= 40; ++k) {
      const long long steps = frontier::case_steps_until<Original>(k * 0.5e-3) * 1000 / factor - simulation_->step();
      if (!good(simulation_->run(steps)) || !good(other->run(steps))) return;
      fmt::print("chaos,{},{},{:.6g},{:.6g}\n", factor, gas, simulation_->time(),
                 difference(places(*simulation_), places(*other)).rms);
    }
  }

  void long_run(unsigned long long seed, double seconds, const char* state) {
    const auto seen = frontier::long_run(*simulation_, seed, seconds, state);
    if (!good(seen.status)) return;
    fmt::print("long,{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", factor, gas, seed, seen.height, seen.coordination,
               seen.decay_time, seen.front_velocity, seen.layer_ratio);
  }

 private:
  bool good(const Status& status) const {
    if (!status.ok()) fmt::print("stopped,{},{},{},{}\n", factor, gas, mode_, describe(status.fault));
    return status.ok();
  }

  const char* mode_;
  std::unique_ptr<Simulation<Setting>> simulation_;
};

int run(const std::string& mode, int argc, char** argv) {
  if (mode == "long" && argc >= 4) {
    frontier::for_each_setting([&]<class Setting>() {
      Bodies<Setting>(argv[1]).long_run(std::stoull(argv[2]), std::stod(argv[3]), argc > 4 ? argv[4] : nullptr);
    });
    return 0;
  }
  const bool known =
      (mode == "errors" && argc == 4) || ((mode == "time" || mode == "still" || mode == "chaos") && argc == 3);
  if (!known) {
    fmt::print(
        stderr,
        "usage: bodies errors STATE TRUTH | time STATE | still STATE | chaos STATE | long SEED SECONDS [STATE]\n");
    return 2;
  }
  const program::StoredState stored = frontier::stored_state(argv[2], Original::particle_count);
  const program::StoredState pushed = frontier::perturbed(stored);
  const std::vector<Moment> truth = mode == "errors" ? read_truth(argv[3]) : std::vector<Moment>{};
  frontier::for_each_setting([&]<class Setting>() {
    Bodies<Setting> bodies(argv[1]);
    if (mode == "errors") bodies.errors(pushed, truth);
    if (mode == "time") bodies.time(pushed);
    if (mode == "still") bodies.still(stored);
    if (mode == "chaos") bodies.chaos(pushed);
  });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc > 1 ? argv[1] : "", argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bodies: {}\n", error.what());
    return 3;
  }
}

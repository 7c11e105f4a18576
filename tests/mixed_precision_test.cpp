// What mixed precision promises beyond agreement with the reference (agreement_mixed_test.cpp): impacts return their
// restitution, a bed at rest stays at rest, and a state file carries a run on.
#include "kernel/fixdem.hpp"
#include "mixed.hpp"
#include "restitution_scenes.hpp"
#include "small_scene.hpp"
#include "tools/run/case_adapter.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using Kernel = Simulation<Case>;

TEST_CASE("mixed: impacts return the restitution asked") {
  check_restitution<Kernel, in_mixed_precision<impacts<100, Integrator::euler>>>();
  check_restitution<Kernel, in_mixed_precision<impacts<800, Integrator::euler>>>();
  check_restitution<Kernel, in_mixed_precision<impacts<1000, Integrator::euler>>>();
  check_restitution<Kernel, in_mixed_precision<impacts<400, Integrator::leapfrog>>>();
  check_restitution<Kernel, in_mixed_precision<impacts<900, Integrator::leapfrog>>>();
}

TEST_CASE("mixed: the restitution depends on no material") {
  check_restitution<Kernel, in_mixed_precision<impacts<500, Integrator::leapfrog, large_aluminium>>>();
  check_restitution<Kernel, in_mixed_precision<impacts<500, Integrator::euler, small_rubber>>>();
}

/// Shallow enough to come to rest within some seconds.
struct resting_bed : cases::pipe_bed {
  static constexpr int particle_count = 133;
  static constexpr double pipe_length = 0.12;
};

struct Speeds {
  double maximum = 0, mean_square = 0;
};

/// Over 10000 steps, looked at every 100.
template <class Case>
Speeds speeds() {
  Speeds seen;
  double squares = 0;
  for (int piece = 0; piece < 100; ++piece) {
    run(kernel<Case>(), 100);
    for (int id = 0; id < Case::particle_count; ++id) {
      const double speed = length(kernel<Case>().particle(id).velocity);
      seen.maximum = std::max(seen.maximum, speed);
      squares += speed * speed;
    }
  }
  seen.mean_square = std::sqrt(squares / (100 * Case::particle_count));
  return seen;
}

/// Comes to rest within 8 s, and is at rest 0.2 s later.
template <class Case>
void check_rest(double maximum, double mean_square) {
  enter({Case::name, seed()});
  place_all(kernel<Case>(), layered_spheres<Case>(Case::pipe_length / 7.3, 0.5, Random(seed())));
  start(kernel<Case>());
  const auto rests = [&](const Speeds& seen) { return seen.maximum < maximum && seen.mean_square < mean_square; };
  for (int piece = 0; piece < 16 && !rests(speeds<Case>()); ++piece) run(kernel<Case>(), 250000);
  run(kernel<Case>(), 100000);
  const Speeds seen = speeds<Case>();
  CHECK(seen.maximum < maximum);
  CHECK(seen.mean_square < mean_square);
  CHECK(kernel<Case>().observe().coordination_number > 3);
  if (std::getenv("FIXDEM_FIGURES") != nullptr)
    std::cerr << std::scientific << std::setprecision(1) << "  at rest after " << kernel<Case>().time()
              << " s: " << seen.maximum << " m/s, root mean square " << seen.mean_square
              << " m/s: " << (is_mixed<Case> ? "mixed" : "double") << "\n";
}

/// Weight changes velocities by 2e-5 m/s per step. Floats balance it to 2^-24 of the forces between the spheres, some
/// 1e-12 m/s per step, which the contacts hardly damp; histories round in the same way.
TEST_CASE("mixed: a bed comes to rest as far as floats can balance its weight; in double, further") {
  check_rest<resting_bed>(5e-11, 1e-11);
  check_rest<in_mixed_precision<resting_bed>>(3e-9, 1e-9);
}

TEST_CASE("mixed: a state file carries a run on, histories included") {
  using Case = in_mixed_precision<small_closed>;
  enter({Case::name, seed()});
  static Simulation<Case> first, second;
  place_all(first, layered_spheres<Case>(Case::pipe_length / 7, 0.5, Random(seed())));
  start(first);
  run(first, 30000);  // 60 ms: much of it lies and touches
  const program::CaseFacts facts = program::case_facts<Case>();
  const auto snapshot_of = [](Simulation<Case>& s) {
    return program::take_snapshot(program::CaseAdapter<Case>(s), Case::particle_count);
  };
  const program::Snapshot before = snapshot_of(first);
  const std::string bytes = program::encode_state(program::stored_state(facts, before, true, 1));
  const program::StoredState state = program::decode_state(bytes, "first");
  CHECK(state.histories.size() > 20);
  for (int id = 0; id < Case::particle_count; ++id) second.place(id, state.particles[static_cast<std::size_t>(id)]);
  start(second);
  for (const auto& h : state.histories) second.restore_history(h.owner, h.partner, h.history);
  CHECK(program::state_hash(snapshot_of(second)) == program::state_hash(before));
  run(first, 1000);
  run(second, 1000);
  for (int id = 0; id < Case::particle_count; ++id) {
    const Particle a = first.particle(id), b = second.particle(id);
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs(a.position[k] - b.position[k]) < agitated_tolerance<Case> * Case::diameter);
  }
}

}  // namespace
}  // namespace fixdem::tests

// What `integrator = "impulse"` with `slider = "exact"` promises: rebounds, and second order in a bed with friction.
//
// Speeds and phases of the first contact are jittered: a single one can be right by chance. Pairs meet head-on; what
// they should return is known (eq. 30). In the bed, errors are root mean square differences of positions after 0.5 ms,
// well before chaos, from a run with an eighth of the step; of four shakes the geometric mean, since one rare event can
// outweigh all others in the error.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "agreement.hpp"
#include "cases/pipe_bed.hpp"
#include "mixed.hpp"

namespace fixdem::tests {
namespace {

/// A short bed of 114 spheres in six layers.
template <int step_in_nanoseconds>
struct impulse_bed : cases::pipe_bed {
  static constexpr int particle_count = 114;
  static constexpr double pipe_length = 0.08;
  static constexpr int slice_count = 8;
  static constexpr bool energy_ledger = false;
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr Slider slider = Slider::exact;
  static constexpr double time_step = step_in_nanoseconds * 1e-9;
};
template <int step_in_nanoseconds, int permille>
struct smooth_impulse : impulse_bed<step_in_nanoseconds> {
  static constexpr double friction = 0, restitution = permille / 1000.0;
};

/// Root mean square error of the rebound over impact speed, of 57 pairs that meet head-on at 0.9 to 1.1 m/s.
template <class Case>
double rebound_error() {
  enter({Case::name, seed()});
  Random random(seed());
  const double d = Case::diameter, dt = Case::time_step;
  const Spheres layers = layered_spheres<Case>(0.013, 0, Random(seed()));  // pairs of them are moved together
  Spheres spheres = layers;
  double speed[57];
  for (int k = 0; k < 57; ++k) {
    speed[k] = random(0.9, 1.1);
    Sphere &a = spheres[k], &b = spheres[57 + k];
    for (int c = 0; c < 2; ++c) b.position[c] = a.position[c];
    a.position[2] = (k / 19) * 0.026 + 0.002;
    b.position[2] = a.position[2] + d + speed[k] * dt * random(1, 2);
    a.velocity[2] = random(-0.5, 0.5);
    b.velocity[2] = a.velocity[2] - speed[k];
  }
  place_all(kernel<Case>(), spheres);
  start(kernel<Case>());
  run(kernel<Case>(), static_cast<long long>(3e-4 / dt));
  double squares = 0;
  for (int k = 0; k < 57; ++k) {
    const auto a = kernel<Case>().particle(k), b = kernel<Case>().particle(57 + k);
    REQUIRE(std::abs(axial_difference<Case>(b.position[2], a.position[2])) > d);
    const double error = (b.velocity[2] - a.velocity[2]) / speed[k] - Case::restitution;
    squares += error * error / 57;
  }
  if (std::getenv("FIXDEM_FIGURES") != nullptr)
    std::fprintf(stderr, "  rebound error at %.1e s, e = %.1f: %.1e\n", dt, Case::restitution, std::sqrt(squares));
  return std::sqrt(squares);
}

TEST_CASE("impulse: rebounds") {
  CHECK(rebound_error<impulse_bed<2000>>() < 1e-5);
  CHECK(rebound_error<impulse_bed<1000>>() < 2.5e-6);
  CHECK(rebound_error<smooth_impulse<10000, 900>>() < 2e-4);
  CHECK(rebound_error<in_mixed_precision<smooth_impulse<800, 100>>>() < 1e-4);  // 1/100 of the contact time
}

/// The state 0.5 ms after `state`.
template <class Case>
Spheres carried_on(const HandOver& state) {
  start_from(kernel<Case>(), state);
  run(kernel<Case>(), std::llround(5e-4 / Case::time_step));
  return all_particles(kernel<Case>(), Case::particle_count);
}

/// Mean square of the difference of positions, m2.
template <class Case>
double position_square(const Spheres& a, const Spheres& b) {
  double squares = 0;
  for (int i = 0; i < Case::particle_count; ++i) {
    const double dx[3] = {a[i].position[0] - b[i].position[0], a[i].position[1] - b[i].position[1],
                          axial_difference<Case>(a[i].position[2], b[i].position[2])};
    squares += dot(dx, dx) / Case::particle_count;
  }
  return squares;
}

TEST_CASE("impulse: second order in a bed with friction") {
  using Case = impulse_bed<2000>;
  enter({Case::name, seed()});
  // Settles for 0.2 s, then is shaken: contacts begin, end, slide and stick.
  place_all(kernel<Case>(), layered_spheres<Case>(Case::pipe_length / 6, 0.3, Random(seed())));
  start(kernel<Case>());
  run(kernel<Case>(), 100000);
  REQUIRE(kernel<Case>().observe().coordination_number > 2);
  HandOver state = hand_over_from(kernel<Case>(), Case::particle_count);
  Random random(seed() + 1);
  double coarse = 0, ratio = 1;
  for (int shake = 0; shake < 4; ++shake) {
    agitate<Case>(state.spheres, 0.05, random);
    const Spheres best = carried_on<impulse_bed<250>>(state);
    const double square = position_square<Case>(carried_on<Case>(state), best);
    coarse += square;
    ratio *= std::pow(square / position_square<Case>(carried_on<impulse_bed<1000>>(state), best), 1.0 / 8);
  }
  if (std::getenv("FIXDEM_FIGURES") != nullptr)
    std::fprintf(stderr, "  position error %.1e m at 2e-6 s, at 1e-6 s %.2f times less\n", std::sqrt(coarse / 4),
                 ratio);
  CHECK(std::sqrt(coarse / 4) < 1e-8);
  // With the remaining error of the fine run, second order is 4.2, first 2.3.
  CHECK(ratio > 3.2);
}

}  // namespace
}  // namespace fixdem::tests

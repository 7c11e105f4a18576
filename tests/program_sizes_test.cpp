// Particles of several sizes in the parts of the program that need no simulation: what a contact of two of them is made
// of, how long it lasts, random arrangements, collisions that are followed, and plugs by volume.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cases/settle.hpp"
#include "sized_case.hpp"
#include "tools/run/arrangement.hpp"
#include "tools/run/capacity_advice.hpp"
#include "tools/run/collision_tracker.hpp"
#include "tools/run/contact_kinds.hpp"
#include "tools/run/contact_time.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/fault_report.hpp"
#include "tools/run/neighbourhood.hpp"
#include "tools/run/no_simulation.hpp"
#include "tools/run/plug_analysis.hpp"

using namespace fixdem;
using namespace fixdem::program;
using doctest::Approx;
using fixdem::tests::FourSizes, fixdem::tests::TwoSpecies;

TEST_CASE("sizes: each particle has its own, and the sphere of reference is the heaviest of the largest") {
  const CaseFacts mixed = case_facts<TwoSpecies<5000>>();
  CHECK(mixed.has_sizes());
  CHECK(mixed.has_species());
  CHECK(mixed.diameter == 0.01);
  CHECK(mixed.smallest_radius() == 0.0025);
  CHECK(mixed.mass_of(0) == mixed.mass);
  CHECK(mixed.mass_of(3) == Approx(mixed.mass / 8));
  CHECK(mixed.volume_share_of(3) == Approx(0.125));
  CHECK(mixed.species_of(3) == 1);
  CHECK(std::string(mixed.species[1]) == "small");
  CHECK(features(mixed)[0] == "several_sizes");
  const CaseFacts heavy = case_facts<TwoSpecies<10000, 10000>>();
  CHECK(heavy.mass == heavy.mass_of(2));
  CHECK(heavy.mass == Approx(10 * heavy.mass_of(0)));
  const CaseFacts each = case_facts<FourSizes>();
  CHECK_FALSE(each.has_species());
  const SizeStatistics all = size_statistics(each, 4);
  CHECK(all.minimum_diameter == 0.004);
  CHECK(all.maximum_diameter == 0.01);
  CHECK(all.mean_diameter == Approx(0.007));
  CHECK(all.sauter_diameter == Approx(0.001 * (216 + 1000 + 64 + 512) / (36 + 100 + 16 + 64)));
  CHECK(all.total_volume == Approx(3.14159265358979 / 6 * 1792e-9));
  CHECK(all.total_mass == Approx(1000 * all.total_volume));

  const CaseFacts equal = case_facts<cases::settle>();
  CHECK_FALSE(equal.has_sizes());
  CHECK(equal.mass_of(17) == equal.mass);
  CHECK(equal.volume_share_of(17) == 1);
  CHECK(size_statistics(equal, 150).sauter_diameter == Approx(0.01));
}

namespace {

/// What a contact of the first particle with the last one must be made of: stiffnesses in N/m^1.5, reduced mass in kg.
struct Expected {
  double stiffness, tangential_stiffness, mass;
};

template <class Case>
void check_contact(const Expected& expected) {
  const CaseFacts facts = case_facts<Case>();
  const ContactCoefficients c = contact_coefficients(facts, 0, 3);
  CHECK(c.stiffness == Approx(expected.stiffness).epsilon(1e-9));
  CHECK(c.tangential_stiffness == Approx(expected.tangential_stiffness).epsilon(1e-9));
  const double ratio = -std::log(0.9) / std::hypot(3.14159265358979, std::log(0.9));
  CHECK(c.damping == Approx(std::sqrt(5 * expected.mass * expected.stiffness) * ratio).epsilon(1e-9));
  CHECK(reduced_mass(facts.kinds[0], facts.kinds[3]) == Approx(expected.mass).epsilon(1e-9));
  const ContactCoefficients turned = contact_coefficients(facts, 3, 0);
  CHECK(turned.stiffness == c.stiffness);
  CHECK(turned.damping == c.damping);
}

}  // namespace

TEST_CASE("contact kinds: springs and dampers of unequal spheres") {
  check_contact<TwoSpecies<5000>>({9.162794085e7, 1.102827312e8, 5.817764173e-5});
  check_contact<TwoSpecies<2000>>({6.479073832e7, 7.798166708e7, 4.155545838e-6});
  check_contact<TwoSpecies<10000, 10000>>({1.122208506e8, 1.350682094e8, 4.759988869e-4});

  // Two of the large ones are what a case of them alone says, and so are they at a wall.
  const CaseFacts mixed = case_facts<TwoSpecies<5000>>(), equal = case_facts<cases::settle>();
  const ContactCoefficients pair = contact_coefficients(mixed, 0, 1), wall = contact_coefficients(mixed, 1, -1);
  CHECK(pair.stiffness == Approx(equal.pair_contact.stiffness).epsilon(1e-14));
  CHECK(pair.tangential_damping == Approx(equal.pair_contact.tangential_damping).epsilon(1e-14));
  CHECK(wall.stiffness == Approx(equal.wall_contact.stiffness).epsilon(1e-14));
  CHECK(wall.damping == Approx(equal.wall_contact.damping).epsilon(1e-14));
  const ContactCoefficients small = contact_coefficients(mixed, 2, -1);
  CHECK(small.stiffness == Approx(wall.stiffness / std::sqrt(2)));
  CHECK(small.damping == Approx(wall.damping / std::sqrt(8 * std::sqrt(2))));
  CHECK(rolling_lever(mixed, 0, 1) == 0.5);
  CHECK(rolling_lever(mixed, 0, 3) == Approx(1.0 / 3));
  CHECK(rolling_lever(mixed, 3, 0) == Approx(2.0 / 3));
  CHECK(rolling_lever(mixed, 3, -2) == 1);

  CaseFacts linear = mixed;
  linear.normal = NormalLaw::linear;
  CHECK(contact_coefficients(linear, 2, 3).stiffness == linear.pair_contact.stiffness);
  CHECK(contact_coefficients(linear, 2, 3).damping == Approx(linear.pair_contact.damping / 4));  // M is m / 16
}

TEST_CASE("contact time: the shortest of all pairs of species, and who it is") {
  CaseFacts facts = case_facts<TwoSpecies<5000>>();
  // Head-on at 1 m/s, e = 0.9: 42.999813 us, 1.0110682 times as long as without damping.
  const ContactCoefficients c = contact_coefficients(facts, 0, 3);
  CHECK(hertz_contact_time(reduced_mass(facts.kinds[0], facts.kinds[3]), c.stiffness, 1) ==
        Approx(42.999813e-6 / 1.0110682).epsilon(1e-5));
  // Two small ones: as the whole scene is half as large, half as long as two large ones.
  CHECK(contact_time(facts, 1) == Approx(contact_time(case_facts<cases::settle>(), 1) / 2).epsilon(1e-9));
  CHECK(contact_time_of(facts, 1e-5) < contact_time_of(case_facts<cases::settle>(), 1e-5));
  facts.reference_speed = 1, facts.time_step = 1e-5;
  CHECK(contact_warning(facts, 0).find("steps per contact of small with small at 1 m/s") != std::string::npos);
  CHECK(contact_warning(facts, 2.5e-4).find("0.1 radii of the smallest particle") != std::string::npos);
  CaseFacts sizes = case_facts<FourSizes>();
  sizes.time_step = 1e-5;
  CHECK(contact_warning(sizes, 1e-5).find("of smallest with smallest") != std::string::npos);
  // A single small one meets only walls and large ones, which are slower.
  const ParticleKind three[] = {{0.01, 1000, 0}, {0.01, 1000, 0}, {0.001, 1000, 1}};
  facts.kinds = three, facts.kind_count = facts.particle_count = 3, facts.smallest_diameter = 0.001;
  CHECK(contact_warning(facts, 0).find("of small with the wall") != std::string::npos);
  facts.has_wall = false, facts.is_periodic = true;
  CHECK(contact_warning(facts, 0).find("of large with small") != std::string::npos);
}

TEST_CASE("fault report: names the particle's own diameter, and tells ways in radii of the smallest") {
  const CaseFacts facts = case_facts<TwoSpecies<5000>>();
  CHECK(fault_sentence(facts, {Fault::overlap, 3, 41213, 0.61, 0.5}) ==
        "particle 3 (diameter 0.005 m) has an overlap of 0.61 radii of the smallest particle (limit 0.5)");
  CHECK(fault_sentence(facts, {Fault::too_fast, 0, 41213, 0.61, 0.5}) ==
        "particle 0 (diameter 0.01 m) moves 0.61 radii of the smallest particle in one step (limit 0.5)");
  CHECK(fault_advice(facts, {Fault::neighbour_capacity, 0, 1, 34, 33}, 0).find("at most 160") != std::string::npos);
  const std::vector<CapacityUse> full = {{"neighbours", 33, 40},
                                         {"chunk_pairs", 1008, 300},
                                         {"wrap_pairs", 0, 0},
                                         {"in_reach", 144, 90},
                                         {"memory", 524288, 262144}};
  CHECK(describe_capacities(full, facts.most_neighbours()).find("neighbours = 41") != std::string::npos);
  // Three of the largest diameters around the one that a fault names.
  CaseFacts pipe = facts;
  pipe.pipe_length = 0.8;
  Snapshot snapshot;
  for (const double z : {0.005, 0.034, 0.036, 0.79}) snapshot.particles.push_back({{0, 0, z}, {}, {}});
  CHECK(neighbourhood(pipe, snapshot, 2) == std::vector<int>{1, 2});
}

TEST_CASE("arrangement: unequal spheres do not overlap, keep their own distance from walls, and their numbers") {
  std::vector<double> diameters;
  for (int k = 0; k < 1200; ++k) diameters.push_back(k % 4 == 0 ? 0.01 : 0.002 + 0.003 * (k % 7) / 6);
  const double length = 0.3;
  for (const bool is_periodic : {false, true}) {
    ArrangementReport report;
    const auto x = arrange({0.05, length, is_periodic}, diameters, 3, &report);
    REQUIRE(x.size() == diameters.size());
    CHECK(report.inserted_overlapping > 0);
    double least = INFINITY, outside = -INFINITY;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double r = diameters[i] / 2;
      outside = std::max(outside, std::hypot(x[i][0], x[i][1]) + r - 0.025);
      if (!is_periodic) outside = std::max({outside, r - x[i][2], x[i][2] + r - length});
      for (std::size_t j = 0; j < i; ++j) {
        double z = x[i][2] - x[j][2];
        if (is_periodic) z -= length * std::round(z / length);
        least = std::min(least, std::hypot(x[i][0] - x[j][0], x[i][1] - x[j][1], z) / (r + diameters[j] / 2));
      }
    }
    CHECK(least >= 1);
    CHECK(report.min_distance >= 1);
    CHECK(outside < 0);
    CHECK(arrange({0.05, length, is_periodic}, diameters, 3) == x);
  }
  const auto moving = arrange_moving({0.05, length, true}, diameters, 0.5, 3);
  CHECK(moving.size() == diameters.size());
  CHECK(std::fabs(moving[7].velocity[1]) <= 0.5);
}

TEST_CASE("arrangement: unequal spheres that do not fit are refused with their solids fraction") {
  std::vector<double> diameters(400, 0.01);
  diameters.resize(4700, 0.005);
  try {
    arrange({0.05, 0.4, false}, diameters, 1);
    FAIL("they do not fit");
  } catch (const Failure& failure) {
    const std::string message = failure.what();
    CHECK(message.find("4700 particles of 0.005 to 0.01 m") != std::string::npos);
    CHECK(message.find("solids fraction 0.625") != std::string::npos);
  }
}

namespace {

/// A large sphere at rest, and a small one that comes along z, turns round at an overlap of `depth`, and goes at a
/// half.
class Bounce final : public NoSimulation {
 public:
  static constexpr double speed = 1, touching = 0.0075, depth = 1e-5, start_gap = 2.05e-6, time_step = 1e-7;
  Status run(long long steps) override { return step_ += steps, Status{}; }
  long long step() const override { return step_; }
  double time() const override { return static_cast<double>(step_) * time_step; }
  Particle particle(int id) const override {
    Particle p{};
    p.position[2] = 0.03;
    if (id == 0) return p;
    const double turn = (start_gap + depth) / speed;
    const bool before = time() < turn;
    p.position[2] += touching - depth + (before ? speed * (turn - time()) : 0.5 * speed * (time() - turn));
    p.velocity[2] = before ? -speed : 0.5 * speed;
    p.velocity[0] = before ? 0.2 : 0.1;
    p.angular_velocity[1] = 10;
    return p;
  }

 private:
  long long step_ = 0;
};

}  // namespace

TEST_CASE("collision tracker: two unequal spheres touch where their radii say") {
  CaseFacts facts = case_facts<TwoSpecies<5000>>();
  const ParticleKind two[] = {{0.01, 1000, 0}, {0.005, 1000, 1}};
  facts.kinds = two, facts.kind_count = facts.particle_count = 2, facts.has_wall = false;
  Bounce scene;
  CollisionTracker tracker(facts);
  for (int k = 0; k < 400; ++k) tracker.observe(scene), scene.run(1);
  REQUIRE(tracker.result());
  CHECK(tracker.result()->restitution == Approx(0.5).epsilon(1e-9));
  CHECK(tracker.result()->tangential_restitution == Approx(0.5).epsilon(1e-9));
  CHECK(tracker.result()->contact_time == Approx(3 * Bounce::depth / Bounce::speed).epsilon(1e-6));
  CHECK(tracker.result()->max_overlap == Approx(Bounce::depth).epsilon(0.02));
}

TEST_CASE("plug analysis: solids by volume, and velocities weighted by it") {
  CaseFacts facts = case_facts<TwoSpecies<5000>>();
  facts.pipe_diameter = 0.05, facts.pipe_length = 0.8, facts.is_periodic = true, facts.slice_count = 80;
  Snapshot snapshot;  // two large at 0.1 m/s and one small at 0.9 in one slice, one small elsewhere
  for (const double z : {0.101, 0.108, 0.105, 0.4}) snapshot.particles.push_back({{0, 0, z}, {0, 0, 0.1}, {}});
  snapshot.particles[2].velocity[2] = 0.9;
  const SliceProfile profile = slice_profile(facts, snapshot, {});
  const double area = 3.14159265358979 / 4 * 0.05 * 0.05;
  CHECK(profile.solids_fraction[10] == Approx(2.125 * facts.solid_volume() / (area * 0.01)));
  CHECK(profile.solids_fraction[40] == Approx(0.125 * facts.solid_volume() / (area * 0.01)));
  CHECK(profile.axial_momentum[10] / profile.particles[10] == Approx((2 * 0.1 + 0.125 * 0.9) / 2.125));
}

// The bound on the time step with particles of several sizes: single contacts in closed form, and against the exact
// limit of random networks of springs (tools/stability/tangent.hpp).
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "cases/settle.hpp"
#include "sized_case.hpp"
#include "tools/run/random_numbers.hpp"
#include "tools/run/stability_watch.hpp"
#include "tools/stability/tangent.hpp"

using namespace fixdem;
using namespace fixdem::program;
using doctest::Approx;
using fixdem::stability::critical_step, fixdem::stability::network_of;
using fixdem::tests::FourSizes, fixdem::tests::TwoSpecies;

namespace {

constexpr double overlap = 1e-5;

Contact contact(int owner, int partner, double nx = 0.6, double ny = 0, double nz = -0.8) {
  Contact c{};
  c.owner = owner, c.partner = partner, c.overlap = overlap;
  c.normal[0] = nx, c.normal[1] = ny, c.normal[2] = nz;
  return c;
}

void take_damping(CaseFacts& facts) {
  for (ContactCoefficients* c : {&facts.pair_contact, &facts.wall_contact}) c->damping = c->tangential_damping = 0;
}

}  // namespace

TEST_CASE("stability watch: an unequal pair allows what its reduced mass does, whatever the quotient of masses") {
  const StepCriterion& euler = criterion_of(Integrator::euler);
  const auto check = [&](CaseFacts facts) {
    take_damping(facts);
    const ParticleKind &a = facts.kinds[0], &b = facts.kinds[3];
    const double k = contact_coefficients(facts, 0, 3).tangential_stiffness * std::sqrt(overlap);
    // The slip alone, 3.5 k_t / M (eq. 45): the normal spring is softer.
    const double slip = 3.5 / reduced_mass(a, b);
    // With rolling: slip and rolling are two forms of the same turning, by the levers R* / r.
    const double own = rolling_lever(facts, 0, 3), other = rolling_lever(facts, 3, 0);
    const double rolling = 2.5 * (own * own / a.mass() + other * other / b.mass());
    const double between = 2.5 * (own / a.mass() - other / b.mass());
    const double both = (slip + rolling) / 2 + std::hypot((slip - rolling) / 2, between);
    const std::vector<Contact> pair = {contact(0, 3)};
    for (const double friction : {0.0, 0.05}) {
      facts.pair_contact.rolling_friction = friction;
      const double exact = 2 / std::sqrt(k * (friction > 0 ? both : slip));
      const double bound = stable_step(facts, euler, pair).seconds;
      CHECK(bound <= exact);
      CHECK(bound > (friction > 0 ? 0.85 : 0.95) * exact);
      CHECK(critical_step(network_of(facts, pair), euler) == Approx(exact).epsilon(1e-6));
    }
  };
  check(case_facts<TwoSpecies<5000>>());
  check(case_facts<TwoSpecies<2000>>());
  check(case_facts<TwoSpecies<10000, 10000>>());
}

TEST_CASE("stability watch: a small sphere on a wall by its own radius and mass, with rolling, too") {
  CaseFacts facts = case_facts<TwoSpecies<5000>>(), equal = case_facts<cases::settle>();
  for (const double rolling : {0.0, 0.05}) {
    facts.wall_contact.rolling_friction = equal.wall_contact.rolling_friction = rolling;
    for (CaseFacts* f : {&facts, &equal}) take_damping(*f);
    const auto step = [](const CaseFacts& f, int id) {
      return stable_step(f, criterion_of(Integrator::euler), {contact(id, -1)}).seconds;
    };
    CHECK(step(facts, 1) == Approx(step(equal, 1)).epsilon(1e-12));
    CHECK(step(facts, 3) == Approx(step(equal, 1) * std::sqrt(std::sqrt(2) / 8)).epsilon(1e-6));  // m / k
  }
}

namespace {

/// Forty of some kinds with random contacts, each particle about as often the owner as the partner.
void check_networks(CaseFacts facts, const std::vector<ParticleKind>& kinds, bool are_equal) {
  RandomNumbers random(5);
  constexpr int count = 40;
  std::vector<ParticleKind> chosen;
  for (int k = 0; k < count; ++k)
    chosen.push_back(kinds[static_cast<std::size_t>(random.between(0, 0.999 * static_cast<double>(kinds.size())))]);
  facts.particle_count = count;
  if (!are_equal) facts.kinds = chosen.data();
  for (int trial = 0; trial < 10; ++trial) {
    facts.pair_contact.rolling_friction = facts.wall_contact.rolling_friction = trial % 2 == 0 ? 0 : 0.05;
    std::vector<Contact> contacts;
    for (int k = 0; k < 20 + 10 * trial; ++k) {
      const int a = static_cast<int>(random.between(0, count)), b = static_cast<int>(random.between(-8, count));
      if (a == b) continue;
      const double turn = random.between(0, 6.28), up = random.between(-1, 1), across = std::sqrt(1 - up * up);
      contacts.push_back(contact(a, b < 0 ? -1 : b, across * std::cos(turn), across * std::sin(turn), up));
      contacts.back().overlap = overlap * random.between(1e-3, 1);
    }
    for (const StepCriterion& criterion : step_criteria) {
      const double exact = critical_step(network_of(facts, contacts), criterion);
      const double bound = stable_step(facts, criterion, contacts).seconds;
      CHECK(bound <= exact * (1 + 1e-4));  // power iteration (tangent.hpp)
      CHECK(bound > 0.65 * exact);
    }
  }
}

template <class Case>
void check_networks() {
  const CaseFacts facts = case_facts<Case>();
  check_networks(facts, {facts.kinds, facts.kinds + facts.particle_count}, false);
}

}  // namespace

TEST_CASE("stability watch: below the exact limit of any network of spheres, and not far below") {
  check_networks<TwoSpecies<5000>>();
  check_networks<TwoSpecies<1000>>();
  check_networks<TwoSpecies<10000, 10000>>();
  check_networks<FourSizes>();
  check_networks(case_facts<cases::settle>(), {{}}, true);
}

TEST_CASE("rules of thumb: one spring alone keeps its own two particles") {
  const CaseFacts facts = case_facts<TwoSpecies<5000>>();
  const auto network = network_of(facts, {contact(2, 3), contact(0, 3), contact(1, -1)});
  const double small = undamped_critical_step(alone(network, network.springs[0]), stability::Springs::all);
  const double mixed = undamped_critical_step(alone(network, network.springs[1]), stability::Springs::all);
  CHECK(small < mixed);
  CHECK(mixed < undamped_critical_step(alone(network, network.springs[2]), stability::Springs::all));
}

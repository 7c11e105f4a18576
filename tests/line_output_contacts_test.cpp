// The force network: what a file of contacts says of each, and that forces on walls add up, in the kernel's own line.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <string>

#include "line_output_case.hpp"
#include "program_run.hpp"
#include "tools/run/case_adapter.hpp"
#include "tools/run/contacts_vtp.hpp"
#include "tools/run/line_slices.hpp"

using namespace fixdem;
using namespace fixdem::program;
using doctest::Approx;
using fixdem::tests::contains, fixdem::tests::ThreePresent;

namespace {

/// A line that has run for 60 ms, from a start at random.
template <class Case>
std::unique_ptr<Simulation<Case>> run_line() {
  auto simulation = std::make_unique<Simulation<Case>>();
  tests::place_all(*simulation, tests::spheres_of_line<Case>(0.5, 1, tests::Random(tests::seed())));
  REQUIRE(simulation->start().ok());
  REQUIRE(simulation->run(12000).ok());
  return simulation;
}

template <class Case>
void check_sums() {
  const auto simulation = run_line<Case>();
  const CaseFacts facts = case_facts<Case>();
  const CaseAdapter<Case> view(*simulation);
  const Snapshot snapshot = take_snapshot(view, facts.particle_count, facts.slice_count);
  CHECK(static_cast<long long>(snapshot.particles.size()) == simulation->present());
  CHECK(simulation->line().left > 0);
  int sliding = 0;
  double lost = 0;
  for (const int wall : {pipe_wall, start_end}) {
    double sum[3] = {}, size = 0;
    for (const Contact& contact : snapshot.contacts) {
      if (contact.partner != wall) continue;
      double force[3];
      force_on_partner(contact, force);
      for (int k = 0; k < 3; ++k) sum[k] += force[k], size += std::fabs(force[k]);
    }
    const Vec3<double> expected = simulation->force_on(wall);
    CHECK(std::fabs(sum[0] - expected.x) <= 1e-13 * size);
    CHECK(std::fabs(sum[1] - expected.y) <= 1e-13 * size);
    CHECK(std::fabs(sum[2] - expected.z) <= 1e-13 * size);
  }
  for (const Contact& contact : snapshot.contacts) {
    const ContactLoss loss = contact_loss(facts, snapshot, contact);
    if (loss.is_sliding) ++sliding;
    CHECK(loss.power >= 0);
    lost += loss.power;
  }
  CHECK(sliding > 0);
  CHECK(sliding < static_cast<int>(snapshot.contacts.size()));
  CHECK(lost > 0);

  // Along the pipe.
  const LineSlices slices = line_slices(facts, view, snapshot);
  double shear = 0, number = 0, solids = 0, force = 0;
  for (std::size_t k = 0; k < slices.number.size(); ++k) {
    shear += slices.wall_shear[k], force += slices.wall_force[k], number += slices.number[k];
    solids += slices.profile.solids_fraction[k];
    CHECK(slices.gas_velocity[k] == Approx(Case::gas_velocity));
  }
  CHECK(shear == Approx(simulation->force_on(pipe_wall).z).scale(force).epsilon(1e-13));
  CHECK(number == static_cast<double>(simulation->present()));
  double volume = 0;
  for (const int kind : snapshot.kinds) volume += facts.volume_share_of(kind) * facts.solid_volume();
  const double of_slice =
      3.14159265358979 / 4 * Case::pipe_diameter * Case::pipe_diameter * Case::pipe_length / Case::slice_count;
  CHECK(solids * of_slice == Approx(volume));
  CHECK(slices.inlet_pressure() == Approx(simulation->pressure_drop()));
  CHECK(slices.pressure_at(Case::pipe_length) == Approx(0).scale(slices.inlet_pressure()));
}

}  // namespace

TEST_CASE("contacts: forces on the walls of a line are those of force_on, and shear adds up along the pipe") {
  check_sums<tests::WatchedLine>();
  check_sums<tests::WatchedSpecies>();
}

TEST_CASE("contacts: lines from centre to centre or wall, by serial number") {
  CaseFacts facts = tests::facts_of_line();
  facts.pair_contact = facts.wall_contact = {1e8, 1e8, 0, 0, 0.3, 1};
  const Snapshot snapshot = take_snapshot(ThreePresent(), 6);
  const std::string text = encode_contacts(snapshot, facts, VtpData::text);
  const auto array = [&](const std::string& name) {
    const std::size_t at = text.find("Name=\"" + name + "\"");
    REQUIRE(at != std::string::npos);
    const std::size_t begin = text.find('>', at) + 1;
    return text.substr(begin, text.find('<', begin) - begin);
  };
  CHECK(contains(text, "NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"2\""));
  CHECK(array("owner") == "5000000009 6");
  CHECK(array("partner") == "6 -1");
  CHECK(array("normal_force") == "2 3");
  CHECK(array("tangential_force") == "0.25 0.5");
  CHECK(array("force") == "0.25 0 2 0 -3 0.5");
  CHECK(array("connectivity") == "0 1 2 3");
  CHECK(array("offsets") == "2 4");
  CHECK(contains(array("Points"), "0 -0.02 0.30000000000000004 0 -0.02 0.30999"));
  CHECK(array("sliding") == "0 0");
  facts.pair_contact.friction = 0.125;  // times 2 N is what it holds
  const Contact& pair = snapshot.contacts[0];
  CHECK(contact_loss(facts, snapshot, pair).is_sliding);
  facts.friction_limit = FrictionLimit::elastic;  // 1e8 (1e-5)^1.5 = 3.16 N
  CHECK_FALSE(contact_loss(facts, snapshot, pair).is_sliding);
}

TEST_CASE("contacts: power lost in dashpots and by sliding") {
  CaseFacts facts = tests::facts_of_line();
  facts.normal = NormalLaw::linear;
  facts.pair_contact = {1000, 500, 4, 3, 0.3, 0.9};
  Snapshot snapshot;
  snapshot.particles = {{{0, 0, 0.1}, {0.1, 0, 0.2}, {}}, {{0, 0, 0.1099}, {0, 0, 0}, {}}};
  Contact contact{};
  contact.owner = 0, contact.partner = 1, contact.overlap = 1e-4, contact.normal[2] = 1;
  contact.normal_force = 1000 * 1e-4 + 4 * 0.2;
  contact.tangential_force[0] = -0.1;
  CHECK(contact_loss(facts, snapshot, contact).power == Approx(4 * 0.04 + 3 * 0.01));
  contact.tangential_force[0] = -0.3 * contact.normal_force;
  const ContactLoss sliding = contact_loss(facts, snapshot, contact);
  CHECK(sliding.is_sliding);
  CHECK(sliding.power == Approx(4 * 0.04 + 0.3 * contact.normal_force * 0.1));
  snapshot.particles[0].angular_velocity[1] = -0.1 / 0.005;  // its surface stands still
  CHECK(contact_loss(facts, snapshot, contact).power == Approx(4 * 0.04));
}

// The watch of the programs on their time step (tools/run/stability_watch.hpp), without a simulation: single contacts
// whose limits are known in closed form, warnings, the stop, and values that are no numbers. That the bound lies
// between 0.65 of the exact limit of a bed and that limit is checked where the exact limit is computed:
// tools/stability.
#include "tools/run/stability_watch.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "cases/settle.hpp"
#include "loop_end.hpp"
#include "program_run.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/no_simulation.hpp"
#include "tools/run/result_folder.hpp"

using namespace fixdem;
using namespace fixdem::program;
using fixdem::tests::contains;
using fixdem::tests::end_of_loop;
using fixdem::tests::read_bytes;
using fixdem::tests::scratch;

namespace {

CaseFacts facts_without_damping() {
  CaseFacts facts = case_facts<cases::settle>();
  for (ContactCoefficients* c : {&facts.pair_contact, &facts.wall_contact}) c->damping = c->tangential_damping = 0;
  return facts;
}

Contact contact(int owner, int partner, double overlap) {
  Contact c{};
  c.owner = owner, c.partner = partner, c.overlap = overlap;
  c.normal[0] = 0.6, c.normal[1] = 0, c.normal[2] = -0.8;
  return c;
}

constexpr double overlap = 1e-5;

}  // namespace

TEST_CASE("stability watch: a sphere on a wall, and two spheres, allow what their springs do") {
  const CaseFacts facts = facts_without_damping();
  const StepCriterion& euler = criterion_of(Integrator::euler);
  // Tangential springs are the stiffer: slip of the centre and of the turning surface, k_t (1/m + r^2/I) = 3.5 k_t/m.
  const double wall = 3.5 * facts.wall_contact.tangential_stiffness * std::sqrt(overlap) / facts.mass;
  REQUIRE(wall > 1.5 * facts.wall_contact.stiffness * std::sqrt(overlap) / facts.mass);
  const StableStep on_wall = stable_step(facts, euler, {contact(7, -1, overlap)});
  CHECK(on_wall.particle == 7);
  CHECK(on_wall.seconds <= 2 / std::sqrt(wall));
  CHECK(on_wall.seconds > 0.95 * 2 / std::sqrt(wall));
  const double pair = 7 * facts.pair_contact.tangential_stiffness * std::sqrt(overlap) / facts.mass;
  const StableStep of_pair = stable_step(facts, euler, {contact(3, 9, overlap)});
  CHECK((of_pair.particle == 3 || of_pair.particle == 9));
  CHECK(of_pair.seconds <= 2 / std::sqrt(pair));
  CHECK(of_pair.seconds > 0.95 * 2 / std::sqrt(pair));
}

TEST_CASE("stability watch: rolling springs stiffen a contact with a wall, and a pair not at all") {
  CaseFacts facts = facts_without_damping();
  const StepCriterion& euler = criterion_of(Integrator::euler);
  const double of_slip = stable_step(facts, euler, {contact(7, -1, overlap)}).seconds;
  facts.pair_contact.rolling_friction = facts.wall_contact.rolling_friction = 0.05;
  // Slip and rolling of one turning: [[1, s], [s, 5]] k_t/m with s^2 = 5/2, 3 + sqrt(13/2) = 5.55 instead of 3.5.
  const double wall = (3 + std::sqrt(6.5)) * facts.wall_contact.tangential_stiffness * std::sqrt(overlap) / facts.mass;
  const double on_wall = stable_step(facts, euler, {contact(7, -1, overlap)}).seconds;
  CHECK(on_wall <= 2 / std::sqrt(wall) * (1 + 1e-12));
  CHECK(on_wall > 0.95 * 2 / std::sqrt(wall));
  CHECK(on_wall < 0.85 * of_slip);
  // The two spheres turn alike where they slip, and then they do not roll: 7 as without.
  const double pair = 7 * facts.pair_contact.tangential_stiffness * std::sqrt(overlap) / facts.mass;
  const double of_pair = stable_step(facts, euler, {contact(3, 9, overlap)}).seconds;
  CHECK(of_pair <= 2 / std::sqrt(pair));
  CHECK(of_pair > 0.9 * 2 / std::sqrt(pair));
  // Each kind of contact by its own coefficient.
  facts.wall_contact.rolling_friction = 0;
  CHECK(stable_step(facts, euler, {contact(7, -1, overlap)}).seconds == of_slip);
  CHECK(stable_step(facts, euler, {contact(3, 9, overlap)}).seconds == of_pair);
}

TEST_CASE("stability watch: rolling is damped as sliding is, with the linear law, too") {
  CaseFacts facts = case_facts<cases::settle>();
  facts.wall_contact.rolling_friction = 0.05;
  for (const NormalLaw law : {NormalLaw::hertz, NormalLaw::linear}) {
    const TangentSpring s = tangent_spring(law, facts.wall_contact, overlap);
    CHECK(s.rolling_stiffness == s.tangential_stiffness);
    CHECK(s.rolling_damping == s.tangential_damping);
    const TangentSpring pair = tangent_spring(law, facts.pair_contact, overlap);
    CHECK(pair.rolling_stiffness == 0);
    CHECK(pair.rolling_damping == 0);
  }
  // h^2 k + factor h c = 4 along the stiffest motion, in which the normal spring has no part.
  const TangentSpring s = tangent_spring(facts.normal, facts.wall_contact, overlap);
  const double root = 3 + std::sqrt(6.5);
  for (const StepCriterion& criterion : step_criteria) {
    const double k = root * s.tangential_stiffness / facts.mass;
    const double c = root * criterion.tangential_damping * s.tangential_damping / facts.mass;
    const double exact = 8 / (c + std::sqrt(c * c + 16 * k));
    const double bound = stable_step(facts, criterion, {contact(0, -1, overlap)}).seconds;
    CHECK(bound <= exact * (1 + 1e-12));
    CHECK(bound > 0.95 * exact);
  }
}

TEST_CASE("stability watch: damping takes from the step what the criterion says") {
  CaseFacts facts = case_facts<cases::settle>();
  facts.pair_contact.friction = facts.wall_contact.friction = 0;  // normal springs only: h^2 k + factor h c = 4
  const TangentSpring s = tangent_spring(facts.normal, facts.wall_contact, overlap);
  for (const StepCriterion& criterion : step_criteria) {
    const double k = s.stiffness / facts.mass, c = criterion.normal_damping * s.damping / facts.mass;
    const double exact = 8 / (c + std::sqrt(c * c + 16 * k));
    const double bound = stable_step(facts, criterion, {contact(0, -1, overlap)}).seconds;
    CHECK(bound <= exact * (1 + 1e-12));
    CHECK(bound > 0.95 * exact);
  }
}

TEST_CASE("stability watch: warns once, stops beyond the limit, and takes no number for an answer") {
  CaseFacts facts = case_facts<cases::settle>();
  const double allowed = stable_step(facts, criterion_of(facts.integrator), {contact(5, 6, overlap)}).seconds;
  const std::vector<Contact> touching = {contact(5, 6, overlap)};

  facts.time_step = 0.99 * allowed;
  StabilityWatch calm(facts);
  CHECK_FALSE(calm.look(0.1, {}, 0));
  CHECK(calm.ratio() == 0);
  CHECK_FALSE(calm.look(0.1, touching, overlap));
  CHECK(calm.ratio() == doctest::Approx(0.99).epsilon(0.01));
  CHECK(calm.take_warning().empty());

  facts.time_step = 1.2 * allowed;
  StabilityWatch warned(facts);
  CHECK_FALSE(warned.look(0.125, touching, overlap));
  const std::string warning = warned.take_warning();
  CHECK(contains(warning, "warning: at 0.125 s"));
  CHECK((contains(warning, "particle 5") || contains(warning, "particle 6")));
  CHECK(contains(warning, "try [run] time_step = "));
  CHECK_FALSE(warned.look(0.25, touching, overlap));
  CHECK(warned.take_warning().empty());
  CHECK_FALSE(warned.look(0.25, touching, 0.2 * facts.smallest_radius()));
  CHECK(contains(warned.take_warning(), "overlap by 0.2 radii"));

  facts.time_step = 1.6 * allowed;
  StabilityWatch stopped(facts);
  CHECK(stopped.look(0.25, touching, overlap));
  CHECK(contains(stopped.stop_message(), "at 0.25 s"));
  CHECK(contains(stopped.stop_message(), "limit 1.5"));
  facts.stability_limit = std::numeric_limits<double>::infinity();
  CHECK_FALSE(StabilityWatch(facts).look(0.25, touching, overlap));

  facts.stability_limit = 1.5, facts.time_step = 2e-6;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  StabilityWatch broken(facts);
  CHECK(broken.look(0.5, {contact(5, 6, overlap), contact(1, 2, nan), contact(3, 4, overlap)}, overlap));
  CHECK(broken.particle() == 1);
  StabilityWatch deep(facts);
  CHECK_FALSE(deep.look(0.5, touching, nan));
  CHECK(contains(deep.take_warning(), "overlap by nan"));
}

namespace {

/// Nothing moves, and from the given step on two spheres touch.
class Standing : public NoSimulation {
 public:
  explicit Standing(long long touching_from) : touching_from_(touching_from) {}
  Status run(long long steps) override { return step_ += steps, Status{}; }
  long long step() const override { return step_; }
  double time() const override { return static_cast<double>(step_) * 1e-4; }
  std::vector<Contact> contacts() const override {
    return step_ < touching_from_ ? std::vector<Contact>{} : std::vector<Contact>{contact(5, 6, overlap)};
  }

 private:
  long long touching_from_, step_ = 0;
};

/// One that cannot be copied, and fails after 10 steps.
class Failing final : public Standing {
 public:
  Failing() : Standing(1000) {}
  Status run(long long steps) override {
    Standing::run(steps);
    return step() < 10 ? Status{} : Status{Fault::too_fast, 3, step(), 0.8, 0.5};
  }
};

}  // namespace

TEST_CASE("a fault that cannot be gone back from is reported, and no good state is claimed") {
  CaseFacts facts = case_facts<cases::settle>();
  facts.log_interval = 0.01, facts.frame_interval = 0;
  Options options;
  options.out = scratch("no_way_back");
  options.duration = 0.1, options.quiet = true;
  prepare_folder(options.out);
  Failing view;
  const auto [code, message] = end_of_loop(view, facts, options);
  CHECK(code == exit_unstable);
  CHECK(contains(message, "particle 3 moves 0.8 radii in one step (limit 0.5)"));
  CHECK_FALSE(contains(message, "good"));
  CHECK(nlohmann::json::parse(read_bytes(options.out / "summary.json"))["status"] == "too_fast");
  for (const char* name : {"fault.vtp", "stopped.fixdem", "final.fixdem"})
    CHECK_FALSE(std::filesystem::exists(options.out / name));
}

TEST_CASE("stability watch: a run whose step is far too large ends with 5, says so, and leaves no final state") {
  CaseFacts facts = case_facts<cases::settle>();
  facts.time_step = 1e-4;  // some 5 stable steps
  facts.log_interval = 0.01, facts.frame_interval = 0;
  for (const long long touching_from : {0, 250}) {
    Options options;
    options.out = scratch("too_large_a_step");
    options.duration = 0.1, options.quiet = true;
    std::filesystem::remove_all(options.out);
    prepare_folder(options.out);
    Standing view(touching_from);
    const auto [code, message] = end_of_loop(view, facts, options);
    CHECK(code == exit_unstable);
    const std::string step = touching_from == 0 ? "0" : "300";  // the first row of the log that sees them
    CHECK(contains(message, "stopped at step " + step + ":"));
    CHECK(contains(message, "particle 5"));
    CHECK(contains(message, "try [run] time_step = "));
    CHECK(nlohmann::json::parse(read_bytes(options.out / "summary.json"))["status"] == "time_step_too_large");
    CHECK(contains(read_bytes(options.out / "log.csv"), "," + step + ","));
    CHECK(std::filesystem::exists(options.out / "frames/frame_000000.vtp"));
    CHECK_FALSE(std::filesystem::exists(options.out / "final.fixdem"));
  }
}

// Predicted and measured limits of the time step of one case, its rules of thumb, and what energy tangential laws
// create.
//
// Compiled for a case like its program. Usage: limits STATE OUT SPEED [quick]. STATE: the case's particles at rest
// (kernel_runs.cpp); OUT: folder for limits.csv, rules.csv and grazing.csv; SPEED: the largest of the case's run, m/s.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "own_start.hpp"
#include "rules_of_thumb.hpp"
#include "tangent.hpp"
#include "tools/run/fault_report.hpp"
#include "trials.hpp"

namespace fixdem::stability {
namespace {

constexpr double pi = 3.14159265358979323846;

/// The facts of the case with another restitution, for the bound that programs watch.
program::CaseFacts facts_at_present() {
  program::CaseFacts facts = program::case_facts<Case>();
  facts.pair_contact = coefficients_of(true), facts.wall_contact = coefficients_of(false);
  return facts;
}

std::vector<Contact> contacts_of(const Reference& program) {
  std::vector<Contact> contacts;
  program.for_each_contact([&](const reference::Contact& c) {
    Contact seen{};
    seen.owner = c.owner, seen.partner = c.partner, seen.overlap = c.overlap;
    for (int k = 0; k < 3; ++k) seen.normal[k] = c.normal[k];
    contacts.push_back(seen);
  });
  return contacts;
}

/// Contacts of a scene: those of a first step too short to move anything.
std::vector<Contact> contacts_of(const Scene& scene) {
  VariableCase::time_step = 1e-15;
  Reference program = loaded(scene);
  program.run(1);
  return contacts_of(program);
}

double predicted_step(const std::vector<Contact>& contacts, const program::StepCriterion& criterion) {
  program::CaseFacts facts = facts_at_present();
  facts.particle_count = VariableCase::particle_count;
  return critical_step(network_of(facts, contacts), criterion);
}

class Table {
 public:
  Table(const std::string& path, const char* header) : file_(path) { file_ << header << "\n"; }
  template <class... Values>
  void row(fmt::format_string<Values...> format, Values&&... values) {
    file_ << fmt::format(format, std::forward<Values>(values)...) << std::endl;
  }

 private:
  std::ofstream file_;
};

const char* kind(const program::StepCriterion& criterion) { return criterion.is_exact ? "exact" : "safe side"; }

/// The settled bed: prediction and measurement for each integrator and several restitutions.
void bed_limits(const Scene& bed, bool is_quick, Table& table) {
  std::vector<double> restitutions = {1, 0.95, 0.9, 0.7, 0.5, 0.2};
  if (is_quick) restitutions = {1, 0.9, 0.2};
  if (Case::particle_count > 300) restitutions = {1, 0.9, 0.5, 0.2};  // a step of the reference looks at all pairs
  for (const double e : restitutions)
    for (const program::StepCriterion& criterion : program::step_criteria) {
      VariableCase::reset();
      VariableCase::has_gas = false, VariableCase::restitution = VariableCase::wall_restitution = e,
      VariableCase::integrator = criterion.integrator;
      const auto contacts = contacts_of(bed);
      const double predicted = predicted_step(contacts, criterion);
      const double bound = program::stable_step(facts_at_present(), criterion, contacts).seconds;
      const auto passes = [&] { return bed_is_stable(bed, criterion.is_exact ? 400 : 1200); };
      const double measured = criterion.is_exact ? measured_limit(0.98 * predicted, 1.03 * predicted, 0.001, passes)
                                                 : measured_limit(1.5 * predicted, 3 * predicted, 0.02, passes);
      table.row("settled bed,{},{},{},{:.5g},{:.5g},{:.5g}", criterion.name, kind(criterion), e, predicted, bound,
                measured);
    }
}

/// Collisions at the maximum speed, straight and at 45 degrees. Predicted: the springs at the maximum overlap.
void collision_limits(double speed, Table& table) {
  for (const bool is_pair : {false, true})
    for (const double degrees : {0.0, 45.0}) {
      if (is_pair ? Case::particle_count < 2 : !Case::has_wall) continue;
      for (const program::StepCriterion& criterion : program::step_criteria) {
        VariableCase::reset();
        VariableCase::has_gas = false, VariableCase::integrator = criterion.integrator;
        const Impact impact{is_pair, speed, degrees * pi / 180};
        const double contact_time = program::contact_time(facts_at_present(), speed);
        VariableCase::time_step = contact_time / 1000;
        const double deepest = rebound(impact, 0.5).maximum_overlap;
        const auto contacts = contacts_of(impact_scene(impact, -deepest));
        const double predicted = predicted_step(contacts, criterion);
        auto facts = facts_at_present();
        facts.particle_count = 2;
        const double bound = program::stable_step(facts, criterion, contacts).seconds;
        const double measured =
            measured_limit(0.02 * contact_time, 0.1 * contact_time, 0.005, [&] { return collision_is_stable(impact); });
        table.row("{} at {:.3g} m/s and {:.0f} degrees,{},{},{},{:.5g},{:.5g},{:.5g}", is_pair ? "pair" : "wall", speed,
                  degrees, criterion.name, kind(criterion),
                  is_pair ? Case::restitution : Derived<Case>::wall_restitution, predicted, bound, measured);
      }
    }
}

/// The case from its own start.
void run_limits(double duration, double settled_limit, Table& table) {
  const Scene start = own_start();
  for (const program::StepCriterion& criterion : program::step_criteria) {
    VariableCase::reset();
    VariableCase::integrator = criterion.integrator;
    const double measured =
        measured_limit(settled_limit * 0.8, settled_limit * 1.6, 0.02, [&] { return run_is_stable(start, duration); });
    table.row("first {:.3g} s of the case,{},{},{},,,{:.5g}", duration, criterion.name, kind(criterion),
              Case::restitution, measured);
  }
}

/// What a tangential law gains in one impact without damping, over angles of incidence.
void grazing(bool is_quick, Table& table) {
  const std::pair<TangentialLaw, const char*> laws[] = {{TangentialLaw::displacement, "displacement"},
                                                        {TangentialLaw::force, "force"},
                                                        {TangentialLaw::rescale, "rescale"}};
  const double own = Case::poisson_ratio, growth = is_quick ? 3 : 1.25;
  for (const double nu : is_quick ? std::vector<double>{own} : std::vector<double>{0, 0.1, 0.23, own, 0.5})
    for (const bool is_pair : {true, false})
      for (const auto& [law, name] : laws)
        for (double degrees = 0.25; degrees < 90; degrees *= growth) {
          VariableCase::reset();
          VariableCase::has_gas = false, VariableCase::restitution = VariableCase::wall_restitution = 1,
          VariableCase::tangential = law, VariableCase::rolling_friction = VariableCase::wall_rolling_friction = 0;
          VariableCase::integrator = Integrator::leapfrog;
          VariableCase::poisson_ratio = VariableCase::wall_poisson_ratio = nu;
          const auto c = coefficients_of(is_pair);
          if (c.friction == 0) continue;
          const Impact impact{is_pair, 1, degrees * pi / 180};
          VariableCase::time_step = program::contact_time(facts_at_present(), std::cos(impact.angle)) / 1000;
          const Rebound r = rebound(impact, 0.5);
          table.row("{},{:.4g},{:.4g},{},{:.3g},{:.4g},{:.4g}", is_pair ? "pair" : "wall", nu,
                    c.tangential_stiffness / (1.5 * c.stiffness), name, degrees,
                    (r.energy_ratio - 1) / r.tangential_share, r.created);
        }
}

int run(const std::string& state_file, const std::string& out, double speed, bool is_quick) {
  const program::StoredState stored = program::read_state(state_file);
  Scene bed{stored.particles, stored.histories};
  for (Particle& p : bed.particles)
    for (int c = 0; c < 3; ++c) p.velocity[c] = p.angular_velocity[c] = 0;
  {
    Table table(out + "/limits.csv",
                "scene,integrator,criterion,restitution,predicted step [s],watched bound [s],measured limit [s]");
    bed_limits(bed, is_quick, table);
    collision_limits(speed, table);
    VariableCase::reset();
    const double settled = predicted_step(contacts_of(bed), program::criterion_of(Case::integrator));
    if (!is_quick) run_limits(std::min(0.05, Case::duration), settled, table);
  }
  {
    VariableCase::reset();
    VariableCase::has_gas = false;
    const auto contacts = contacts_of(bed);
    Table table(out + "/rules.csv", "rule,step [s],true limit [s],ratio");
    const double exact = predicted_step(contacts, program::criterion_of(Case::integrator));
    for (const Rule& rule :
         rules_of_thumb(program::case_facts<Case>(), Case::youngs_modulus, Case::poisson_ratio, contacts, speed))
      table.row("\"{}\",{:.5g},{:.5g},{:.4g}", rule.name, rule.seconds, exact, rule.seconds / exact);
  }
  if (Case::normal == NormalLaw::hertz && Derived<Case>::has_rotation) {
    Table table(out + "/grazing.csv",
                "contact,poisson ratio,k_t / k_n,tangential law,degrees from the normal,gained / tangential energy,"
                "unaccounted / kinetic energy");
    grazing(is_quick, table);
  }
  return 0;
}

}  // namespace
}  // namespace fixdem::stability

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: limits STATE OUT SPEED [quick]\n", stderr);
    return 2;
  }
  try {
    return fixdem::stability::run(argv[1], argv[2], std::atof(argv[3]), argc > 4 && std::strcmp(argv[4], "quick") == 0);
  } catch (const std::exception& error) {
    std::fputs(fmt::format("limits: {}\n", error.what()).c_str(), stderr);
    return 1;
  }
}

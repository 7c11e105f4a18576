#include "stability_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fault_report.hpp"

namespace fixdem::program {
namespace {

/// 6 x 6 block of one particle, in coordinates scaled by the root of mass and of moment of inertia.
using Block = std::array<std::array<double, 6>, 6>;

/// Adds normal * n n^T + tangential * (slip form of a contact with normal n) + rolling * (rolling form), over the mass.
/// n is the owner's; for its partner `side` is -1.
/// The slip of a particle that moves by x and turns by r theta is (1 - n n^T) x + r theta x n; with I = 2/5 m r^2 its
/// turning counts sqrt(5/2)-fold. Rolling is lever * r theta x n, of the same turning as the slip: on a wall the two
/// springs are coupled, and the largest eigenvalue rises from 3.5 to 5.55 times k_t / m.
void add_contact(Block& block, const double* n, double side, double normal, double tangential, double rolling,
                 double lever) {
  static const double turning = std::sqrt(2.5);
  const double cross[3][3] = {{0, n[2], -n[1]}, {-n[2], 0, n[0]}, {n[1], -n[0], 0}};  // theta x n
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const double along = n[a] * n[b], across = (a == b ? 1 : 0) - along;
      block[a][b] += normal * along + tangential * across;
      block[3 + a][3 + b] += 2.5 * (tangential + lever * lever * rolling) * across;
      block[a][3 + b] += side * turning * tangential * cross[a][b];
      block[3 + b][a] += side * turning * tangential * cross[a][b];
    }
}

double row_sum(const Block& block, std::size_t row) {
  double sum = 0;
  for (const double entry : block[row]) sum += std::fabs(entry);
  return sum;
}

Block squared(const Block& a) {
  Block product{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t j = 0; j < 6; ++j) product[i][j] += a[i][k] * a[k][j];
  return product;
}

/// Bound on the maximum eigenvalue of h^2 stiffness + h damping.
double eigenvalue_bound(const Block& stiffness, const Block& damping, double h) {
  Block a{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) a[i][j] = h * h * stiffness[i][j] + h * damping[i][j];
  const Block power = squared(squared(squared(squared(a))));
  double maximum = 0;
  for (std::size_t row = 0; row < 6; ++row) maximum = std::fmax(maximum, row_sum(power, row));
  return std::sqrt(std::sqrt(std::sqrt(std::sqrt(maximum))));
}

/// The particles that contacts are of: how many, and what kind each is.
struct Bodies {
  int count;
  const Snapshot* of;
  int kind(int id) const { return of != nullptr ? of->kind(id) : id; }
  int partner_kind(int partner) const { return partner >= 0 ? kind(partner) : partner; }
};

/// Positive weights of particles, greater the stiffer they and their neighbours are held: a few products with the graph
/// of contacts over the masses, from weights m^(-1/2). The bound holds for any; these make it tight where few particles
/// are stiffest, and where masses differ: the quotient for a pair begins as (m_i / m_j)^(1/2).
std::vector<double> weights_of(const CaseFacts& facts, const Bodies& bodies, const std::vector<Contact>& contacts,
                               const std::vector<double>& held) {
  constexpr int products = 2;             // more favour a few contacts too much
  std::vector<double> weight, lightness;  // of the sphere of reference: 1
  for (int i = 0; i < bodies.count; ++i) {
    lightness.push_back(facts.has_sizes() ? facts.mass / facts.mass_of(bodies.kind(i)) : 1);
    weight.push_back(std::sqrt(lightness.back()));
  }
  for (int k = 0; k < products; ++k) {
    std::vector<double> next(weight.size(), 0.0);
    double maximum = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto i = static_cast<std::size_t>(contacts[c].owner);
      if (contacts[c].partner < 0) {
        next[i] += lightness[i] * held[c] * weight[i];
      } else {
        const auto j = static_cast<std::size_t>(contacts[c].partner);
        next[i] += lightness[i] * held[c] * (weight[i] + weight[j]);
        next[j] += lightness[j] * held[c] * (weight[i] + weight[j]);
      }
    }
    for (const double w : next) maximum = std::fmax(maximum, w);
    // A little of everything is kept, so that no quotient of weights overflows.
    for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = maximum > 0 ? next[i] / maximum + 1e-3 : 1;
  }
  return weight;
}

/// Two digits, rounded down.
double two_digits_below(double x) {
  if (!(x > 0) || !std::isfinite(x)) return x;
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::floor(x / unit) * unit;
}

}  // namespace

TangentSpring tangent_spring(NormalLaw law, const ContactCoefficients& c, double overlap) {
  const double sticks = c.friction > 0 ? 1 : 0;  // without friction there is no tangential law
  const bool is_linear = law == NormalLaw::linear;
  const double root = is_linear ? 1 : std::sqrt(overlap), fourth_root = std::sqrt(root);
  TangentSpring spring{(is_linear ? 1 : 1.5) * c.stiffness * root, sticks * c.tangential_stiffness * root,
                       c.damping * fourth_root, sticks * c.tangential_damping * fourth_root};
  if (c.rolling_friction > 0)
    spring.rolling_stiffness = spring.tangential_stiffness, spring.rolling_damping = spring.tangential_damping;
  return spring;
}

StableStep stable_step(const CaseFacts& facts, const StepCriterion& criterion, const std::vector<Contact>& contacts,
                       const Snapshot* of) {
  const Bodies bodies{of != nullptr ? static_cast<int>(of->particles.size()) : facts.particle_count, of};
  struct Blocks {
    Block stiffness{}, damping{};
  };
  std::vector<Blocks> blocks(static_cast<std::size_t>(bodies.count));
  std::vector<TangentSpring> springs;
  std::vector<double> held;
  for (const Contact& contact : contacts) {
    const ContactCoefficients kind =
        contact_coefficients(facts, bodies.kind(contact.owner), bodies.partner_kind(contact.partner));
    springs.push_back(tangent_spring(facts.normal, kind, contact.overlap));
    const double root = facts.normal == NormalLaw::linear ? 1 : std::sqrt(contact.overlap);
    held.push_back(springs.back().stiffness + kind.tangential_stiffness * root +  // whether there is friction or not
                   criterion.normal_damping * springs.back().damping / facts.time_step);
  }
  const std::vector<double> weight = weights_of(facts, bodies, contacts, held);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    const TangentSpring& spring = springs[c];
    const auto add = [&](int particle, int other, double share) {
      Blocks& b = blocks[static_cast<std::size_t>(particle)];
      share /= facts.mass_of(bodies.kind(particle));
      const double lever = rolling_lever(facts, bodies.kind(particle), bodies.partner_kind(other)),
                   across = share * criterion.tangential_damping;
      const double side = particle == contact.owner ? 1 : -1;
      add_contact(b.stiffness, contact.normal, side, share * spring.stiffness, share * spring.tangential_stiffness,
                  share * spring.rolling_stiffness, lever);
      add_contact(b.damping, contact.normal, side, share * criterion.normal_damping * spring.damping,
                  across * spring.tangential_damping, across * spring.rolling_damping, lever);
    };
    if (contact.partner < 0) {
      add(contact.owner, contact.partner, 1);
    } else {
      const double quotient =
          weight[static_cast<std::size_t>(contact.partner)] / weight[static_cast<std::size_t>(contact.owner)];
      add(contact.owner, contact.partner, 1 + quotient);
      add(contact.partner, contact.owner, 1 + 1 / quotient);
    }
  }
  StableStep least{std::numeric_limits<double>::infinity(), -1};
  for (int i = 0; i < bodies.count; ++i) {
    const Blocks& b = blocks[static_cast<std::size_t>(i)];
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < 6; ++row) {
      const double stiffness = row_sum(b.stiffness, row), damping = row_sum(b.damping, row);
      if (stiffness == 0 && damping == 0) continue;
      const double of_row = 8 / (damping + std::sqrt(damping * damping + 16 * stiffness));
      if (of_row != of_row) return {of_row, i};  // no number: nothing is known to be stable
      step = std::fmin(step, of_row);
    }
    for (double growth = 2; step < least.seconds && growth > 1.002;) {
      growth = std::sqrt(4 / eigenvalue_bound(b.stiffness, b.damping, step));
      step *= std::fmax(growth, 1);
    }
    if (step < least.seconds) least = {step, i};
  }
  return least;
}

bool StabilityWatch::look(double time, const std::vector<Contact>& contacts, double max_overlap, const Snapshot* of) {
  const StableStep stable = stable_step(facts_, criterion_of(facts_.integrator), contacts, of);
  time_ = time, stable_ = stable.seconds, particle_ = stable.particle;
  if (of != nullptr && particle_ >= 0) particle_ = of->serial(stable.particle);
  ratio_ = facts_.time_step / stable.seconds;  // 0 without contacts
  if (!(ratio_ <= maximum_ratio_)) maximum_ratio_ = ratio_;
  if (!(max_overlap <= facts_.overlap_warning * facts_.smallest_radius()) && !has_warned_of_overlap_) {
    has_warned_of_overlap_ = true;
    warning_ += fmt::format(
        "fixdem: warning: at {:.6g} s contacts overlap by {:.3g} {} (warned of beyond {:.3g}): the contact law is "
        "meant for "
        "small overlaps\n  raise youngs_modulus, or [run] overlap_warning if this is meant\n",
        time, max_overlap / facts_.smallest_radius(), overlap_unit(facts_), facts_.overlap_warning);
  }
  if (!(ratio_ <= facts_.stability_limit)) return true;
  if (!(ratio_ <= 1) && !has_warned_of_step_) {
    has_warned_of_step_ = true;
    warning_ += fmt::format(
        "fixdem: warning: {}: the run may become unstable, or silently wrong\n  try [run] time_step = {:.2g}\n",
        excess(time), two_digits_below(stable_));
  }
  return false;
}

std::string StabilityWatch::take_warning() {
  std::string text;
  text.swap(warning_);
  return text;
}

std::string StabilityWatch::excess(double time) const {
  return fmt::format(
      "at {:.6g} s the contacts of particle {} are sure to be stable up to a time step of {:.3g} s only, and "
      "it is {:.3g} s, {:.3g} times as much",
      time, particle_, stable_, facts_.time_step, ratio_);
}

std::string StabilityWatch::stop_message() const {
  return fmt::format(
      "{} (limit {:.3g})\n  try [run] time_step = {:.2g}, a lower youngs_modulus, or, if this is meant, a higher "
      "[run] stability_limit",
      excess(time_), facts_.stability_limit, two_digits_below(stable_));
}

}  // namespace fixdem::program

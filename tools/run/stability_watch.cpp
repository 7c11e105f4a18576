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

/// Adds normal * n n^T + tangential * (slip form of a contact with normal n), over the mass. The slip of a particle
/// that moves by x and turns by r theta is (1 - n n^T) x + r theta x n; with I = 2/5 m r^2 its turning counts
/// sqrt(5/2)-fold.
void add_contact(Block& block, const double* n, double normal, double tangential) {
  static const double turning = std::sqrt(2.5);
  const double cross[3][3] = {{0, n[2], -n[1]}, {-n[2], 0, n[0]}, {n[1], -n[0], 0}};  // theta x n
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const double along = n[a] * n[b], across = (a == b ? 1 : 0) - along;
      block[a][b] += normal * along + tangential * across;
      block[3 + a][3 + b] += 2.5 * tangential * across;
      block[a][3 + b] += turning * tangential * cross[a][b];
      block[3 + b][a] += turning * tangential * cross[a][b];
    }
}

double row_sum(const Block& block, std::size_t row) {
  double sum = 0;
  for (const double entry : block[row]) sum += std::fabs(entry);
  return sum;
}

/// Two digits, rounded down.
double two_digits_below(double x) {
  if (!(x > 0) || !std::isfinite(x)) return x;
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::floor(x / unit) * unit;
}

}  // namespace

TangentSpring tangent_spring(NormalLaw law, const ContactCoefficients& c, double overlap) {
  if (law == NormalLaw::linear) return {c.stiffness, c.tangential_stiffness, c.damping, c.tangential_damping};
  const double root = std::sqrt(overlap), fourth_root = std::sqrt(root);
  return {1.5 * c.stiffness * root, c.tangential_stiffness * root, c.damping * fourth_root,
          c.tangential_damping * fourth_root};
}

StableStep stable_step(const CaseFacts& facts, const StepCriterion& criterion, const std::vector<Contact>& contacts) {
  struct Blocks {
    Block stiffness{}, damping{};
  };
  std::vector<Blocks> blocks(static_cast<std::size_t>(facts.particle_count));
  const bool rolls = facts.friction > 0;
  for (const Contact& contact : contacts) {
    const bool is_pair = contact.partner >= 0;
    const TangentSpring spring =
        tangent_spring(facts.normal, is_pair ? facts.pair_contact : facts.wall_contact, contact.overlap);
    const double share = (is_pair ? 2 : 1) / facts.mass;
    const auto add = [&](int particle) {
      Blocks& b = blocks[static_cast<std::size_t>(particle)];
      add_contact(b.stiffness, contact.normal, share * spring.stiffness,
                  rolls ? share * spring.tangential_stiffness : 0);
      add_contact(b.damping, contact.normal, share * criterion.normal_damping * spring.damping,
                  rolls ? share * criterion.tangential_damping * spring.tangential_damping : 0);
    };
    add(contact.owner);
    if (is_pair) add(contact.partner);  // the other side of n gives the same block
  }
  StableStep least{std::numeric_limits<double>::infinity(), -1};
  for (int i = 0; i < facts.particle_count; ++i) {
    const Blocks& b = blocks[static_cast<std::size_t>(i)];
    for (std::size_t row = 0; row < 6; ++row) {
      const double stiffness = row_sum(b.stiffness, row), damping = row_sum(b.damping, row);
      if (stiffness == 0 && damping == 0) continue;
      const double step = 8 / (damping + std::sqrt(damping * damping + 16 * stiffness));
      if (step != step) return {step, i};  // no number: nothing is known to be stable
      if (step < least.seconds) least = {step, i};
    }
  }
  return least;
}

bool StabilityWatch::look(double time, const std::vector<Contact>& contacts, double max_overlap) {
  const StableStep stable = stable_step(facts_, criterion_of(facts_.integrator), contacts);
  time_ = time, stable_ = stable.seconds, particle_ = stable.particle;
  ratio_ = facts_.time_step / stable.seconds;  // 0 without contacts
  if (!(ratio_ <= greatest_ratio_)) greatest_ratio_ = ratio_;
  if (!(max_overlap <= facts_.overlap_warning * facts_.radius()) && !has_warned_of_overlap_) {
    has_warned_of_overlap_ = true;
    warning_ += fmt::format(
        "fixdem: warning: at {:.6g} s contacts overlap by {:.3g} radii (warned of beyond {:.3g}): the contact law is "
        "meant for "
        "small overlaps\n  raise youngs_modulus, or [run] overlap_warning if this is meant\n",
        time, max_overlap / facts_.radius(), facts_.overlap_warning);
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

// Continuous distributions of diameters, and the particles that stand for one.
//
// Particle k of n has the quantile (k + 1/2)/n of the distribution by number, which is cut at its ends and made whole
// again. So the smallest and the largest are known beforehand, and n particles represent it without the noise of a
// sample. Lengths in metres.
#pragma once

#include <vector>

#include "case_values.hpp"

namespace fixdem::casegen {

class SizeDistribution {
 public:
  /// Of what `[particles.sizes]` says, which must be in order but for the share that is kept.
  explicit SizeDistribution(const CaseValues& values);

  /// Share of the particles of the uncut distribution that lie between its ends.
  double kept_share() const { return kept_; }

  /// Diameter, to ten digits, below which this share, above 0 and below 1, of the particles lies.
  double quantile(double share) const;

 private:
  enum class Kind { uniform, normal, lognormal, table };
  double scaled(double diameter) const;  ///< what is normally distributed
  double normal_quantile(double share) const;
  double table_quantile(double share) const;

  Kind kind_;
  double low_, high_;                        // where it is cut
  double middle_ = 0, deviation_ = 1;        // of the normal distribution
  double below_ = 0, above_ = 0, kept_ = 1;  // shares of it that are cut away, and that stays
  bool by_volume_;
  std::vector<double> diameters_, numbers_;  // sieves, and particles between two of them in a unit of their own
};

/// So that a difference in the last bits of a mathematics library makes no other case of this one.
double to_ten_digits(double value);

/// The diameters of so many particles in the order that follows from the seed.
std::vector<double> distributed_diameters(const CaseValues& values, std::int64_t number);

}  // namespace fixdem::casegen

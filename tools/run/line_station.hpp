// A place along a line that is looked at again and again: plugs that pass it, and for each `[[probe]]` of a case a file
// probe_N.csv with a row at its interval (numbers from 0 in the order of the case file).
//
// Solids fraction: over three slices. A plug passes when it rises through 0.40, once it has been below 0.30. Pressure
// above the outlet. Mass flow: mass of the particles that have gone beyond the place since the row before, less what
// has come back, over the time between; empty in the first row. SI units.
#pragma once

#include <limits>
#include <string>

#include "line_slices.hpp"

namespace fixdem::program {

/// Counts the plugs that pass.
class Passages {
 public:
  void look(double solids_fraction);
  int count() const { return count_; }
  template <class Archive>
  void transfer(Archive& archive) {
    archive(count_, is_armed_);
  }

 private:
  int count_ = 0;
  bool is_armed_ = true;
};

/// Mass of the particles at z and beyond, kg.
double mass_from(const ParticleKinds&, const Snapshot&, double z);

class Station {
 public:
  explicit Station(double position) : position_(position) {}

  void look(const LineSlices&);
  const Passages& passages() const { return passages_; }
  /// The next row of its file, after look().
  std::string row(const ParticleKinds&, const Snapshot&, const LineSlices&, const LineTotals&);
  static std::string header();
  template <class Archive>
  void transfer(Archive& archive) {
    archive(passages_, solids_fraction_, row_time_, beyond_);
  }

 private:
  double position_;  ///< m
  Passages passages_;
  double solids_fraction_ = 0;
  double row_time_ = 0, beyond_ = std::numeric_limits<double>::quiet_NaN();  ///< at the last row
};

}  // namespace fixdem::program

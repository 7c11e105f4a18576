// A line slice by slice at one moment, and slices.bin, which holds that at every `slice_interval`.
//
// slices.bin begins with one line of JSON: version, byte order, number and length of the slices, names and units of the
// quantities. Records follow, one for each moment: the time as a double, then each quantity as a float for every slice
// from z = 0 on. A long run has
// millions of them: as text they would take three times the space. tools/python/slices.py reads it, also into CSV.
#pragma once

#include <string>
#include <vector>

#include "plug_analysis.hpp"
#include "simulation_view.hpp"

namespace fixdem::program {

struct LineSlices {
  double time = 0;
  SliceProfile profile;
  std::vector<double> number;  ///< of particles
  std::vector<double>
      node_pressure;                 ///< Pa above the outlet, at the ends of the slices: one more than there are slices
  std::vector<double> gas_velocity;  ///< volume flux of gas and solids over the section, m/s
  std::vector<double> wall_force;    ///< sum of the normal forces on the pipe's wall, N
  std::vector<double> wall_shear;    ///< along the pipe, on the wall, N

  /// Above the outlet, Pa.
  double inlet_pressure() const { return node_pressure.front(); }
  double pressure_at(double z) const;
  int slice_of(double z) const;
};

LineSlices line_slices(const CaseFacts&, const SimulationView&, const Snapshot&);

std::string slices_header(const CaseFacts&);
std::string encode_slices(const LineSlices&);

}  // namespace fixdem::program

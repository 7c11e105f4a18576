// Finds the plug in a row of slices, and what a run says about it: front velocity, length, layer area ratio.
//
// Solids fraction of a slice: volume of the particles whose centres are in it, over its own. Smoothed over three slices
// (fewer at closed ends). The plug is the longest run of slices above 0.40; a gap of one slice is closed, and the pipe
// is a ring if it is periodic. Its edges are where the line between the centres of two slices crosses 0.40; the front
// is the edge towards which the gas blows. A pipe that is above 0.40 all round has no front and so no plug. Particle
// velocity: mean axial velocity of the particles inside the plug by volume, two slices at each end left out. Layer area
// ratio: mean fraction outside the plug, four slices next to each edge left out, over mean fraction inside. Over a run:
// samples of the second half of its duration. Front velocity: slope of the least-squares line through the unwrapped
// fronts; everything else: mean over the samples. At least three samples and half of all samples of that window must
// show a plug, otherwise there is none. Not a number stands for what is not defined. SI units.
#pragma once

#include <vector>

#include "case_facts.hpp"
#include "snapshot.hpp"

namespace fixdem::program {

/// What is known of each slice of equal length along the pipe.
struct SliceProfile {
  double slice_length = 0;  ///< m
  bool is_periodic = true;
  int direction = 1;                    ///< +1 or -1: where the gas blows along z
  std::vector<double> solids_fraction;  ///< not smoothed
  std::vector<double> axial_momentum;   ///< sum of axial velocities times `particles`, m/s
  std::vector<double> particles;  ///< with centres in it, in volumes of a sphere of reference (particle_kinds.hpp)
  std::vector<double> pressure_gradient;  ///< of the gas, Pa/m
};

struct PlugSample {
  bool found = false;
  double time = 0;
  double front, rear;        ///< m, front wrapped into the pipe
  double length;             ///< m
  double particle_velocity;  ///< m/s
  double layer_area_ratio;   ///< -
  double pressure_gradient;  ///< mean inside the plug, ends left out, Pa/m
  double pressure_drop;      ///< over the whole pipe, Pa
  template <class Archive>
  void transfer(Archive& archive) {
    archive(found, time, front, rear, length, particle_velocity, layer_area_ratio, pressure_gradient, pressure_drop);
  }
};

struct PlugResult {
  int samples = 0, samples_with_plug = 0;  ///< in the second half of the run
  double front_velocity, particle_velocity, length, layer_area_ratio, layer_area_ratio_eq41, pressure_gradient;
  double pressure_drop;  ///< mean over all samples of the window, plug or not
};

/// A profile in three parts, for particles that are spread over several programs: no particles yet; one more of them,
/// whose place may be anywhere, with its volume over that of the sphere of reference; and solids fractions, once all
/// particles are counted.
SliceProfile empty_profile(const CaseFacts&, const std::vector<double>& pressure_gradients);
void count_particle(SliceProfile&, double z, double axial_velocity, double volume_share = 1);
void set_solids_fractions(SliceProfile&, const CaseFacts&);

SliceProfile slice_profile(const CaseFacts&, const Snapshot&, const std::vector<double>& pressure_gradients);
PlugSample find_plug(const SliceProfile&, double time);

// What find_plug is made of, for pipes with many plugs (plug_tracks.hpp).
/// Solids fractions over three slices.
std::vector<double> smoothed(const SliceProfile&);
/// Whether each slice belongs to a plug: above 0.40, or the gap of one slice between two that are.
std::vector<bool> plug_slices(const SliceProfile&, const std::vector<double>& smooth);
/// Edges, length and particle velocity of the plug in the slices from `first` to `last`, which on a ring may go past
/// the end, and the pressure gradient inside.
PlugSample measure_plug(const SliceProfile&, const std::vector<double>& smooth, int first, int last, double time);
/// Eq. (41): what the layer between plugs is, over the section, where particles in the plug move at this velocity.
double layer_ratio_eq41(double particle_velocity, double gravity, double pipe_diameter);

inline constexpr double plug_threshold = 0.40;  ///< solids fraction above which a slice is plug
inline constexpr int layer_margin = 4;          ///< slices next to the plug that do not count as layer

/// The samples of one run.
class PlugRecord {
 public:
  explicit PlugRecord(double pipe_length) : pipe_length_(pipe_length) {}
  void add(const PlugSample& sample) { samples_.push_back(sample); }
  PlugResult result(double duration, double gravity, double pipe_diameter) const;
  /// For checkpoints.
  template <class Archive>
  void transfer(Archive& archive) {
    archive(samples_);
  }

 private:
  double pipe_length_;
  std::vector<PlugSample> samples_;
};

}  // namespace fixdem::program

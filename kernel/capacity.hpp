// How large the arrays of a case are: cells, chunks of the pipe, pairs, histories, steps of a tile.
//
// All of it follows from the case at compile time. Each size says what bounds it, what has been observed, and what
// happens when it is not enough. No packing of spheres that do not overlap exceeds any of them. Lengths in metres
// unless a name says diameters.
#pragma once

#include "case.hpp"

namespace fixdem {

/// Whether a particle as fast as a fall through the length of the pipe goes so far in a step that lists are what costs.
template <class Case>
inline constexpr bool steps_are_long = square_root(2 * 9.81 * Case::pipe_length) * Case::time_step >
                                       0.0075 * smallest_diameter<Case>;

/// How far beyond touching the outer list of pairs reaches (near_list.hpp), in diameters (of the smallest sphere). With
/// gas it answers who floats as well, for which 0.1 d must be left (floaters.hpp). A line of 10 mm at 5e-5 s took 12.2
/// s with 0.3 and 11.5 s with 0.45; a plug of 3 mm at 1e-5 s takes 4 % more with 0.6 than with either.
template <class Case>
inline constexpr double outer_margin = (steps_are_long<Case> ? 0.4 : 0.25) + (Case::has_gas ? 0.05 : 0);
/// Centres nearer than this, in r_i + r_j, make a particle part of the bed.
inline constexpr double near_reach = 1.1;

/// Distance within which the outer list holds all pairs with r_i + r_j = `touch`: that plus the margin, and what larger
/// spheres add to the reach of the bed. `V`: a number or lanes.
template <class Case, class V>
constexpr V outer_reach(V touch, double margin) {
  if constexpr (has_sizes<Case> && Case::has_gas)
    return near_reach * touch + (margin - (near_reach - 1) * smallest_diameter<Case>);
  else
    return touch + margin;
}

/// Cells in which particles are ordered (order.hpp): no side is shorter than d + outer margin of the smallest sphere,
/// and there are no more of them than twice the particles. Across the pipe they cover the places that centres can have.
template <class Case>
struct Cells {
  static constexpr double width = Case::pipe_diameter - smallest_diameter<Case>;
  static constexpr double whole(double n) { return n > 1 ? n : 1; }
  static constexpr double side = [] {
    double side = (1 + outer_margin<Case>)*smallest_diameter<Case>;
    while (whole(width / side) * whole(width / side) * whole(Case::pipe_length / side) >
           2.0 * Case::particle_count + 64)
      side *= 1.25;
    return side;
  }();
  static constexpr int across = static_cast<int>(whole(width / side));
  static constexpr int along = static_cast<int>(whole(Case::pipe_length / side));
  static constexpr int in_slab = across * across, count = in_slab * along;
  static constexpr double length = Case::pipe_length / along;  ///< of a slab of cells
  /// Cells in each direction in which a sphere must look for those that are not larger than itself.
  static constexpr int reach_of(double diameter) {
    if (!has_sizes<Case>) return 1;
    const double cells = outer_reach<Case>(diameter, outer_margin<Case> * smallest_diameter<Case>) / side;
    const int whole_cells = static_cast<int>(cells);
    return whole_cells < cells ? whole_cells + 1 : whole_cells;
  }
  static constexpr int reach = reach_of(largest_diameter<Case>);
};

/// Particles in a chunk of the pipe. Smaller chunks waste lanes and start more loops, so 128 at least, or 64 in a scene
/// of less than 512, which may have to fit a small board; in a wide pipe so many that those within reach lie in the
/// next two or three. Never more than the scene has. Measured with 64 and 128 of 1000 particles, million
/// particle-steps/s on Zen 5: settled bed 123 and 127 (AVX2 86 and 90), mixed 136 and 153, agitated 236 and 265; 192 is
/// no better.
constexpr int particles_per_chunk(int particle_count, double pipe_diameter, double diameter) {
  const int whole_scene = (particle_count + 15) / 16 * 16, usual = particle_count < 512 ? 64 : 128;
  const double wide = 0.5 * (pipe_diameter / diameter) * (pipe_diameter / diameter);
  const int size = wide < usual ? usual : (wide < whole_scene ? static_cast<int>(wide) / 16 * 16 : whole_scene);
  return size < whole_scene ? size : whole_scene;
}

/// With several sizes: that of equal spheres, as many of which lie in a slab one of their diameters long as do of these
/// in a slab as long as their largest.
constexpr double diameter_for_chunks(double mean_volume, double largest) {
  return square_root(mean_volume / (0.5236 * largest));
}

/// A chunk beyond this would outgrow the stack (its slots are booked there) and the 32-bit offsets of its force rows.
inline constexpr int largest_chunk = 1 << 20;

/// Particles from which on the state of a scene exceeds the caches.
inline constexpr int scene_beyond_caches = 16384;

/// Chunks that a tile of several steps needs (tiles.hpp).
constexpr int chunks_for_tile(int tile_steps) { return tile_steps == 1 ? 1 : 2 * tile_steps + 4; }

/// Fixed sizes of the arrays. Each says why it is what it is and what happens when it is not enough.
template <class Case>
struct Capacity {
  /// Contacts in a batch, on every machine: it is the data layout, not the register.
  static constexpr int batch = is_mixed<Case> ? 16 : 8;
  static constexpr unsigned short all_lanes = static_cast<unsigned short>((1u << batch) - 1);  ///< a bit for each

  /// Near pairs of one particle. Twelve equal spheres touch a central one at most; the maximum number observed at a
  /// list cut of 1.05 d is 12. The case can set it (`[capacity] neighbours`, default 14). With several sizes casegen
  /// takes 1.8 times as many of the smallest as fit around the largest by solid angles, and one. Overflow: the run
  /// stops.
  static constexpr int neighbours = Case::neighbour_capacity;

  static constexpr double ratio = Case::pipe_diameter / smallest_diameter<Case>;
  static constexpr int chunk_size = [] {
    if constexpr (has_sizes<Case>)
      return particles_per_chunk(Case::particle_count, Case::pipe_diameter,
                                 diameter_for_chunks(Case::mean_volume, Case::largest_diameter));
    else
      return particles_per_chunk(Case::particle_count, Case::pipe_diameter, Case::diameter);
  }();
  static constexpr int chunks = (Case::particle_count + chunk_size - 1) / chunk_size;

  /// Particles in the order between one and the last that it is compared with: one slab of cells and two rows. Spheres
  /// whose centres lie in a slab fill 0.7405 of a hexagonal prism around the pipe, one diameter longer than the slab,
  /// at most; 3 % are added for overlap. Only particles that overlap more, or that no wall holds, can exceed it: the
  /// run stops. With several sizes it is as many slabs as the largest sphere reaches, and one, 0.9 full of the smallest
  /// ones (random mixtures pack to 0.79 at a ratio of 5).
  static constexpr int in_reach = [] {
    if constexpr (has_sizes<Case>) {
      constexpr double length = (Cells<Case>::reach + 1) * Cells<Case>::length + Case::largest_diameter;
      constexpr double smallest = 0.5236 * Case::smallest_diameter * Case::smallest_diameter * Case::smallest_diameter;
      constexpr double most = 0.9 * 0.8661 * Case::pipe_diameter * Case::pipe_diameter * length / smallest + 8;
      return most < Case::particle_count ? static_cast<int>(most) : Case::particle_count;
    }
    constexpr double d = smallest_diameter<Case>;
    constexpr double slab = Cells<Case>::length / d + 1, row = Cells<Case>::side / d + 1;
    constexpr double per_volume = 1.03 * 0.7405 / 0.5236;  // spheres of unit diameter
    constexpr double most = per_volume * (0.8661 * ratio * ratio + 2 * row * ratio) * slab + 8;
    return most < Case::particle_count ? static_cast<int>(most) : Case::particle_count;
  }();
  /// Chunks behind its own in which the partners of a chunk's particles lie.
  static constexpr int span =
      (chunk_size - 1 + in_reach) / chunk_size < chunks - 1 ? (chunk_size - 1 + in_reach) / chunk_size : chunks - 1;

  /// Contacts for each particle of any packing without overlap, each counted once. Equal spheres touch twelve others at
  /// most, and fewer beside a wall. Spheres of any sizes touch fewer than 14.93 on average (Kuperberg & Schramm 1994).
  static constexpr double contacts_per_particle = has_sizes<Case> ? 7.5 : 6;

  /// Pairs owned by the particles of one chunk, each pair counted once: half the neighbours of each. Observed: 2.3
  /// owned near pairs per particle on average in a bed. Overflow: the run stops.
  static constexpr int chunk_pairs = (chunk_size * neighbours / 2 + batch - 1) / batch * batch;
  /// Pairs across the periodic ends: a section of a close packing has 2.7 (D/d)^2 contacts.
  static constexpr int wrap_pairs = [] {
    constexpr double of_section = 6 * ratio * ratio, of_all = contacts_per_particle * Case::particle_count;
    return chunk_pairs + static_cast<int>(has_sizes<Case> && of_all < of_section ? of_all : of_section) / batch * batch;
  }();

  /// Pairs of the outer list, of a chunk and across the ends. Twelve neighbours of a close packing lie within its
  /// margin, so particles own six on average; a quarter of a pair more is for chunks that own more than their share,
  /// and three quarters more with the margin of long
  /// steps. Overflow: the margin of the list is reduced (outer_list.hpp).
  static constexpr int outer_pairs =
      (chunk_size * (neighbours > 14 ? 2 * neighbours + 4 : (steps_are_long<Case> ? 28 : 25)) / 4 + 2 * batch - 1) /
      batch * batch;
  static constexpr int outer_wrap_pairs = 2 * wrap_pairs;

  /// Contacts whose history is carried over while particles are sorted, 64 added for those that have just opened.
  /// Observed: 2.4 per particle in a settled bed. Overflow: the run stops.
  static constexpr int histories = static_cast<int>(contacts_per_particle * Case::particle_count) + 64;

  /// Chunks that a chunk's pairs reach into in a pipe that is a third full.
  static constexpr int usual_span = (chunk_size - 1 + in_reach / 3) / chunk_size;

  /// Steps that are computed together (tiles.hpp) where the state of the scene exceeds the caches, fewer where a step
  /// concerns more particles at a time; each has a ring of force rows. At most `order_interval` (near_list.hpp). A case
  /// can set it; results do not depend on it.
  static constexpr int tile_steps = [] {
    constexpr int concerned = (usual_span + 1) * chunk_size, most = concerned <= 512 ? 16 : (concerned <= 1024 ? 8 : 4);
    if constexpr (requires { Case::tile_steps; })
      return Case::tile_steps;
    else
      return Case::particle_count >= scene_beyond_caches && chunks >= chunks_for_tile(most) ? most : 1;
  }();
};

}  // namespace fixdem

// Impacts of turning spheres on larger or smaller ones, written once for the kernel and for the reference: Chung & Ooi
// (2011), test 8, and pairs with rolling resistance. Figures: see unequal_impacts.hpp.
#pragma once

#include "unequal_impacts.hpp"

namespace fixdem::tests {

/// Chung & Ooi, test 8: a sphere of aluminium alloy, R = 0.1 m, turning, at 0.2 m/s straight onto one of 0.5 m and a
/// thousand times the density, which all but stays: where friction slides throughout, v_x' = -0.12 and w' = w - 3.
struct on_heavy_spheres {
  static constexpr const char* name = "turning on heavy spheres";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"small", "big"};
  static constexpr SizeRun sizes[] = {{6, 0.2, 2700, 0}, {6, 1.0, 2.7e6, 1}};
};
template <FrictionLimit limit, Integrator scheme, int step_in_ns>
struct chung_ooi_8 : sized<on_heavy_spheres, free_space<5, limit, scheme, step_in_ns>> {
  static constexpr double friction = 0.4, youngs_modulus = 70e9, poisson_ratio = 0.33;
  static constexpr double wall_youngs_modulus = 70e9, wall_poisson_ratio = 0.33;
  static constexpr double pipe_diameter = 2, pipe_length = 18;
  static constexpr int slice_count = 18, neighbour_capacity = 130;
};

/// Spin before; velocities and spin of the small sphere after, spin of the big one.
struct TurningFigures {
  double spin, x, z, w, big_w;
};
inline std::vector<TurningFigures> chung_ooi_8_figures(FrictionLimit limit) {
  if (limit == FrictionLimit::total)
    return {{0.175, -0.0048972064, -0.0999975685, 0.0525882883, -1.958587e-07},
            {1, -0.0281990823, -0.0999965711, 0.2951268292, -1.127797e-06},
            {3, -0.0938859349, -0.0999919715, 0.6529981339, -3.755203e-06},
            {5, -0.1280483856, -0.0999887419, 1.7989357590, -5.121703e-06},
            {9, -0.1280483856, -0.0999887419, 5.7989357588, -5.121703e-06},
            {22, -0.1280483856, -0.0999887419, 18.7989357589, -5.121703e-06}};
  return {{0.175, -0.0045375924, -0.0999975716, 0.0615782862, -1.814747e-07},
          {1, -0.0266269493, -0.0999969261, 0.3343978731, -1.064963e-06},
          {3, -0.0961787685, -0.0999934331, 0.5956117249, -3.847021e-06},
          {5, -0.1200009869, -0.0999916477, 2.0000548291, -4.799912e-06},
          {9, -0.1200009869, -0.0999916477, 6.0000548291, -4.799912e-06},
          {22, -0.1200009869, -0.0999916477, 19.0000548291, -4.799912e-06}};
}

/// Bounds: m/s, at the surface for spins; the big sphere's spin is to the share of its own that this is of 0.12 m/s.
template <template <class> class Solver, class Case>
void check_chung_ooi_8(double bound, const Table& table = unrecorded) {
  static Solver<Case> solver;
  const std::vector<TurningFigures> figures = chung_ooi_8_figures(Case::friction_limit);
  std::vector<Meeting> meetings;
  for (int k = 0; k < 6; ++k) meetings.push_back({k, 6 + k, 0, 0.2, figures[k].spin, 0});
  const std::vector<Parting> found = partings<Case>(solver, meetings, 3, 2.5e-3);
  for (int k = 0; k < 6; ++k) {
    const std::string row = "spin " + in_words(figures[k].spin) + " rad/s";
    check_figure(table, row, {"tangential velocity", "m/s"}, figures[k].x, found[k].x_i, bound);
    check_figure(unrecorded, row, {"normal velocity", "m/s"}, figures[k].z, found[k].z_i, bound);
    check_figure(table, row, {"angular velocity", "rad/s"}, figures[k].w, found[k].w_i, bound / 0.1);
    check_figure(unrecorded, row, {"angular velocity of the large sphere", "rad/s"}, figures[k].big_w, found[k].w_j,
                 bound / 0.12 * 5.2e-6);
  }
}

/// Straight at 1 m/s, with spins w and -w r_i/r_j, so that nothing slips at first touch: 10 mm on 5 mm.
struct rolling_pairs {
  static constexpr const char* name = "unequal pairs, rolling";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"10 mm", "5 mm"};
  static constexpr SizeRun sizes[] = {{4, 0.010, 1000, 0}, {4, 0.005, 1000, 1}};
};
template <int tenths, Integrator scheme, int step_in_ns>
struct unequal_rolling : sized<rolling_pairs, free_space<tenths, FrictionLimit::elastic, scheme, step_in_ns>> {
  static constexpr double rolling_friction = 0.1;
  static constexpr double pipe_length = 0.14;
  static constexpr int slice_count = 14;
};

struct RollingFigures {
  double spin, w_i, w_j, work;  ///< work: J, taken by rolling resistance
};
inline std::vector<RollingFigures> rolling_figures(int tenths) {
  if (tenths == 9)
    return {{10, 3.94857840, 4.21826497, 1.057256467e-07},
            {50, 41.27556007, -70.70238322, 2.181298914e-06},
            {200, 191.27556007, -370.70238322, 1.047160141e-05},
            {800, 791.27556007, -1570.70238323, 4.363281140e-05}};
  return {{10, 4.31410511, 7.52226168, 1.132799789e-07},
          {50, 43.59739568, -69.10852312, 1.830790885e-06},
          {200, 193.59739568, -369.10852312, 8.375766387e-06},
          {800, 793.59739568, -1569.10852312, 3.455566840e-05}};
}

/// Bounds: m/s at the surface; of the work.
template <template <class> class Solver, int tenths, Integrator scheme, int step_in_ns>
void check_unequal_rolling(double velocity_bound, double work_bound, const Table& table = unrecorded) {
  using Case = unequal_rolling<tenths, scheme, step_in_ns>;
  static Solver<Case> solver;
  const std::vector<RollingFigures> figures = rolling_figures(tenths);
  std::vector<Meeting> meetings;
  for (int k = 0; k < 4; ++k) meetings.push_back({k, 4 + k, 0, 1, figures[k].spin, -2 * figures[k].spin});
  const std::vector<Parting> found = partings<Case>(solver, meetings, 0.03, 6e-5);
  WorstFigures worst(table, "10 mm on 5 mm, e = " + in_words(Case::restitution));
  for (int k = 0; k < 4; ++k) {
    const std::string spin = "spin " + in_words(figures[k].spin) + " rad/s";
    worst.check(spin, {"angular velocity of the large sphere", "rad/s"}, figures[k].w_i, found[k].w_i,
                velocity_bound / 0.005);
    worst.check(spin, {"angular velocity of the small sphere", "rad/s"}, figures[k].w_j, found[k].w_j,
                velocity_bound / 0.0025);
    worst.check(spin, {"work of rolling resistance", "J"}, figures[k].work, found[k].rolling_work,
                work_bound * figures[k].work);
  }
}

}  // namespace fixdem::tests

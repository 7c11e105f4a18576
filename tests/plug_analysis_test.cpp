// The plug measurement on profiles whose plug is known: edges, gaps, periodic ends, and a run of them.
#include "tools/run/plug_analysis.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace fixdem::program;

namespace {

/// A periodic pipe of 80 slices of 10 mm with a layer of 0.2 and a plug of 0.55 from `first` on.
SliceProfile plug_profile(int first, int length, double layer = 0.2) {
  SliceProfile profile;
  profile.slice_length = 0.01;
  profile.solids_fraction.assign(80, layer);
  profile.axial_momentum.assign(80, 0);
  profile.particles.assign(80, 10);
  profile.pressure_gradient.assign(80, 100);
  for (int k = first; k < first + length; ++k) {
    const auto slice = static_cast<std::size_t>(k % 80);
    profile.solids_fraction[slice] = 0.55;
    profile.axial_momentum[slice] = 30 * 0.6;
    profile.particles[slice] = 30;
    profile.pressure_gradient[slice] = 5000;
  }
  return profile;
}

}  // namespace

TEST_CASE("plug analysis: edges, length, velocity and layer of one profile") {
  // Smoothed over three, the step from 0.55 to 0.2 crosses 0.40 between the last slice of the plug (0.4333) and the one
  // after it (0.3167): 0.0333 / 0.11667 = 2/7 of a slice beyond its centre.
  for (int first : {20, 70}) {  // the second lies across the periodic ends
    const PlugSample sample = find_plug(plug_profile(first, 30), 0);
    REQUIRE(sample.found);
    CHECK(sample.front == doctest::Approx(std::fmod((first + 29 + 0.5 + 2.0 / 7) * 0.01, 0.8)));
    CHECK(sample.rear == doctest::Approx((first + 0.5 - 2.0 / 7) * 0.01));
    CHECK(sample.length == doctest::Approx(0.29 + 0.02 * 2 / 7));
    CHECK(sample.particle_velocity == doctest::Approx(0.6));
    CHECK(sample.layer_area_ratio == doctest::Approx(0.2 / 0.55));
    CHECK(sample.pressure_gradient == doctest::Approx(5000));
  }
  SUBCASE("blown towards -z, the front is the other edge") {
    SliceProfile profile = plug_profile(20, 30);
    profile.direction = -1;
    CHECK(find_plug(profile, 0).front == doctest::Approx((20 + 0.5 - 2.0 / 7) * 0.01));
  }
  SUBCASE("a gap of one slice is closed, a wider one parts the plug") {
    SliceProfile profile = plug_profile(20, 30);
    profile.solids_fraction[30] = 0;  // smoothed 0.367 in three slices
    // What is left begins between slice 31 (0.3667) and 32 (0.55): 0.15 / 0.18333 = 9/11 of a slice before its centre.
    CHECK(find_plug(profile, 0).length == doctest::Approx(((50 - 0.5 + 2.0 / 7) - (32.5 - 9.0 / 11)) * 0.01));
    profile = plug_profile(20, 30);
    profile.solids_fraction[29] = profile.solids_fraction[31] = 0.62;
    profile.solids_fraction[30] = 0;  // smoothed: 0.573 0.39 0.413 0.39 0.573 -> two single gaps
    CHECK(find_plug(profile, 0).length == doctest::Approx(0.29 + 0.02 * 2 / 7));
  }
  SUBCASE("no plug: a layer only, or a pipe full all round") {
    CHECK_FALSE(find_plug(plug_profile(0, 0), 0).found);
    CHECK_FALSE(find_plug(plug_profile(0, 80), 0).found);
  }
  SUBCASE("closed ends: the plug ends at the wall") {
    SliceProfile profile = plug_profile(60, 20);
    profile.is_periodic = false;
    const PlugSample sample = find_plug(profile, 0);
    CHECK(sample.front == doctest::Approx(0.8));
    CHECK(sample.rear == doctest::Approx((60 + 0.5 - 2.0 / 7) * 0.01));
  }
}

TEST_CASE("plug analysis: the front velocity of a run, through the periodic ends") {
  PlugRecord moving(0.8), dying(0.8);
  for (int k = 0; k <= 120; ++k) {
    const double time = 0.01 * k;
    moving.add(find_plug(plug_profile(k % 80, 30), time));  // one slice every 0.01 s: 1 m/s, through the end at 0.8 s
    dying.add(find_plug(plug_profile(k % 80, k <= 80 ? 30 : 0), time));
  }
  const PlugResult result = moving.result(1.2, 9.81, 0.05);
  CHECK(result.samples == 61);
  CHECK(result.samples_with_plug == 61);
  CHECK(result.front_velocity == doctest::Approx(1.0));
  CHECK(result.particle_velocity == doctest::Approx(0.6));
  CHECK(result.layer_area_ratio == doctest::Approx(0.2 / 0.55));
  CHECK(result.layer_area_ratio_eq41 == doctest::Approx(1 / (1 + 1.84 * 0.6 / std::sqrt(9.81 * 0.05))));
  const PlugResult none = dying.result(1.2, 9.81, 0.05);
  CHECK(none.samples_with_plug == 21);
  CHECK(std::isnan(none.front_velocity));
  CHECK(std::isnan(none.length));
  CHECK(std::isnan(none.layer_area_ratio_eq41));
}

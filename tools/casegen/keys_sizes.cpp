// The rows of the case format for particles that are not all equal: kinds of particles, and continuous distributions
// of their diameters. In the order in which the documentation prints them.
#include "schema.hpp"

namespace fixdem::casegen {
namespace {

// As those of equal spheres (keys_physics.cpp).
constexpr Range counts = between(0, 1e7), sizes = between(1e-6, 0.5), densities = between(10, 25000);

}  // namespace

std::span<const Rule<Species>> species_keys() {
  static const std::vector<Rule<Species>> all = {
      {{"particles.species", "name", "", false, When::always, "its number, from 0 on",
        "what it is called in tables and in `[[start.particle]]`", "letters, digits, _ and -: name = \"large\""},
       Name{&Species::name}},
      {{"particles.species", "count", "", true, When::always, "",
        "particles of this kind; in an open pipe at the start, 0 for none",
        "how many there are of this kind, for example count = 280"},
       Whole{&Species::count, counts}},
      {{"particles.species", "diameter", "m", true, When::always, "",
        "their diameter, of all species within a factor of ten", "in metres, for example diameter = 0.010"},
       Real{&Species::diameter, positive, sizes}},
      {{"particles.species", "density", "kg/m3", false, When::always, "[particles] density",
        "density of their material", "in kg/m3; [particles] density is for all that have none of their own"},
       Real{&Species::density, positive, densities}},
  };
  return all;
}

std::vector<Rule<CaseValues>> size_keys() {
  using Values = CaseValues;
  return {
      {{"particles.sizes", "distribution", "", true, When::always, "",
        "of the diameters, by number: particle k of `count` (at most 20000), before they are shuffled, is the quantile "
        "(k + 1/2)/count, to ten digits",
        "\"table\" is a sieve curve"},
       Choice{&Values::size_distribution, {"uniform", "normal", "lognormal", "table"}}},
      {{"particles.sizes", "minimum", "m", true, When::size_ends, "",
        "the smallest diameter: the distribution is cut there", "in metres: no particle is smaller"},
       Real{&Values::size_minimum, positive, sizes}},
      {{"particles.sizes", "maximum", "m", true, When::size_ends, "",
        "the largest diameter: the distribution is cut there", "in metres: no particle is larger"},
       Real{&Values::size_maximum, positive, sizes}},
      {{"particles.sizes", "mean", "m", true, When::size_normal, "", "mean before the cut",
        "in metres, between minimum and maximum"},
       Real{&Values::size_mean, positive, sizes}},
      {{"particles.sizes", "deviation", "m", true, When::size_normal, "", "standard deviation before the cut",
        "in metres, for example a tenth of the mean"},
       Real{&Values::size_deviation, positive}},
      {{"particles.sizes", "median", "m", true, When::size_lognormal, "", "median before the cut",
        "in metres, between minimum and maximum"},
       Real{&Values::size_median, positive, sizes}},
      {{"particles.sizes", "spread", "", true, When::size_lognormal, "",
        "standard deviation, before the cut, of the logarithm of the diameter",
        "a pure number: with 0.2 two thirds lie within about 20 % of the median"},
       Real{&Values::size_spread, positive, between(0, 2)}},
      {{"particles.sizes", "diameters", "m", true, When::size_table, "", "meshes of the sieves, ascending",
        "in metres, ascending, for example diameters = [0.004, 0.006, 0.010]"},
       Numbers{&Values::size_diameters, positive}},
      {{"particles.sizes", "below", "", true, When::size_table, "",
        "share that is smaller than each of them, from 0 to 1; linear in between",
        "as many numbers as diameters, from 0 to 1, for example below = [0.0, 0.7, 1.0]"},
       Numbers{&Values::size_below, between(0, 1)}},
      {{"particles.sizes", "weight", "", false, When::size_table, "",
        "what `below` counts: volume (so mass, as in sieving), or particles", "\"volume\" is a sieve curve by mass"},
       Choice{&Values::size_weight, {"volume", "number"}}},
      {{"particles.sizes", "seed", "", false, When::always, "", "number that the order of the diameters follows from",
        "any whole number from 0 on: with another one other particles are the large ones"},
       Whole{&Values::size_seed, not_negative}},
  };
}

}  // namespace fixdem::casegen

// The rows of the case format for a line, a pipe that is fed at one end and open at the other: its feed, and stations
// at which it is watched. In the order in which the documentation prints them.
#include "schema.hpp"

namespace fixdem::casegen {

std::vector<Rule<CaseValues>> feed_keys() {
  using Values = CaseValues;
  return {
      {{"feed", "rate", "kg/s", true, When::always, "", "mass fed per second; what finds no place waits",
        "in kg/s; a ramp from nothing to 0.2 in 5 s is [[0, 0], [5, 0.2]]"},
       InTime{&Values::feed_rate, not_negative, between(0, 1000)}},
      {{"feed", "start", "s", false, When::always, "", "when feeding begins", "in seconds"},
       Real{&Values::feed_start, not_negative}},
      {{"feed", "length", "m", false, When::always, "0.1 or 10 of the largest diameters, the greater, within the pipe",
        "length of the feed section, from z = 0 on", "in metres; a longer one takes more"},
       Real{&Values::feed_length, positive}},
      {{"feed", "velocity", "m/s", false, When::always, "", "velocity at which they fall in, across the axis",
        "in m/s; 0 is at rest"},
       Real{&Values::feed_velocity, not_negative, between(0, 1000)}},
      {{"feed", "mixture", "", false, When::always, "that of the start, by mass",
        "with species: share of the mass of each, in the order of the file; needed where none is there at the start",
        "as many numbers as species, which add up to 1, for example mixture = [0.7, 0.3]", true},
       Numbers{&Values::feed_mixture, between(0, 1)}},
      {{"feed", "seed", "", false, When::always, "", "number that places and kinds of what is fed follow from",
        "any whole number from 0 on: with another one they fall elsewhere"},
       Whole{&Values::feed_seed, not_negative}},
  };
}

std::span<const Rule<Probe>> probe_keys() {
  static const std::vector<Rule<Probe>> all = {
      {{"probe", "position", "m", true, When::always, "", "place along the pipe",
        "in metres from z = 0, for example position = 1.0"},
       Real{&Probe::position, not_negative}},
      {{"probe", "interval", "s", false, When::always, "[output] sample_interval", "time between its rows",
        "in seconds: leave it out for that of all samples"},
       Real{&Probe::interval, positive}},
  };
  return all;
}

}  // namespace fixdem::casegen

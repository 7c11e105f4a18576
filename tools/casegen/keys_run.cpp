// The rows of the case format that describe the run: start, time, capacity and output.
// One row per key, in the order in which the documentation prints them.
#include "schema.hpp"

namespace fixdem::casegen {

std::vector<Rule<CaseValues>> run_keys() {
  using Values = CaseValues;
  constexpr Range speeds = between(0, 1000);
  return {
      {{"start", "arrangement", "", false, When::always, "", "particles placed at random without overlap",
        "the only arrangement is \"random\""},
       Choice{&Values::arrangement, {"random"}}},
      {{"start", "seed", "", false, When::random, "", "number that the random arrangement follows from",
        "any whole number from 0 on: another number is another arrangement"},
       Whole{&Values::seed, not_negative}},
      {{"start", "velocity", "m/s", false, When::random, "",
        "each velocity component is uniform between minus and plus this",
        "in m/s: Table 1 of the paper has velocity = 0.5; 0 is at rest"},
       Real{&Values::start_velocity, not_negative, speeds}},
      {{"start", "from", "", false, When::always, "",
        "case whose final state this one starts from: its name, if in the same folder, or its path from here",
        "the name of a case in the same folder, as \"fill_1000\", or a path from there, as \"../other/fill.toml\""},
       Text{&Values::start_from}},
      {{"start", "motion", "", false, When::from, "",
        "stop: all velocities and contact histories are zero at the start; keep: they are carried over",
        "\"stop\" starts at rest, \"keep\" carries on"},
       Choice{&Values::start_motion, {"stop", "keep"}}},

      {{"run", "time_step", "s", true, When::always, "", "time step",
        "in seconds: the paper's scenes run at 2.0e-6; casegen prints how that compares with the contact time"},
       Real{&Values::time_step, positive, between(1e-12, 0.01)}},
      {{"run", "duration", "s", true, When::always, "", "time to simulate",
        "in seconds: the paper's plugs run for 1.2"},
       Real{&Values::duration, positive, between(1e-9, 1e6)}},
      {{"run", "integrator", "", false, When::always, "",
        "semi-implicit Euler (the paper's); leapfrog; or leapfrog with impulses of contacts integrated along the step",
        "\"euler\" is the paper's; \"impulse\" with slider = \"exact\" is far more accurate at some more time per "
        "step"},
       Choice{&Values::integrator, {"euler", "leapfrog", "impulse"}}},
      {{"run", "precision", "", false, When::always, "",
        "double everywhere; mixed: contact forces and histories in single precision, all else in double",
        "\"double\", or \"mixed\": faster, and as exact as kernel/README.md says"},
       Choice{&Values::precision, {"double", "mixed"}}},
      {{"run", "gravity", "m/s2", false, When::always, "", "acceleration of gravity; y is up, z along the pipe",
        "three numbers in m/s2, for example gravity = [0, -9.81, 0]"},
       Vector{&Values::gravity, between(-1000, 1000)}},
      {{"run", "reference_speed", "m/s", false, When::always,
        "largest of start velocities, gas velocity and sqrt(2 g D)",
        "impact speed that the advice on the time step is given for",
        "in m/s: the maximum impact speed to be expected"},
       Real{&Values::reference_speed, positive, speeds}},
      {{"run", "max_overlap", "radii", false, When::always, "", "a greater overlap stops the run",
        "a fraction of the radius: the default is 0.5"},
       Real{&Values::max_overlap, Range{0, 1, false, false}}},
      {{"run", "overlap_warning", "radii", false, When::always, "",
        "a greater overlap at a row of the log is warned of, once: Hertz' law holds for small ones",
        "a fraction of the radius: the default is 0.1; inf never warns"},
       Real{&Values::overlap_warning, positive, any, true}},
      {{"run", "stability_limit", "stable steps", false, When::always, "",
        "a time step beyond one stable step of the present contacts is warned of, once; beyond this many the run stops",
        "the default is 1.5: on a bed a step beyond that is unstable; inf never stops"},
       Real{&Values::stability_limit, positive, any, true}},

      {{"capacity", "neighbours", "", false, When::always,
        "14; with the largest diameter q times the smallest the lesser of 160 and ceil(1.8/(1 - c)) + 1, "
        "c = sqrt(1 - 1/(1 + q)^2)",
        "room for near pairs of one particle, at most 30 of equal spheres; the run stops when it is not enough",
        "twelve equal spheres can touch one; the default is 14, or what the sizes need"},
       Whole{&Values::neighbour_capacity, between(2, 160)}},
      {{"capacity", "tile_steps", "steps", false, When::always, "chosen by the kernel",
        "steps done together while a piece of a long pipe is in the cache; results do not depend on it",
        "leave it out, and the kernel chooses; 1 is plain steps, more need a pipe of many chunks"},
       Whole{&Values::tile_steps, between(1, 16)}},
      {{"capacity", "memory", "bytes", false, When::always, "no budget",
        "what the whole simulation may take; more does not compile, and the message says what takes the space",
        "for example memory = \"256 KiB\"; units: B, KiB, MiB"},
       Memory{&Values::memory_budget}},

      {{"output", "log_interval", "s", false, When::always, "duration / 50", "time between rows of the log",
        "in seconds: leave it out for 50 rows"},
       Real{&Values::log_interval, positive}},
      {{"output", "frame_interval", "s", false, When::always, "",
        "time between frames for ParaView or OVITO; 0: no frames", "in seconds; 0 writes no frames"},
       Real{&Values::frame_interval, not_negative}},
      {{"output", "frame_data", "", false, When::always, "",
        "binary: small, for ParaView; text: numbers within the XML, for OVITO, which refuses appended binary data",
        "\"binary\", or \"text\" for frames that OVITO opens"},
       Choice{&Values::frame_data, {"binary", "text"}}},
      {{"output", "dump", "", false, When::always, "", "also write the frames as a LAMMPS text dump",
        "true or false, without quotes"},
       Flag{&Values::dump}},
      {{"output", "sample_interval", "s", false, When::always, "", "time between measurements of the plug",
        "in seconds: the default is 0.01"},
       Real{&Values::sample_interval, positive}},
      {{"output", "checkpoint_interval", "s", false, When::always, "one minute by the clock",
        "simulated time between checkpoints, from which `--resume` goes on; inf: only when a signal stops the run",
        "in seconds of simulated time: leave it out for a checkpoint every minute that the run takes"},
       Real{&Values::checkpoint_interval, positive, any, true}},
      {{"output", "energy_ledger", "", false, When::always, "", "account for every joule dissipated and put in",
        "true or false, without quotes"},
       Flag{&Values::energy_ledger}},
  };
}

std::span<const Rule<PlacedParticle>> placed_keys() {
  using Placed = PlacedParticle;
  static const std::vector<Rule<Placed>> all = {
      {{"start.particle", "position", "m", true, When::always, "", "centre of the particle",
        "x, y, z in metres; z runs along the pipe from 0 to [pipe] length, x = y = 0 is its axis"},
       Vector{&Placed::position}},
      {{"start.particle", "velocity", "m/s", false, When::always, "", "velocity",
        "three numbers in m/s; leave it out for a particle at rest"},
       Vector{&Placed::velocity, between(-1000, 1000)}},
      {{"start.particle", "angular_velocity", "rad/s", false, When::always, "", "angular velocity; needs friction",
        "three numbers in rad/s; leave it out for none"},
       Vector{&Placed::angular_velocity}},
      {{"start.particle", "species", "", false, When::always, "required with species",
        "number or name of its species; only with `[[particles.species]]`",
        "the first [[particles.species]] of the file is 0, or give the name of one", true},
       NameOrNumber{&Placed::species}},
  };
  return all;
}

}  // namespace fixdem::casegen

// The bad cases of casegen_test.cpp: one good case, and what is wrong after one change to it.
//
// An error must point at the first place of the text `at`, and say all of `words`: the key, its value, what is allowed
// and what to do.
#pragma once

#include <string>
#include <vector>

namespace casegen_test {

inline const std::string good_case = R"(title = "A good case"
[particles]
count = 2
diameter = 0.010
density = 1000.0
[material]
youngs_modulus = 3.0e9
poisson_ratio = 0.33
restitution = 0.9
friction = 0.3
[contact]
normal = "hertz"
slider = "exact"
[pipe]
diameter = 0.050
length = 0.800
ends = "periodic"
wall = true
[gas]
bulk_velocity = 2.4
density = 1.2
kinematic_viscosity = 1.5e-5
slice_length = 0.010
[start]
arrangement = "random"
seed = 3
[run]
time_step = 2.0e-6
duration = 1.2
integrator = "impulse"
[capacity]
neighbours = 14
[output]
log_interval = 0.1
)";

struct BadCase {
  const char* piece;  // of the good case, ...
  const char* by;     // ... replaced by this
  const char* at;     // the error points at the first place of this text
  std::vector<const char*> words;
};

constexpr const char* random_start = "arrangement = \"random\"\nseed = 3";

inline const std::vector<BadCase> bad_cases = {
    // names
    {"restitution = 0.9",
     "restituton = 0.9",
     "restituton",
     {"unknown key 'restituton' in [material]", "did you mean 'restitution'?", "allowed: youngs_modulus"}},
    {"friction = 0.3",
     "friction = 0.3\nslider = \"clip\"",
     "slider",
     {"unknown key 'slider' in [material]", "belongs in [contact]"}},
    {"[capacity]", "[capacty]", "capacty", {"'capacty'", "did you mean 'capacity'?", "allowed: title, particles"}},
    {"density = 1000.0\n", "", "[particles]", {"missing key 'density' in [particles]", "kg/m3"}},
    {"[run]\ntime_step = 2.0e-6\nduration = 1.2\nintegrator = \"impulse\"\n",
     "",
     "title",
     {"missing table [run]", "time_step, duration"}},
    // types
    {"count = 2", "count = 2.5", "2.5", {"count = 2.5 in [particles]", "must be a whole number", "allowed: 0 to"}},
    {"diameter = 0.010",
     "diameter = \"10 mm\"",
     "\"10 mm\"",
     {"diameter = \"10 mm\" in [particles]", "is a text", "above 0", "in metres"}},
    {"wall = true", "wall = \"no\"", "\"no\"", {"wall = \"no\" in [pipe]", "true, false"}},
    {"duration = 1.2",
     "duration = 1.2\ngravity = [0, -9.81]",
     "[0, -9.81]",
     {"gravity = [0, -9.81] in [run]", "has 2 entries", "[x, y, z]"}},
    {"duration = 1.2", "duration = 1.2\ngravity = [0, inf, 0]", "[0, inf", {"gravity", "must be finite"}},
    // ranges
    {"count = 2",
     "count = 0",
     "0\ndiameter",
     {"[particles] count = 0; allowed: 1 to 10000000, and 0 with", "an open pipe is fed"}},
    {"diameter = 0.010", "diameter = -0.010", "-0.010", {"diameter = -0.01", "out of range", "above 0"}},
    {"density = 1000.0", "density = nan", "nan", {"density = nan", "not a number", "above 0"}},
    {"poisson_ratio = 0.33", "poisson_ratio = 0.51", "0.51", {"poisson_ratio = 0.51", "0 to 0.5"}},
    {"restitution = 0.9",
     "restitution = 0",
     "0\nfriction",
     {"restitution = 0", "above 0 and at most 1", "infinite damping"}},
    {"restitution = 0.9", "restitution = 1.01", "1.01", {"restitution = 1.01", "above 0 and at most 1"}},
    {"friction = 0.3", "friction = -0.3", "-0.3", {"friction = -0.3", "at least 0"}},
    {"length = 0.800", "length = inf", "inf", {"length = inf in [pipe] must be finite", "above 0"}},
    {"neighbours = 14", "neighbours = 31", "31", {"[capacity] neighbours = 31", "2 to 30", "twelve"}},
    {"neighbours = 14", "neighbours = 161", "161", {"neighbours = 161 in [capacity]", "2 to 160"}},
    {"neighbours = 14", "memory = \"256 kb\"", "\"256 kb\"", {"memory = \"256 kb\" in [capacity]", "unit", "KiB"}},
    {"neighbours = 14", "memory = \"0 KiB\"", "\"0 KiB\"", {"memory = \"0 KiB\" in [capacity] is out of range"}},
    {"neighbours = 14", "memory = \"all\"", "\"all\"", {"does not begin with a whole number", "256 KiB"}},
    {"neighbours = 14", "tile_steps = 17", "17", {"tile_steps = 17 in [capacity]", "1 to 16", "kernel chooses"}},
    {"neighbours = 14",
     "tile_steps = 2",
     "2\n[output]",
     {"[capacity] tile_steps = 2", "needs 8 chunks", "2 particles fill 1; allowed: 1\n", "leave tile_steps out"}},
    {"duration = 1.2",
     "duration = 1.2\nmax_overlap = 1.0",
     "1.0\nintegrator",
     {"max_overlap = 1 in [run]", "above 0 and below 1"}},
    {"duration = 1.2",
     "duration = 1.2\nstability_limit = 0",
     "0\nintegrator",
     {"stability_limit = 0 in [run]", "above 0, or inf"}},
    {"seed = 3", "seed = -3", "-3", {"seed = -3 in [start]", "at least 0"}},
    // words
    {"ends = \"periodic\"",
     "ends = \"periodc\"",
     "\"periodc\"",
     {"ends = \"periodc\" in [pipe]", "did you mean \"periodic\"?", "\"periodic\", \"closed\""}},
    {"duration = 1.2",
     "duration = 1.2\nprecision = \"single\"",
     "\"single\"",
     {"precision = \"single\" in [run] is unknown", "\"double\", \"mixed\"", "kernel/README.md"}},
    {"normal = \"hertz\"",
     "normal = \"hooke\"",
     "\"hooke\"",
     {"normal = \"hooke\" in [contact] is unknown", "\"hertz\", \"linear\""}},
    // keys that need or exclude one another
    {"slider = \"exact\"",
     "normal_stiffness = 1e4",
     "normal_stiffness",
     {"[contact] normal_stiffness = 10000", "not used here", "normal = \"linear\""}},
    {"normal = \"hertz\"",
     "normal = \"linear\"",
     "youngs_modulus",
     {"[material] youngs_modulus = 3000000000", "not used here", "normal = \"hertz\""}},
    {"normal = \"hertz\"",
     "normal = \"linear\"",
     "[contact]",
     {"missing key 'tangential_stiffness' in [contact]", "N/m"}},
    {"slider = \"exact\"",
     "damping = \"critical\"",
     "\"critical\"",
     {"damping = \"critical\"", "allowed: \"restitution\""}},
    {"slider = \"exact\"",
     "slider = \"paper\"",
     "\"paper\"",
     {"slider = \"paper\" with integrator = \"impulse\"", "allowed: \"exact\", \"clip\""}},
    {"wall = true", "wall = false", "false", {"[pipe] wall = false", "allowed: true", "remove [gas]"}},
    {"duration = 1.2", "duration = 1e-6", "1e-6", {"[run] duration", "shorter than one step", "at least time_step"}},
    {"log_interval = 0.1", "log_interval = 1e-7", "1e-7", {"[output] log_interval", "at least time_step"}},
    {"log_interval = 0.1",
     "checkpoint_interval = 1e-7",
     "1e-7",
     {"[output] checkpoint_interval", "at least time_step"}},
    {"log_interval = 0.1",
     "checkpoint_interval = -7",
     "-7",
     {"checkpoint_interval = -7 in [output]", "above 0, or inf"}},
    {"seed = 3", "from = \"other\"", "[start]", {"together with", "exactly one way"}},
    {random_start, "", "[start]", {"where the particles come from", "keep one of"}},
    {random_start, "from = \"nowhere\"", "\"nowhere\"", {"[start] from = \"nowhere\"", "no file", "same folder"}},
    {random_start, "from = \"a b\"", "\"a b\"", {"[start] from = \"a b\"", "letters, digits"}},
    {random_start, "from = \"mine\"", "\"mine\"", {"circle: mine -> mine"}},
    {random_start, "from = \"filling\"", "\"filling\"", {"has 7 particles", "as many as here, 2"}},
    {random_start, "from = \"fillin\"", "\"fillin\"", {"did you mean \"filling\"?"}},
    // geometry
    {"diameter = 0.050",
     "diameter = 0.009",
     "0.010",
     {"[particles] diameter = 0.01 is wider than the pipe", "below [pipe] diameter = 0.009"}},
    {"length = 0.800",
     "length = 0.039",
     "0.039",
     {"[pipe] length = 0.039 is too short", "at least 4 particle diameters = 0.04"}},
    {"count = 2", "count = 1801", "1801", {"[particles] count = 1801", "at most 0.60, that is 1800 particles"}},
    {"count = 2", "count = 1351", "\"random\"", {"count = 1351", "at most 0.45, that is 1350 particles", "from ="}},
    {"slice_length = 0.010",
     "slice_length = 0.0099",
     "0.0099",
     {"[gas] slice_length = 0.0099", "from one particle diameter = 0.01"}},
    {"slice_length = 0.010", "slice_length = 0.21", "0.21", {"[gas] slice_length = 0.21", "quarter of the pipe = 0.2"}},
};

}  // namespace casegen_test

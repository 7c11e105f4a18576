// The rows of the case format that describe the scene: particles, material, contact law, pipe and gas.
// One row per key, in the order in which the documentation prints them.
#include "schema.hpp"

namespace fixdem::casegen {

std::vector<Rule<CaseValues>> physics_keys() {
  using Values = CaseValues;
  // Ten million particles need some ten gigabytes, and twice that while they run: a larger count is a slip of the
  // keyboard.
  constexpr Range particle_counts = between(1, 1e7);
  // Intervals are counted in `int` steps.
  constexpr Range step_intervals = between(1, 1e6);
  // Plausible: from dust to boulders, from foam to osmium, from the softest model material to diamond.
  constexpr Range sizes = between(1e-6, 0.5), densities = between(10, 25000), moduli = between(1e5, 2e12);

  return {
      {{"", "title", "", false, When::always, "the file's name", "one line that says what the case shows",
        "write a text in double quotes"},
       Text{&Values::title}},

      {{"particles", "count", "", true, When::no_species, "without species", "number of particles",
        "Table 2 of the paper has count = 1000"},
       Whole{&Values::count, particle_counts}},
      {{"particles", "diameter", "m", true, When::one_size, "without species and sizes", "diameter of equal spheres",
        "in metres: Table 2 of the paper has diameter = 0.010"},
       Real{&Values::diameter, positive, sizes}},
      {{"particles", "density", "kg/m3", true, When::species_default, "where species have none of their own",
        "density of the particles' material", "in kg/m3: Table 2 of the paper has density = 1000.0"},
       Real{&Values::density, positive, densities}},

      {{"material", "youngs_modulus", "Pa", true, When::hertz, "", "Young's modulus of the particles",
        "in pascal: Table 2 of the paper has youngs_modulus = 3.0e9; a lower one allows a greater time step"},
       Real{&Values::youngs_modulus, positive, moduli}},
      {{"material", "poisson_ratio", "", true, When::hertz, "", "Poisson's ratio of the particles",
        "Table 2 of the paper has poisson_ratio = 0.33"},
       Real{&Values::poisson_ratio, between(0, 0.5)}},
      {{"material", "restitution", "", true, When::always, "", "rebound speed over impact speed of collisions",
        "1 is elastic; Table 2 of the paper has restitution = 0.9; 0 (no rebound) needs infinite damping"},
       Real{&Values::restitution, Range{0, 1, false, true}}},
      {{"material", "friction", "", true, When::always, "",
        "Coulomb's coefficient; where it is 0 at walls, too, friction and rotation are left out altogether",
        "Table 2 of the paper has friction = 0.3; 0 is frictionless"},
       Real{&Values::friction, not_negative, between(0, 5)}},
      {{"material", "wall_youngs_modulus", "Pa", false, When::hertz, "the particles' own",
        "Young's modulus of pipe and ends; `inf` is a rigid wall",
        "in pascal; inf is a rigid wall; leave it out for a wall of the particles' material"},
       Real{&Values::wall_youngs_modulus, positive, moduli, true}},
      {{"material", "wall_poisson_ratio", "", false, When::hertz, "the particles' own",
        "Poisson's ratio of pipe and ends", "leave it out for a wall of the particles' material"},
       Real{&Values::wall_poisson_ratio, between(0, 0.5)}},
      {{"material", "wall_friction", "", false, When::always, "the particles' own",
        "Coulomb's coefficient at pipe and ends",
        "leave it out for the particles' own friction; 0 is a wall that turns nothing", true},
       Real{&Values::wall_friction, not_negative, between(0, 5)}},
      {{"material", "wall_restitution", "", false, When::always, "the particles' own",
        "rebound speed over impact speed at pipe and ends",
        "leave it out for the particles' own restitution; 1 is elastic", true},
       Real{&Values::wall_restitution, Range{0, 1, false, true}}},
      {{"material", "rolling_friction", "", false, When::always, "",
        "tangent of the slope on which a sphere just does not roll; 0 leaves rolling resistance out",
        "0 is a sphere that rolls freely; a value below friction stands for grains that are not quite round", true},
       Real{&Values::rolling_friction, not_negative, between(0, 1)}},
      {{"material", "wall_rolling_friction", "", false, When::always,
        "`rolling_friction`, or 0 where `wall_friction` is 0", "the same at pipe and ends",
        "leave it out for the particles' own rolling_friction; 0 is a wall on which they roll freely", true},
       Real{&Values::wall_rolling_friction, not_negative, between(0, 1)}},

      {{"contact", "normal", "", false, When::always, "", "normal force: Hertz, or a linear spring of given stiffness",
        "\"hertz\" is the paper's; \"linear\" needs normal_stiffness and tangential_stiffness"},
       Choice{&Values::normal, {"hertz", "linear"}}},
      {{"contact", "tangential", "", false, When::always, "",
        "what the tangential spring remembers: its displacement, its force, or its force rescaled while unloading",
        "\"displacement\" is the paper's; \"rescale\" never creates energy"},
       Choice{&Values::tangential, {"displacement", "force", "rescale"}}},
      {{"contact", "slider", "", false, When::always, "",
        "Coulomb's limit: spring capped first, then the total; the same with the turning of a sliding spring solved "
        "exactly; or the paper's eqs. (10)-(12) to the letter",
        "\"clip\" converges with the time step, \"exact\" (with integrator = \"impulse\") faster; \"paper\" is the "
        "letter "
        "of eqs. (10)-(12)"},
       Choice{&Values::slider, {"clip", "exact", "paper"}}},
      {{"contact", "friction_limit", "", false, When::always, "",
        "limit of friction: mu times the whole normal force (eq. 9), or times its elastic part, which makes gross "
        "sliding "
        "Coulomb's exactly",
        "\"total\" is the paper's; \"elastic\" takes mu (1 + e) M v of an impact that slides throughout", true},
       Choice{&Values::friction_limit, {"total", "elastic"}}},
      {{"contact", "damping_mass", "", false, When::always, "",
        "mass in eq. (26) between particles: the reduced mass gives the restitution asked for, the particle's is as "
        "printed",
        "\"reduced\" gives the restitution asked for"},
       Choice{&Values::damping_mass, {"reduced", "particle"}}},
      {{"contact", "damping", "", false, When::always, "",
        "damping that returns the restitution, or critical (eq. 23; linear law only)",
        "\"critical\" belongs to normal = \"linear\""},
       Choice{&Values::damping, {"restitution", "critical"}}},
      {{"contact", "normal_stiffness", "N/m", true, When::linear, "", "spring constant of the linear law",
        "in N/m, for example 1.0e4: the greater, the smaller the time step must be"},
       Real{&Values::normal_stiffness, positive, between(1, 1e10)}},
      {{"contact", "tangential_stiffness", "N/m", true, When::linear, "",
        "tangential spring constant of the linear law", "in N/m; between 2/7 and 1 of normal_stiffness is usual"},
       Real{&Values::tangential_stiffness, positive, between(1, 1e10)}},

      {{"pipe", "diameter", "m", true, When::always, "", "inner diameter of the pipe",
        "in metres: Table 2 of the paper has a pipe of diameter = 0.050"},
       Real{&Values::pipe_diameter, positive, between(1e-5, 20)}},
      {{"pipe", "length", "m", true, When::always, "", "length along z, from 0 to length",
        "in metres: Table 2 of the paper has length = 0.800"},
       Real{&Values::pipe_length, positive, between(1e-5, 1000)}},
      {{"pipe", "ends", "", true, When::always, "",
        "periodic: what leaves one end enters the other; closed: flat walls",
        "\"periodic\" for flow along the pipe, \"closed\" for a vessel"},
       Choice{&Values::ends, {"periodic", "closed"}}},
      {{"pipe", "wall", "", false, When::always, "", "false: no pipe wall, particles may leave sideways",
        "true or false, without quotes"},
       Flag{&Values::wall}},

      {{"gas", "bulk_velocity", "m/s", true, When::always, "", "superficial velocity U along +z",
        "in m/s, of the empty pipe: Table 2 of the paper has 2.4 and 1.7"},
       Real{&Values::gas_velocity, any, between(-340, 340)}},
      {{"gas", "density", "kg/m3", true, When::always, "", "density of the gas", "in kg/m3: air has density = 1.2"},
       Real{&Values::gas_density, positive, between(0.01, 1000)}},
      {{"gas", "kinematic_viscosity", "m2/s", true, When::always, "", "kinematic viscosity of the gas",
        "in m2/s: air has kinematic_viscosity = 1.5e-5"},
       Real{&Values::gas_viscosity, positive, between(1e-8, 0.01)}},
      {{"gas", "bed_diameter", "m", false, When::always,
        "[particles] diameter; of several sizes the Sauter diameter of each slice",
        "diameter in the Ergun equation, eqs. (33) and (35)",
        "in metres: the paper's modification has bed_diameter = 0.003"},
       Real{&Values::gas_bed_diameter, positive, sizes}},
      {{"gas", "update_interval", "steps", false, When::always, "", "steps from one solution of the gas to the next",
        "a number of steps: 1 is every step, 5 changes no result of the plugs"},
       Whole{&Values::gas_update_interval, step_intervals}},
      {{"gas", "floater_interval", "steps", false, When::always, "",
        "steps from one search for floating particles to the next", "a number of steps: the default is 25"},
       Whole{&Values::gas_floater_interval, step_intervals}},
      {{"gas", "bed_height", "", false, When::always, "",
        "when a slice counts as full of particles: gradually, at once, or only when it is",
        "\"continuous\" and \"hard\" carry plugs; with \"strict\" the gas leaks over every plug"},
       Choice{&Values::gas_bed_height, {"continuous", "hard", "strict"}}},
      {{"gas", "slice_length", "m", false, When::always, "the largest diameter",
        "length of a slice of the gas, from one particle diameter, the largest, to a quarter of the pipe; the nearest "
        "whole number of equal slices is used",
        "from one particle diameter to a quarter of the pipe; leave it out for one diameter"},
       Real{&Values::gas_slice_length, positive}},
  };
}

}  // namespace fixdem::casegen

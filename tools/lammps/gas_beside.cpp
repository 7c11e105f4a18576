// LAMMPS with the gas of the kernel beside it, on any number of MPI ranks.
//
// Usage, in the folder that `make export-lammps` wrote:  mpirun -np 2 gas_beside [-var steps 1000] [options of LAMMPS]
// Compiled for a case as its program is (-DFIXDEM_CASE, -DFIXDEM_CASE_HEADER), and for so many copies of it along the
// pipe as FIXDEM_REPEAT says (1 without it). It reads scene.in, hangs itself into `fix gas` and reads steps.in. LAMMPS
// then calls it whenever slices or floaters are due, counted in steps as in the kernel: from the present places and
// velocities it finds who floats (floating_atoms.hpp), solves the slices (slices_over_ranks.hpp) and leaves a force for
// every atom, which LAMMPS adds in each step until the next call. Who floats is kept in LAMMPS' group `floating`, so it
// goes with the atom to another rank. Velocities are those LAMMPS has then, half a step behind the places.
//
// Writes plug.json, the entry `plug` of summary.json by the program's own analysis (tools/run/plug_analysis.hpp), and
// slices.csv, the slices at the last update. Exit codes: 3 the folder is not of this case, 5 the flow in a slice could
// not be solved, 6 a file could not be written; what LAMMPS finds wrong ends with LAMMPS' own message and code 1.
#include <fmt/format.h>
#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>
#define LAMMPS_LIB_MPI
#include <lammps/library.h>

#include FIXDEM_CASE_HEADER
#include "floating_atoms.hpp"
#include "slices_over_ranks.hpp"
#include "tools/run/case_facts.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/output_file.hpp"
#include "tools/run/plug_analysis.hpp"
#include "tools/run/schedule.hpp"
#include "tools/run/summary.hpp"

#ifndef FIXDEM_REPEAT
#define FIXDEM_REPEAT 1
#endif

namespace {

using namespace fixdem;
using program::Failure;

struct Case : cases::FIXDEM_CASE {
  using Original = cases::FIXDEM_CASE;
  static constexpr int particle_count = Original::particle_count * FIXDEM_REPEAT;
  static constexpr double pipe_length = Original::pipe_length * FIXDEM_REPEAT;
  static constexpr int slice_count = Original::slice_count * FIXDEM_REPEAT;
};
static_assert(Case::has_gas, "LAMMPS alone runs a case without gas");
static_assert(!has_sizes<Case>, "particles of several sizes have no gas beside LAMMPS: export refuses them");
static_assert(
    !is_compressible<Case> && !has_velocity_in_time<Case> && !Derived<Case>::is_steep,
    "gas that is compressible, changes in time or flows through a steep pipe has no counterpart beside LAMMPS: "
    "export refuses it");

class GasBeside {
 public:
  GasBeside(void* lammps, MPI_Comm ranks) : lammps_(lammps), slices_(ranks), ranks_(ranks) {
    MPI_Comm_rank(ranks, &rank_);
    floating_ = group_bit("floating");
  }

  /// What LAMMPS calls; `self` is this object.
  static void call(void* self, std::int64_t step, int owned, int*, double** x, double** force) noexcept {
    auto& gas = *static_cast<GasBeside*>(self);
    try {
      gas.update(step, owned, x, force);
    } catch (const Failure& failure) {  // other ranks may wait for this one: nothing but an end to all of them helps
      std::fprintf(stderr, "gas_beside: %s\n", failure.what());
      MPI_Abort(gas.ranks_, failure.code());
    }
  }

  void write_results(double duration) {
    slices_.solve(true);
    if (rank_ != 0) return;
    const double gravity = std::hypot(Case::gravity[0], Case::gravity[1], Case::gravity[2]);
    const program::PlugResult plug = record_.result(duration, gravity, Case::pipe_diameter);
    program::write_file("plug.json", program::encode_plug(plug), program::Durability::fast);
    program::write_file("slices.csv", slice_table(), program::Durability::fast);
  }

 private:
  /// The bit of a group in the mask of an atom.
  int group_bit(const char* wanted) const {
    char name[64];
    for (int k = 0; k < lammps_id_count(lammps_, "group"); ++k)
      if (lammps_id_name(lammps_, "group", k, name, sizeof name) != 0 && std::strcmp(name, wanted) == 0) return 1 << k;
    throw Failure(program::exit_bad_input,
                  fmt::format("scene.in defines no group '{}': write it with make export-lammps", wanted));
  }

  void update(std::int64_t step, int owned, const double* const* x, double** force) {
    const auto* const* v = static_cast<double**>(lammps_extract_atom(lammps_, "v"));
    int* mask = static_cast<int*>(lammps_extract_atom(lammps_, "mask"));
    if (step % Case::gas_floater_interval == 0) {
      const int all = owned + lammps_extract_setting(lammps_, "nghost");
      floating_atoms_.find(x, owned, all,
                           [&](int i, bool floats) { mask[i] = floats ? mask[i] | floating_ : mask[i] & ~floating_; });
    }
    if (step % Case::gas_update_interval != 0) return;
    slices_.clear();
    slice_of_.clear();
    for (int i = 0; i < owned; ++i) slice_of_.push_back(slices_.add(x[i], v[i], (mask[i] & floating_) != 0));
    slices_.sum();
    const bool is_sampled = samples_.is_due(step);
    if (const double residual = slices_.solve(is_sampled && rank_ == 0); !(residual < maximum_residual))
      throw Failure(program::exit_unstable,
                    fmt::format("step {}: the gas flow in a slice is not solved: residual {:.3g}, allowed {:.3g}", step,
                                residual, maximum_residual));
    for (int i = 0; i < owned; ++i)
      slices_.force_on(slice_of_[static_cast<std::size_t>(i)], v[i], (mask[i] & floating_) != 0, force[i]);
    if (is_sampled) sample(step, owned, x, v);
  }

  /// Where the plug is, by all particles of all ranks.
  void sample(std::int64_t step, int owned, const double* const* x, const double* const* v) {
    program::SliceProfile profile = program::empty_profile(facts_, slices_.pressure_gradients());
    for (int i = 0; i < owned; ++i) {
      const double turns = profile.is_periodic ? std::floor(x[i][2] / Case::pipe_length) : 0;
      program::count_particle(profile, x[i][2] - turns * Case::pipe_length, v[i][2]);
    }
    add_up(profile.particles.data(), MPI_DOUBLE);
    add_up(profile.axial_momentum.data(), MPI_DOUBLE);
    samples_.advance(step);
    if (rank_ != 0) return;
    program::set_solids_fractions(profile, facts_);
    record_.add(program::find_plug(profile, static_cast<double>(step) * Case::time_step));
  }
  /// One value per slice of every rank, added up on rank 0.
  void add_up(void* values, MPI_Datatype type) const {
    MPI_Reduce(rank_ == 0 ? MPI_IN_PLACE : values, values, Case::slice_count, type, MPI_SUM, 0, ranks_);
  }

  std::string slice_table() const {
    const SliceArrays<Case>& s = slices_.slices();
    std::string text =
        "slice,particles,axial_velocity_sum,height,bed_area,void_fraction,pressure_gradient,velocity_in_bed,velocity_"
        "above\n";
    for (int k = 0; k < Case::slice_count; ++k)
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", k, s.particles[k], s.axial_velocity_sum[k], s.height[k],
                          s.bed_area[k], s.void_fraction[k], s.pressure_gradient[k], s.velocity_in_bed[k],
                          s.velocity_above[k]);
    return text;
  }

  void* lammps_;
  beside::FloatingAtoms<Case> floating_atoms_;
  beside::SlicesOverRanks<Case> slices_;
  MPI_Comm ranks_;
  int rank_ = 0, floating_ = 0;
  std::vector<int> slice_of_;
  program::CaseFacts facts_ = program::case_facts<Case>();
  program::PlugRecord record_{Case::pipe_length};
  program::Schedule samples_{Case::sample_interval, Case::time_step};
};

/// That the folder is of this case, before anything is computed.
void check(void* lammps) {
  double low[3], high[3], xy, yz, xz;
  int periodic[3], changes = 0;
  lammps_extract_box(lammps, low, high, &xy, &yz, &xz, periodic, &changes);
  const double count = lammps_get_natoms(lammps), step = *static_cast<double*>(lammps_extract_global(lammps, "dt"));
  const auto refuse = [](const char* what, double found, double wanted) {
    if (std::abs(found - wanted) > 1e-9 * std::abs(wanted))
      throw Failure(program::exit_bad_input,
                    fmt::format("scene.in: {} is {:g}, and this program is for {:g}: export case {} again", what, found,
                                wanted, Case::name));
  };
  refuse("the number of particles", count, Case::particle_count);
  refuse("the length of the pipe", high[2] - low[2], Case::pipe_length);
  refuse("the time step", step, Case::time_step);
}

/// LAMMPS compiled with exceptions remembers an error instead of ending the program.
void require_no_error(void* lammps) {
  if (lammps_config_has_exceptions() == 0 || lammps_has_error(lammps) == 0) return;
  char message[1000];
  lammps_get_last_error_message(lammps, message, sizeof message);
  throw std::runtime_error(message);
}

void run(void* lammps) {
  lammps_file(lammps, "scene.in");
  require_no_error(lammps);
  check(lammps);
  const auto gas = std::make_unique<GasBeside>(lammps, MPI_COMM_WORLD);  // some MB in a long pipe
  lammps_set_fix_external_callback(lammps, "gas", &GasBeside::call, gas.get());
  lammps_file(lammps, "steps.in");
  require_no_error(lammps);
  const auto steps = *static_cast<std::int64_t*>(lammps_extract_global(lammps, "ntimestep"));
  gas->write_results(static_cast<double>(steps) * Case::time_step);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int code = 0;
  try {
    void* lammps = lammps_open(argc, argv, MPI_COMM_WORLD, nullptr);
    run(lammps);
    lammps_close(lammps);
  } catch (const Failure& failure) {
    code = failure.code();
    std::fprintf(stderr, "gas_beside: %s\n", failure.what());
  } catch (const std::exception& error) {
    code = 1;
    std::fprintf(stderr, "gas_beside: %s\n", error.what());
  }
  if (code != 0) MPI_Abort(MPI_COMM_WORLD, code);
  MPI_Finalize();
}

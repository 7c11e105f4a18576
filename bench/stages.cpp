// The stages of a step, one at a time: stage/<stage>/<N>/<precision>, of listing also stage/<stage>/<N>/<D over
// d>/<precision>.
//
// A stage is a function of the kernel called for the whole pipe on the state of a scene under way; this is the one file
// of the benchmarks that knows how a step is put together. Called again and again, a stage would change its own input
// (histories grow, particles drift), so after every 64 calls the state is put back as it was.
//
// Some stages are not called in every step: `steps_per_call` says how many steps share a call, and the counters are per
// particle and step all the same, so that the stages of a step add up to it.
#include "stages.hpp"

#include "counters.hpp"
#include "pipes.hpp"
#include "scenes.hpp"

namespace fixdem::bench {
namespace {

constexpr int W = native_lanes;

/// All ranges, with the walls of all chunks, listed out of the outer list.
template <class Case>
struct NearListStage {
  static constexpr Contacting contacting = Contacting::none;
  static void call(State<Case>& s) {
    for (int range = 0; range < NearList<Case>::ranges; ++range) {
      if (range < Capacity<Case>::chunks)
        for_each_wall(s.contacts, [&](auto& walls) { walls.validity[range].used = 1; });
      require(keep_listed<Case, W>(s.contacts, s.near_list, s.particles, s.before.kept, range, 1));  // a way of a metre
    }
    for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk)
      require(list_slots(s.contacts, s.near_list, s.particles, s.scratch, chunk));
  }
};

/// Particles sorted again, and everything listed.
template <class Case>
struct OrderStage {
  static constexpr Contacting contacting = Contacting::none;
  static void call(State<Case>& s) {
    require(renew<Case, W>(s.contacts, s.near_list, s.particles, s.before.kept, s.scratch, s.line, s.step));
  }
};

template <class Case>
struct PairStage {
  static constexpr Contacting contacting = Contacting::pairs;
  static void call(State<Case>& s) {
    constexpr int width = Contacts<Case>::row_width;
    for (int range = 0; range < NearList<Case>::ranges; ++range) {
      const bool wraps = range == Capacity<Case>::chunks;
      Real<Case>* rows = s.contacts.ring(0) + (wraps ? Rows<Case>::wrap_first : s.contacts.first_row(range)) * width;
      const bool are_still = s.near_list.is_still(s.near_list.velocities_of(range));
      dense_pairs<Case, W>(s.contacts.pairs, s.particles, range, are_still, rows, s.contacts.torque_at(rows),
                           s.monitor[range]);
    }
  }
};

template <class Case>
struct WallStage {
  static constexpr Contacting contacting = Contacting::walls;
  static void call(State<Case>& s) {
    constexpr int width = Contacts<Case>::row_width;
    for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk)
      for_each_wall_row<Case>(s.contacts, chunk, [&](auto& walls, int first_row) {
        dense_walls<Case, W>(walls, s.particles, chunk, s.near_list.is_still(s.near_list.velocities_of(chunk)),
                             s.contacts.ring(0) + first_row * width, s.monitor[chunk]);
      });
  }
};

/// Contacts of sparse chunks, from the separations to the sums of their particles.
template <class Case>
struct SparseStage {
  static constexpr Contacting contacting = Contacting::all;
  static void call(State<Case>& s) {
    for (int chunk = 0; chunk < Capacity<Case>::chunks; chunk += chunks_together)
      compute_sparse<Case, W>(s, chunk, std::min(chunk + chunks_together, Capacity<Case>::chunks));
  }
};

template <class Case>
struct GasStage {
  static constexpr Contacting contacting = Contacting::none;
  static constexpr int steps_per_call = Case::gas_update_interval;
  static void call(State<Case>& s) { require(update_slices<Case, W>(s.gas, s.particles, s.step)); }
};

template <class Case>
struct FloatersStage {
  static constexpr Contacting contacting = Contacting::none;
  static constexpr int steps_per_call = Case::gas_floater_interval;
  static void call(State<Case>& s) { find_floaters<Case, W>(s.gas, s.particles, s.near_list.outer); }
};

/// Sum of the force rows and integration. The rows are what the last two chunks left.
template <class Case>
struct MotionStage {
  static constexpr Contacting contacting = Contacting::none;
  static void call(State<Case>& s) {
    for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk)
      move<Case, W>(s.contacts, s.particles, chunk, s.contacts.ring(0), s.monitor[chunk]);
  }
};

/// Steps that a near list of the scene lasts; at least 1000 and at most 20000 are run to find out.
template <class Case>
double steps_per_renewal(Simulation<Case>& simulation) {
  const double before = lists_made(simulation);
  for (int thousands = 1;; ++thousands) {
    require(simulation.run(1000));
    const double lists = lists_made(simulation) - before;
    if (lists >= 3 || thousands == 20) return 1000.0 * thousands / std::max(1.0, lists);
  }
}

/// A stage on a scene under way, and the state to put back.
template <class Case>
struct Prepared {
  Simulation<Case> simulation;
  State<Case> saved;
  double steps_per_renewal;
};

template <class Case, class Stage, class Start>
void one_stage(benchmark::State& state, Start start) {
  static std::unique_ptr<Prepared<Case>> prepared;
  if (!prepared) {
    prepared = std::make_unique<Prepared<Case>>();
    start(prepared->simulation);
    prepared->steps_per_renewal = steps_per_renewal(prepared->simulation);
    prepared->saved = prepared->simulation.state();
  }
  constexpr int calls = 64;
  State<Case>& s = prepared->simulation.state();
  double seconds = 0;
  for (auto _ : state) {
    const double begin = processor_seconds();
    for (int k = 0; k < calls; ++k) {
      Stage::call(s);
      benchmark::ClobberMemory();
    }
    seconds += processor_seconds() - begin;
    state.PauseTiming();
    s = prepared->saved;
    state.ResumeTiming();
  }
  double steps_per_call = 1;
  if constexpr (requires { Stage::steps_per_call; }) steps_per_call = Stage::steps_per_call;
  if constexpr (std::is_same_v<Stage, NearListStage<Case>>) steps_per_call = prepared->steps_per_renewal;
  state.counters["steps_per_call"] = steps_per_call;
  report(state, prepared->simulation, static_cast<double>(state.iterations()) * calls * steps_per_call, seconds,
         Stage::contacting);
}

template <class Case, template <class> class Stage, class Start>
void add(const std::string& stage, Start start, const std::string& width = "") {
  const std::string name =
      "stage/" + stage + "/" + std::to_string(Case::particle_count) + "/" + width + precision_name(Case::precision);
  benchmark::RegisterBenchmark(name.c_str(),
                               [start](benchmark::State& state) { one_stage<Case, Stage<Case>>(state, start); });
}

/// Sorting and listing against the width of the pipe, of particles in flight.
template <int ratio>
void add_listing() {
  using Case = filled_with_small<ratio, repeats_for(ratio, 10000), Precision::double_precision>;
  const auto start = [](auto& simulation) { start_agitated_of<ratio>(simulation); };
  add<Case, NearListStage>("near_list", start, std::to_string(ratio) + "/");
  add<Case, OrderStage>("order", start, std::to_string(ratio) + "/");
}

template <Precision P>
void add_all() {
  const auto bed_start = [](auto& simulation) { start_bed(simulation); };
  const auto plug_start = [](auto& simulation) { start_stored(simulation, states.plug); };
  using Bed = bed<1000, P>;
  add<Bed, NearListStage>("near_list", bed_start);
  add<Bed, PairStage>("pair", bed_start);
  add<Bed, WallStage>("wall", bed_start);
  add<Bed, MotionStage>("motion", bed_start);
  add<Bed, OrderStage>("order", bed_start);
  add<agitated<1000, P>, SparseStage>("sparse", [](auto& simulation) { start_agitated(simulation); });
  add<plug<P>, GasStage>("gas", plug_start);
  add<plug<P>, FloatersStage>("floaters", plug_start);
}

}  // namespace

void register_stages() {
  add_all<Precision::double_precision>();
  add_all<Precision::mixed_precision>();
  add_listing<5>();
  add_listing<17>();
  add_listing<30>();
}

}  // namespace fixdem::bench

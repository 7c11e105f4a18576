// States whose bytes have come from outside: those that the kernel says may be run never lead it out of its arrays.
//
// The bytes of a running scene are changed at random, as by a checkpoint whose checksum has been made to fit: anywhere,
// and within each array of indices. What is accepted is run on, over the next decisions about the order along the pipe:
// into a fault or not, but without a crash, and with the bytes around the simulation untouched (with SAN=1 the
// sanitizers look on). Untouched states of every age are accepted.
#include <doctest/doctest.h>

#include <cstring>
#include <string>

#include "cases/settle.hpp"
#include "guarded.hpp"
#include "line_scenes.hpp"
#include "small_gas_scene.hpp"

using namespace fixdem::tests;
using namespace fixdem;

namespace {

constexpr int trials = 300;

template <class Case>
class Hostile {
 public:
  Hostile() : object_(guarded<Case>()), chance_(seed()) {
    enter({Case::name, seed()});
    if constexpr (is_line<Case>)
      place_all(object_.simulation, spheres_of_line<Case>(0.5, 1, Random(seed())));
    else
      place_all(object_.simulation, layered_spheres<Case>(Case::pipe_length / 7, 0.5, Random(seed())));
    REQUIRE(object_.simulation.start().ok());
    for (int age : {0, 1, 15, 16, 700, 1500}) {
      REQUIRE(object_.simulation.run(age).ok());
      CHECK(object_.simulation.is_consistent());
    }
    good_.assign(bytes(), sizeof(Simulation<Case>));
  }

  /// Changes one to four bytes of a field again and again.
  template <class Field>
  void change(const char* what, Field& field) {
    CAPTURE(what);
    auto* first = reinterpret_cast<char*>(&field);
    for (int k = 0; k < trials; ++k) {
      const int changes = static_cast<int>(chance_(1, 5));
      for (int c = 0; c < changes; ++c) {
        char& byte = first[static_cast<std::size_t>(chance_(0, sizeof field))];
        byte =
            static_cast<char>(chance_(0, 2) < 1 ? byte ^ (1 << static_cast<int>(chance_(0, 8))) : chance_(-128, 128));
      }
      try_it();
    }
  }

  Simulation<Case>& simulation() { return object_.simulation; }
  int accepted = 0, refused = 0;

 private:
  char* bytes() { return reinterpret_cast<char*>(&object_.simulation); }
  void try_it() {
    if (object_.simulation.is_consistent()) {
      ++accepted;
      object_.simulation.run(40);
      object_.simulation.observe();
      object_.simulation.particle(0);
    } else {
      ++refused;
    }
    if (!object_.intact()) FAIL("bytes outside the simulation have changed");
    std::memcpy(bytes(), good_.data(), good_.size());
  }

  Guarded<Case>& object_;
  Random chance_;
  std::string good_;
};

template <class Case>
void attack() {
  static Hostile<Case> hostile;
  State<Case>& s = hostile.simulation().state();
  hostile.change("the whole", hostile.simulation());
  CHECK(hostile.accepted > 0);
  hostile.change("numbers of particles", s.particles.id);
  hostile.change("places", s.particles.position);
  hostile.change("outer owners", s.near_list.outer.owner);
  hostile.change("outer partners", s.near_list.outer.partner);
  hostile.change("outer counts", s.near_list.outer.pairs);
  hostile.change("span", s.near_list.outer.span);
  hostile.change("chunks at the ends", s.near_list.outer.last_at_start);
  hostile.change("next decision", s.near_list.next_decision);
  hostile.change("last sort", s.near_list.sorted_at);
  hostile.change("travel since then", s.near_list.travel);
  hostile.change("kept histories", s.before.kept);
  hostile.change("owners", s.contacts.pairs.owner);
  hostile.change("partners", s.contacts.pairs.partner);
  hostile.change("bits of touching pairs", s.contacts.pairs.touching);
  hostile.change("counts of pairs", s.contacts.pairs.count);
  hostile.change("slots", s.contacts.slots);
  hostile.change("buckets", s.contacts.bucket);
  hostile.change("status", s.status);
  if constexpr (Case::has_wall) hostile.change("walls", s.contacts.pipe);
  if constexpr (Derived<Case>::has_ends) hostile.change("ends", s.contacts.ends);
  if constexpr (is_line<Case>) {
    hostile.change("rows in use", s.particles.slots.rows_in_use);
    hostile.change("slots of particles", s.particles.slots);
    hostile.change("books of the line", s.line);
  }
  CHECK(hostile.refused > trials);
}

}  // namespace

TEST_CASE("consistency: a periodic pipe with gas") { attack<small_gas>(); }
TEST_CASE("consistency: a closed pipe") { attack<small_closed>(); }
TEST_CASE("consistency: an open line") { attack<in_two_species<short_line>>(); }

/// Whether the simulation is not accepted with another value in one place; it is with the present one.
template <class Case, class Value, class Broken>
bool is_refused(const Simulation<Case>& simulation, Value& value, Broken broken) {
  const Value good = value;
  value = static_cast<Value>(broken);
  const bool is_accepted = simulation.is_consistent();
  value = good;
  CHECK(simulation.is_consistent());
  return !is_accepted;
}

TEST_CASE("consistency: single promises of a line") {
  using Case = in_two_species<short_line>;
  static Hostile<Case> hostile;
  Simulation<Case>& simulation = hostile.simulation();
  State<Case>& s = simulation.state();
  const auto refused = [&](auto& value, auto broken) { return is_refused(simulation, value, broken); };
  auto& slots = s.particles.slots;
  const int id = s.particles.id[3];
  for (const int rows : {-1, slots.rows_in_use - 1, slots.rows_in_use + 1, Case::particle_count + 1, 1 << 30})
    CHECK(refused(slots.rows_in_use, rows));
  CHECK(refused(slots.is_taken[id], false));
  CHECK(refused(slots.is_taken[Case::particle_count - 1], true));
  CHECK(refused(slots.kind[id], kinds_in<Case>));
  CHECK(refused(slots.kind[id], slots.kind[id] < 60 ? 60 : 0));  // of the other species
  CHECK(refused(slots.serial[id], -1));
  CHECK(refused(slots.serial[id], Case::start_count + s.line.entered.count));
  CHECK(refused(s.line.entered.count, s.line.entered.count + 1));
  CHECK(refused(s.line.left[0].count, s.line.left[0].count + 1));
  CHECK(refused(s.line.left[0].count, -1));
  CHECK(refused(s.line.blocked_events, 1LL << 62));
  CHECK(refused(s.line.tries, -1));
  CHECK(refused(s.line.sorted_chunks, s.line.sorted_chunks + 1));
}

TEST_CASE("consistency: single promises of a state") {
  static Hostile<small_gas> hostile;
  Simulation<small_gas>& simulation = hostile.simulation();
  State<small_gas>& s = simulation.state();
  const auto refused = [&](auto& value, auto broken) { return is_refused(simulation, value, broken); };
  CHECK(refused(s.particles.id[3], -1));
  CHECK(refused(s.particles.id[3], s.particles.id[4]));
  CHECK(refused(s.particles.id[3], small_gas::particle_count));
  CHECK(refused(s.particles.position[3][2], 1e300));
  CHECK(refused(s.particles.position[3][2], __builtin_nan("")));
  OuterList<small_gas>& outer = s.near_list.outer;
  CHECK(refused(outer.span, outer.span + 1));
  CHECK(refused(s.near_list.next_decision, s.step + 1000000));
  CHECK(refused(s.near_list.sorted_at, s.step + 1));
  CHECK(refused(s.near_list.travel[0], -1.0));
  CHECK(refused(outer.last_at_start, Capacity<small_gas>::chunks));
  CHECK(refused(outer.pairs[0], outer.capacity(0) + 1));
  CHECK(refused(outer.partner[0], Rows<small_gas>::offset((outer.span + 1) * Capacity<small_gas>::chunk_size)));
  CHECK(refused(s.contacts.pairs.count[0], -1));
  CHECK(refused(s.contacts.pairs.count[0], Capacity<small_gas>::chunk_pairs + 1));
  using Offset = typename Rows<small_gas>::Offset;
  CHECK(refused(s.contacts.pairs.owner[0][0], static_cast<Offset>(s.contacts.pairs.owner[0][0] + 1)));
  CHECK(refused(s.contacts.pairs.owner[0][0], Rows<small_gas>::offset(Capacity<small_gas>::chunk_size)));
  CHECK(refused(s.contacts.pairs.touching[0], static_cast<std::uint16_t>(0x8000)));
  REQUIRE(!s.contacts.has_rows[0]);
  CHECK(refused(s.contacts.has_rows[0], true));
  CHECK(refused(s.contacts.rows[Rows<small_gas>::zero * Contacts<small_gas>::row_width], 1.0));
  CHECK(refused(s.contacts.sum[7][1], 1.0));
  CHECK(refused(s.step, -1LL));
  CHECK(refused(s.status.fault, Fault::overlap));
}

TEST_CASE("consistency: slots of a dense chunk") {
  static Hostile<small_closed> hostile;
  State<small_closed>& s = hostile.simulation().state();
  REQUIRE(hostile.simulation().run(200000).ok());  // until all lie at rest
  int dense = -1;
  for (int chunk = 0; chunk < Capacity<small_closed>::chunks; ++chunk)
    if (s.contacts.has_rows[chunk]) dense = chunk;
  REQUIRE(dense >= 0);
  auto &slot = s.contacts.slots[dense][0], good_slot = slot;
  slot = Rows<small_closed>::slot_offset(Capacity<small_closed>::chunk_size);
  CHECK(!hostile.simulation().is_consistent());
  slot = good_slot;
  CHECK(hostile.simulation().is_consistent());
  ++s.contacts.bucket[dense][0];
  CHECK(!hostile.simulation().is_consistent());
}

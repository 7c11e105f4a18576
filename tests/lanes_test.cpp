// Lane widths give the same bytes, the pinned ones: the scalar twin of the SIMD vocabulary against the registers.
//
// Agitated closed and periodic scenes with sliding, sticking, new and ended contacts, walls and gas; every particle's
// position, velocity and angular velocity and the energies are compared byte by byte: the widest registers with one
// lane for every scene, the widths between for one of each precision. tests/golden/scenes.txt holds the hashes that
// every instruction set must come to, as tests/identical/main.cpp prints them; `make golden` renews it.
#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <sstream>
#include <string>

#include "identical/scenes.hpp"
#include "kernel/fixdem.hpp"
#include "program_run.hpp"
#include "tools/embedded/state_hash.hpp"

namespace {

using namespace fixdem::tests::identical;

template <class Case, int W>
std::unique_ptr<fixdem::Simulation<Case, W>> ended() {
  auto simulation = std::make_unique<fixdem::Simulation<Case, W>>();
  place_agitated(*simulation);
  REQUIRE(simulation->start().ok());
  REQUIRE(simulation->run(steps).ok());
  CHECK(simulation->energy().dissipated_damping != 0);  // something did collide
  return simulation;
}

template <class Case, int W, int Other>
std::string compare_widths() {
  const auto wide = ended<Case, W>();
  const auto narrow = ended<Case, Other>();
  int different = 0;
  for (int id = 0; id < Case::particle_count; ++id) {
    different += wide->is_present(id) != narrow->is_present(id) || wide->serial(id) != narrow->serial(id);
    if (!wide->is_present(id)) continue;
    const fixdem::Particle a = wide->particle(id), b = narrow->particle(id);
    different += std::memcmp(&a, &b, sizeof a) != 0;
  }
  CHECK(different == 0);
  const fixdem::Energy a = wide->energy(), b = narrow->energy();
  CHECK(std::memcmp(&a, &b, sizeof a) == 0);
  if constexpr (fixdem::is_line<Case>) {
    const fixdem::LineTotals s = wide->line(), t = narrow->line();
    CHECK(std::memcmp(&s, &t, sizeof s) == 0);
    CHECK(s.fed > 3);
    CHECK(s.left > 0);
  }
  char hash[32];
  std::snprintf(hash, sizeof hash, "%016llx", fixdem::state_hash(*wide));

  // The bytes of one go on in the other: a checkpoint does not depend on the width that wrote it.
  static_assert(sizeof *wide == sizeof *narrow);
  std::memcpy(static_cast<void*>(narrow.get()), wide.get(), sizeof *narrow);
  REQUIRE(wide->run(200).ok());
  REQUIRE(narrow->run(200).ok());
  CHECK(fixdem::state_hash(*wide) == fixdem::state_hash(*narrow));
  return hash;
}

constexpr int widest = FIXDEM_WIDEST_LANES;

}  // namespace

TEST_CASE("golden: small scenes end in the same bytes with the widest registers and with one lane") {
  std::string found;
  for_each_scene([&]<class Case>(const char* name) {
    CAPTURE(name);
    found += std::string(name) + " " + compare_widths<Case, widest, 1>() + "\n";
  });
  const std::string file = FIXDEM_GOLDEN_SCENES;
  if (std::getenv("FIXDEM_RENEW_GOLDEN") != nullptr) {
    fixdem::tests::write_bytes(file, found);
    return;
  }
  CHECK_MESSAGE(found == fixdem::tests::read_bytes(file), "if the results were meant to change: make golden");
}

TEST_CASE("the widths between end in the same bytes too") {
  if constexpr (widest >= 4) {
    compare_widths<gas, 2, widest / 2>();
    compare_widths<mixed_paper, 2, widest / 2>();
    compare_widths<line, 2, widest / 2>();
  }
}

// Frames for ParaView and OVITO, and the LAMMPS dump: what is written reads back to the same bits.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "tools/run/dump.hpp"
#include "tools/run/frames_vtp.hpp"

using namespace fixdem;
using namespace fixdem::program;

namespace {

const ParticleKinds equal{0.01, 1000, 5e-4};

std::vector<Particle> two_particles() {
  return {{{0.001, -0.002, 0.1}, {1, 2, 3}, {4, 5, 6}}, {{0, 0, 0.109}, {-1, 0, 1e-300}, {0, 0, -0.0}}};
}

}  // namespace

TEST_CASE("dump: a LAMMPS section that reads back exactly") {
  Snapshot snapshot;
  snapshot.step = 500;
  snapshot.particles = two_particles();
  CaseFacts facts{};
  facts.pipe_diameter = 0.05, facts.pipe_length = 0.8, facts.is_periodic = true, facts.diameter = 0.01;
  const std::string text = encode_dump(snapshot, facts);
  CHECK(text ==
        "ITEM: TIMESTEP\n500\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff pp\n-0.025 0.025\n-0.025 0.025\n0 0.8\n"
        "ITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz radius\n"
        "1 1 0.001 -0.002 0.1 1 2 3 4 5 6 0.005\n2 1 0 0 0.109 -1 0 1e-300 0 0 -0 0.005\n");
}

TEST_CASE(
    "frame: as text it has the same bits, and what OVITO asks of a VTP file: no appended data, the piece first, "
    "positions in Points") {
  Snapshot snapshot;
  snapshot.particles = two_particles();
  snapshot.particles[0].velocity[1] = 0.1 + 0.2;
  const std::string vtp = encode_vtp(snapshot, equal, VtpData::text);
  CHECK(vtp.find("appended") == std::string::npos);
  CHECK(vtp.find("AppendedData") == std::string::npos);
  CHECK(vtp.find("<PolyData>\n    <Piece ") != std::string::npos);
  const std::string points = "Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">";
  REQUIRE(vtp.find(points) != std::string::npos);
  CHECK(vtp.substr(vtp.find(points) + points.size()).starts_with("0.001 -0.002 0.1 0 0 0.109</DataArray>"));
  const std::string velocity = "Name=\"velocity\" NumberOfComponents=\"3\" format=\"ascii\">";
  std::istringstream values(vtp.substr(vtp.find(velocity) + velocity.size()));
  for (const Particle& particle : snapshot.particles)
    for (const double expected : particle.velocity) {
      double value = -1;
      values >> value;
      CHECK(value == expected);
    }
  CHECK(vtp.find("Name=\"id\" NumberOfComponents=\"1\" format=\"ascii\">0 1</DataArray>") != std::string::npos);
}

TEST_CASE(
    "frame: the gas's pressure gradient is field data, as long as the pipe has slices; without gas there is none") {
  Snapshot snapshot;
  snapshot.particles.resize(2);
  CHECK(encode_vtp(snapshot, equal).find("pressure_gradient") == std::string::npos);
  snapshot.pressure_gradients = {3.5, -1.25, 1e4};
  const std::string vtp = encode_vtp(snapshot, equal);
  CHECK(vtp.find("Name=\"pressure_gradient\" NumberOfTuples=\"3\" format=\"appended\" offset=\"0\"") !=
        std::string::npos);
  const std::size_t data = vtp.find('_', vtp.find("<AppendedData")) + 1;
  std::uint64_t size = 0;
  std::memcpy(&size, vtp.data() + data, sizeof size);
  REQUIRE(size == 3 * sizeof(double));
  double values[3];
  std::memcpy(values, vtp.data() + data + sizeof size, sizeof values);
  CHECK(values[0] == 3.5);
  CHECK(values[1] == -1.25);
  CHECK(values[2] == 1e4);
}

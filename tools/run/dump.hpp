// dump.lammpstrj: the frames once more as a LAMMPS text dump, for tools that read nothing else (`[output] dump =
// true`).
//
// One section per frame: id and type (from 1, as LAMMPS counts; the type is the species; in a line the id is that of
// the serial number), position, velocity, angular velocity, radius, and with several sizes mass; numbers with as many
// digits as they need to read back exactly. SI units.
#pragma once

#include <string>

#include "case_facts.hpp"
#include "snapshot.hpp"

namespace fixdem::program {

std::string encode_dump(const Snapshot&, const CaseFacts&);

}  // namespace fixdem::program

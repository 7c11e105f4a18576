// Frames for ParaView or OVITO: one VTP file each (VTK XML PolyData; vtp_series.hpp lists them with their times).
//
// VTK writes this format too, but as a dependency it is a hundred times larger than this program; what is needed here
// is a short XML header and the arrays: as raw appended binary data, each preceded by its size in bytes as UInt64, or
// as text in the XML elements, in as many digits as give the same bits back. OVITO (ParaViewVTPParticleImporter
// of 3.16) refuses appended data, takes a file for one of particles only if nothing but its Piece comes first, and
// wants the array of positions to be called Points, as VTK's own writer does. Points in m, velocity in m/s,
// angular_velocity in rad/s, radius in m, contacts (number per particle), id (input order; in a line from 0 on, with
// the serial number beside it), and where particles differ in them density in kg/m3 and species (its number in the case
// file, from 0); one vertex cell per particle, so that ParaView shows the points without a filter. Positions and motion
// in double precision. The time, the step and, with gas, the pressure gradient of each slice (Pa/m) are field data.
#pragma once

#include <string>
#include <vector>

#include "particle_kinds.hpp"
#include "snapshot.hpp"
#include "vtp_arrays.hpp"

namespace fixdem::program {

std::string encode_vtp(const Snapshot&, const ParticleKinds&, VtpData = VtpData::appended);
/// Of the chosen particles only, which are numbers in input order.
std::string encode_vtp(const Snapshot&, const ParticleKinds&, VtpData, const std::vector<int>& chosen);

}  // namespace fixdem::program

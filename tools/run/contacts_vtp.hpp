// The network of contact forces for ParaView: one VTP file each `contact_interval` (vtp_series.hpp lists them).
//
// Every contact is a line from the centre of its owner to that of its partner, across the ends of a periodic pipe to
// the nearest image, or to the wall. Cell data of each:
//   owner, partner      serial numbers; -1 pipe wall, -2 end at z = 0, -3 end at z = length
//   normal_force        N, positive when repelling; tangential_force: magnitude, N
//   force               on the partner, N: those on a wall add up to what it bears
//   sliding             1 where friction is at its limit
//   dissipation         W at this moment: by the normal dashpot, and by sliding or the tangential dashpot; not by
//   rolling
// Appended data, or text as the frames are.
#pragma once

#include <string>

#include "case_facts.hpp"
#include "snapshot.hpp"
#include "vtp_arrays.hpp"

namespace fixdem::program {

/// What the owner of a contact exerts on its partner, N.
void force_on_partner(const Contact&, double (&force)[3]);

/// State of friction and power lost.
struct ContactLoss {
  bool is_sliding;
  double power;  ///< W
};
ContactLoss contact_loss(const CaseFacts&, const Snapshot&, const Contact&);

std::string encode_contacts(const Snapshot&, const CaseFacts&, VtpData = VtpData::appended);

}  // namespace fixdem::program

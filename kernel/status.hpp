// How a run can fail, and how it says so.
//
// Every check names the particle, the step and the value that broke a limit; nothing is ever written out of bounds.
// The step stops at the first fault and stays stopped.
#pragma once

namespace fixdem {

enum class Fault {
  none,
  neighbour_capacity,  ///< near pairs of one particle
  pair_capacity,       ///< near pairs owned by one chunk, or across the periodic ends
  chunk_capacity,      ///< particles within reach along the pipe
  history_capacity,    ///< contacts with a history
  not_placed,          ///< particles that are there at the start
  non_finite,          ///< a position or velocity that is no number
  outside_pipe,        ///< distance from the axis, or place along a closed pipe, in m
  overlap,             ///< overlap of a contact, in radii
  too_fast,            ///< travel of a particle in one step, in radii
  order_lost,          ///< travel of a particle since the order along the pipe was made, in diameters
  gas_unsolved,        ///< relative residual of the gas flow in a slice or along the pipe
  line_full            ///< particles in an open line
};

/// What the value of a fault is, for messages.
constexpr const char* describe(Fault fault) {
  switch (fault) {
    case Fault::none:
      return "no fault";
    case Fault::neighbour_capacity:
      return "near neighbours of one particle";
    case Fault::pair_capacity:
      return "near pairs in one chunk of the pipe";
    case Fault::chunk_capacity:
      return "particles within reach along the pipe";
    case Fault::history_capacity:
      return "contacts with a history";
    case Fault::not_placed:
      return "times that the particle was placed before the start";
    case Fault::non_finite:
      return "a value that is not finite";
    case Fault::outside_pipe:
      return "distance from the axis or place along the pipe in m";
    case Fault::overlap:
      return "overlap in radii";
    case Fault::too_fast:
      return "distance travelled in one step in radii";
    case Fault::order_lost:
      return "sudden travel since particles were sorted, in diameters";
    case Fault::gas_unsolved:
      return "relative residual of the gas flow in a slice or along the pipe";
    case Fault::line_full:
      return "particles in the pipe";
  }
  return "unknown fault";
}

/// Without gaps between its members: checkpoints hold its bytes, and all of them must be known.
struct Status {
  Fault fault = Fault::none;
  int particle = -1;   ///< number in input order; -1 where it is no particle's
  long long step = 0;  ///< steps completed when the fault was found
  double value = 0;    ///< what describe(fault) says
  double limit = 0;    ///< the maximum allowed
  constexpr bool ok() const { return fault == Fault::none; }
};

}  // namespace fixdem

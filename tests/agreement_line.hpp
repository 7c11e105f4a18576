// Kernel against reference in an open line, from its start on: particles are compared by serial number.
#pragma once

#include "agreement.hpp"
#include "line_scenes.hpp"

namespace fixdem::tests {

template <class Case>
Events check_line_from(const Spheres& spheres, const char* what, double tolerance = position_tolerance<Case>) {
  enter({Case::name, seed()});
  HandOver start;
  start.spheres = spheres;
  const Events events = check_agreement<Case>(start, what, tolerance);
  const LineTotals totals = kernel<Case>().line();
  INFO(std::string(what));
  CHECK(totals.fed > 10);
  if (Case::start_count > 0) CHECK(totals.left > 3);
  CHECK(events.begun > 0);
  CHECK(events.ended > 0);
  return events;
}

/// At random, on their way to the outlet at 2 m/s.
template <class Case>
Events check_line(const char* what, double tolerance = position_tolerance<Case>) {
  return check_line_from<Case>(spheres_of_line<Case>(0.5, 2, Random(seed())), what, tolerance);
}

/// A plug that leaves with its contacts.
template <class Case>
Events check_plug_leaves(const char* what, double tolerance = position_tolerance<Case>) {
  return check_line_from<Case>(plug_at_outlet<Case>(Random(seed())), what, tolerance);
}

}  // namespace fixdem::tests

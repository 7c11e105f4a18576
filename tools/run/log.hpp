// One moment of a run as a row: of the table on stdout, and of log.csv with all columns.
//
// log.csv has the units in its header; what is not defined at a moment (no plug) is an empty cell. Columns that the
// case has no physics for do not exist. Rows are written whole.
#pragma once

#include <string>
#include <vector>

#include "case_facts.hpp"
#include "line_record.hpp"
#include "plug_analysis.hpp"
#include "simulation_view.hpp"

namespace fixdem::program {

struct LogRow {
  double time = 0;
  long long step = 0;
  Observation observation{};
  Energy energy{};
  double balance_error = 0;
  double step_ratio = 0;  ///< time step / stable step (stability_watch.hpp)
  PlugSample plug{};
  std::vector<double> species_velocity;  ///< mean axial velocity of each species, m/s; with gas and species
  LineRow line{};                        ///< of a line
};

std::string log_header(const CaseFacts&);
std::string log_line(const CaseFacts&, const LogRow&);

std::string table_header(const CaseFacts&);
std::string table_row(const CaseFacts&, const LogRow&);

}  // namespace fixdem::program

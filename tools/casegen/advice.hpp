// What a valid case had better choose otherwise: its time step, its precision.
#pragma once

#include <string>

#include "reader.hpp"
#include "report.hpp"

namespace fixdem::casegen {

/// Warns in the report when a contact is resolved by too few steps; returns the advice as lines of text.
std::string advise_time_step(const Reading& reading, const std::string& name, Report& report);

/// Warns where mixed precision does not pay.
void advise_precision(const Reading& reading, Report& report);

}  // namespace fixdem::casegen

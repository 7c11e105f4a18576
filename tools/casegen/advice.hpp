// How the time step of a case compares with what happens in a contact.
#pragma once

#include <string>

#include "reader.hpp"
#include "report.hpp"

namespace fixdem::casegen {

/// Warns in the report when a contact is resolved by too few steps; returns the advice as lines of text.
std::string advise_time_step(const Reading& reading, const std::string& name, Report& report);

}  // namespace fixdem::casegen

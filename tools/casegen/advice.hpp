// What a valid case had better choose otherwise: its time step, its precision, its model of the gas, its feed.
#pragma once

#include <string>

#include "reader.hpp"
#include "report.hpp"

namespace fixdem::casegen {

/// Warns in the report when a contact is resolved by too few steps; returns the advice as lines of text.
std::string advise_time_step(const Reading& reading, const std::string& name, Report& report);

/// Warns where mixed precision does not pay.
void advise_precision(const Reading& reading, Report& report);

/// Warns where the gas changes along the pipe more than its model knows of.
void advise_gas(const Reading& reading, Report& report);

/// Warns of a feed that asks for more than it can take, and of a line that stays empty.
void advise_feed(const Reading& reading, Report& report);

}  // namespace fixdem::casegen

// toml++ with its assertions turned into exceptions.
//
// Version 3.3.0 asserts on some malformed input, such as `[[{`: a bad case must be refused, not abort the program, and
// without assertions the parser would run on into undefined behaviour. Include this file, never toml++ itself.
#pragma once

#include <stdexcept>

#ifdef NDEBUG
#error "tools/casegen needs the assertions of toml++: compile it without NDEBUG"
#endif

namespace fixdem::casegen {

constexpr void require(bool condition, const char* text) {
  if (!condition) throw std::invalid_argument(text);
}

}  // namespace fixdem::casegen

#define TOML_ASSERT(condition) ::fixdem::casegen::require(static_cast<bool>(condition), #condition)
#include <toml++/toml.h>

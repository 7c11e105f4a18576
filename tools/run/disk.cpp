#include "disk.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "failure.hpp"

namespace fixdem::program::disk {
namespace {

enum class Fault { none, cut_short, full, error, crash, crashed };

struct Plan {
  Fault fault = Fault::none;
  long long at = 0;
};

Plan read_plan() {
  const char* text = std::getenv("FIXDEM_DISK_FAULT");
  if (text == nullptr) return {};
  struct Named {
    std::string_view name;
    Fault fault;
  };
  constexpr Named known[] = {{"short@", Fault::cut_short},
                             {"full@", Fault::full},
                             {"error@", Fault::error},
                             {"crash@", Fault::crash},
                             {"crashed@", Fault::crashed}};
  const std::string_view given = text;
  for (const auto& [name, fault] : known) {
    if (!given.starts_with(name)) continue;
    Plan plan{fault, 0};
    const auto [end, error] = std::from_chars(given.data() + name.size(), given.data() + given.size(), plan.at);
    if (error == std::errc{} && *end == '\0' && plan.at > 0) return plan;
  }
  throw Failure(exit_wrong_usage,
                fmt::format("FIXDEM_DISK_FAULT={}: allowed are short, full, error, crash and crashed, "
                            "followed by @ and a number from 1",
                            text));
}

/// What is to happen at the next operation.
Fault next_fault() {
  static const Plan plan = read_plan();
  static long long operations = 0;
  ++operations;
  if (plan.fault == Fault::full) return operations >= plan.at ? Fault::full : Fault::none;
  return operations == plan.at ? plan.fault : Fault::none;
}

[[noreturn]] void crash() {
  std::raise(SIGKILL);
  std::abort();
}

int failed(int error) {
  errno = error;
  return -1;
}

}  // namespace

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  static bool is_full = false;
  switch (next_fault()) {
    case Fault::none:
      break;
    case Fault::cut_short:
      size = size > 1 ? size / 2 : size;
      break;
    case Fault::full:
      if (is_full || size < 2) return failed(ENOSPC);
      is_full = true;
      size /= 2;
      break;
    case Fault::error:
      return failed(EIO);
    case Fault::crash:
      if (::write(descriptor, bytes, size / 2) >= 0) crash();
      crash();
    case Fault::crashed:
      if (::write(descriptor, bytes, size) >= 0) crash();
      crash();
  }
  return ::write(descriptor, bytes, size);
}

int fsync(int descriptor) {
  switch (next_fault()) {
    case Fault::full:
      return failed(ENOSPC);
    case Fault::error:
      return failed(EIO);
    case Fault::crash:
      crash();
    case Fault::crashed:
      if (::fsync(descriptor) == 0) crash();
      crash();
    default:
      return ::fsync(descriptor);
  }
}

int rename(const char* from, const char* to) {
  switch (next_fault()) {
    case Fault::error:
      return failed(EIO);
    case Fault::crash:
      crash();
    case Fault::crashed:
      if (::rename(from, to) == 0) crash();
      crash();
    default:
      return std::rename(from, to);
  }
}

}  // namespace fixdem::program::disk

// Values as bytes and back: what final.fixdem and checkpoints are made of.
//
// Every file begins with its own eight bytes, a byte-order mark and a version, and ends with the XXH64 of all bytes
// before it. A class says once what it consists of, in a member `transfer(archive)` that hands each value to
// `archive(...)`; it serves writing and reading, so the two cannot drift apart. Reading never goes beyond the end: what
// is missing, damaged or impossible is a Failure with exit code 3 that names the file.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "failure.hpp"
#include "kernel/fixdem.hpp"

namespace fixdem::program {

/// What is the same in both directions: how a value falls into its parts.
template <class Archive>
class ArchiveOf {
 public:
  template <class... Values>
  void operator()(Values&... values) {
    (one(values), ...);
  }

 private:
  Archive& self() { return static_cast<Archive&>(*this); }

  template <class T>
  void one(T& value) {
    if constexpr (std::is_same_v<T, bool>)
      self().flag(value);
    else if constexpr (std::is_arithmetic_v<T>)
      self().bytes(&value, sizeof value);
    else if constexpr (std::is_array_v<T>)
      for (auto& item : value) one(item);
    else
      value.transfer(self());
  }
  void one(std::string& text) {
    text.resize(self().count(text.size(), 1));
    self().bytes(text.data(), text.size());
  }
  template <class T>
  void one(std::vector<T>& list) {
    list.resize(self().count(list.size(), std::is_arithmetic_v<T> ? sizeof(T) : 1));
    for (T& item : list) one(item);
  }
  template <class T>
  void one(std::optional<T>& maybe) {
    bool is_there = maybe.has_value();
    self().flag(is_there);
    if (is_there && !maybe) maybe.emplace();
    if (!is_there) maybe.reset();
    if (maybe) one(*maybe);
  }
  void one(Particle& p) { (*this)(p.position, p.velocity, p.angular_velocity); }
  void one(Energy& e) {
    (*this)(e.kinetic, e.elastic, e.dissipated_damping, e.dissipated_sliding, e.gravity_work, e.gas_work,
            e.elastic_tangential, e.made_by_law, e.dissipated_rolling, e.entered, e.left_with);
  }
};

class BinaryWriter : public ArchiveOf<BinaryWriter> {
 public:
  /// The beginning of a file.
  void begin(std::string_view magic, std::uint32_t version);
  /// Its end: the checksum.
  void seal();

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(&value, sizeof value);
  }
  void bytes(const void* from, std::size_t size) { text_.append(static_cast<const char*>(from), size); }
  void flag(bool value) { put(std::uint8_t{value}); }
  std::uint64_t count(std::uint64_t number, std::size_t) { return put(number), number; }
  std::string& text() { return text_; }

 private:
  std::string text_;
};

/// Takes values off the front; running out of bytes is a refusal, never a read beyond the end.
class BinaryReader : public ArchiveOf<BinaryReader> {
 public:
  /// `name` is what messages call the file, `advice` their last line; both must outlive the reader.
  BinaryReader(std::string_view bytes, const std::string& name, const std::string& advice)
      : rest_(bytes), name_(name), advice_(advice) {}

  /// Checks what every file begins with, refusing what is not `what` ("state file") or of another version than those
  /// from `oldest` to `newest`; returns the version.
  std::uint32_t begin(std::string_view magic, const char* what, std::uint32_t oldest, std::uint32_t newest);
  /// Checks the checksum at the end of the whole file, and takes it off.
  void check_seal(std::string_view file);

  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) refuse("is cut short: {} more bytes are missing", size - rest_.size());
    const std::string_view front = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return front;
  }
  void bytes(void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, take(size).data(), size);
  }
  void flag(bool& value) { value = get<std::uint8_t>() != 0; }
  /// A number of items of at least `item_size` bytes each that can still follow.
  std::uint64_t count(std::uint64_t, std::size_t item_size) { return count(item_size); }
  std::uint64_t count(std::size_t item_size) {
    const auto number = get<std::uint64_t>();
    if (number > rest_.size() / item_size) refuse("is damaged: it announces {} items", number);
    return number;
  }
  bool empty() const { return rest_.empty(); }

  template <class... Values>
  [[noreturn]] void refuse(fmt::format_string<Values...> format, Values&&... values) const {
    throw Failure(exit_bad_input,
                  name_ + " " + fmt::format(format, std::forward<Values>(values)...) + "\n  " + advice_);
  }

 private:
  std::string_view rest_;
  const std::string& name_;
  const std::string& advice_;
};

/// All bytes of a file; a Failure with exit code 6 calls it `what` ("start state").
std::string read_file(const std::filesystem::path&, const char* what);

}  // namespace fixdem::program

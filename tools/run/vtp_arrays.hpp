// VTK XML PolyData as text: the elements of arrays with their values, or with the place of these behind the XML, and
// the frame around them. frames_vtp.hpp says what readers ask of it.
#pragma once

#include <fmt/ranges.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "snapshot.hpp"

namespace fixdem::program {

enum class VtpData { appended, text };

class VtpArrays {
 public:
  explicit VtpArrays(VtpData how) : how_(how) {}

  template <class T>
  std::string array(const char* name, const char* type, int components, const std::vector<T>& values) {
    return element(name, type, fmt::format("NumberOfComponents=\"{}\"", components), values);
  }
  /// Field data: as long as it likes, not one value for each point.
  template <class T>
  std::string field(const char* name, const char* type, const std::vector<T>& values) {
    return element(name, type, fmt::format("NumberOfTuples=\"{}\"", values.size()), values);
  }
  /// A whole file: `piece` is what its Piece holds, `fields` further field data beside time and step.
  std::string file(const Snapshot& snapshot, std::size_t points, std::size_t vertices, std::size_t lines,
                   const std::string& piece, const std::string& fields = "") const {
    return fmt::format(
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" "
               "header_type=\"UInt64\">\n"
               "  <PolyData>\n    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
               "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
               std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", points, vertices, lines) +
           piece +
           fmt::format(
               "    </Piece>\n    <FieldData>\n"
               "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
               "format=\"ascii\">{:.12g}</DataArray>\n"
               "      <DataArray type=\"Int64\" Name=\"step\" NumberOfTuples=\"1\" format=\"ascii\">{}"
               "</DataArray>\n{}    </FieldData>\n  </PolyData>\n",
               snapshot.time, snapshot.step, fields) +
           appended() + "</VTKFile>\n";
  }

 private:
  /// What comes behind the XML of the data set; nothing when the values are text.
  std::string appended() const {
    return how_ == VtpData::text ? "" : "  <AppendedData encoding=\"raw\">\n_" + bytes_ + "\n  </AppendedData>\n";
  }
  template <class T>
  std::string element(const char* name, const char* type, const std::string& size, const std::vector<T>& values) {
    const std::string tag = fmt::format("        <DataArray type=\"{}\" Name=\"{}\" {}", type, name, size);
    if (how_ == VtpData::text) return fmt::format("{} format=\"ascii\">{}</DataArray>\n", tag, fmt::join(values, " "));
    return fmt::format("{} format=\"appended\" offset=\"{}\"/>\n", tag, append(values));
  }
  template <class T>
  std::size_t append(const std::vector<T>& values) {
    const std::uint64_t size = values.size() * sizeof(T);
    const std::size_t offset = bytes_.size();
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return offset;
  }

  VtpData how_;
  std::string bytes_;
};

}  // namespace fixdem::program

#include "frames_vtp.hpp"

#include <fmt/ranges.h>

#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

#include "result_folder.hpp"

namespace fixdem::program {
namespace {

/// Writes the elements of arrays, with their values or with the place of these behind the XML.
class ArrayWriter {
 public:
  explicit ArrayWriter(VtpData kind) : kind_(kind) {}

  template <class T>
  std::string array(const char* name, const char* type, int components, const std::vector<T>& values) {
    return element(name, type, fmt::format("NumberOfComponents=\"{}\"", components), values);
  }
  /// Field data: as long as it likes, not one value for each point.
  template <class T>
  std::string field(const char* name, const char* type, const std::vector<T>& values) {
    return element(name, type, fmt::format("NumberOfTuples=\"{}\"", values.size()), values);
  }
  /// What comes behind the XML of the data set; nothing when the values are text.
  std::string appended() const {
    return kind_ == VtpData::text ? "" : "  <AppendedData encoding=\"raw\">\n_" + bytes_ + "\n  </AppendedData>\n";
  }

 private:
  template <class T>
  std::string element(const char* name, const char* type, const std::string& size, const std::vector<T>& values) {
    const std::string tag = fmt::format("        <DataArray type=\"{}\" Name=\"{}\" {}", type, name, size);
    if (kind_ == VtpData::text) return fmt::format("{} format=\"ascii\">{}</DataArray>\n", tag, fmt::join(values, " "));
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

  VtpData kind_;
  std::string bytes_;
};

bool densities_differ(const ParticleKinds& kinds, std::size_t particle_count) {
  for (std::size_t id = 0; id < particle_count; ++id)
    if (kinds.density_of(static_cast<int>(id)) != kinds.density) return true;
  return false;
}

using Triple = double[3];

std::vector<double> flat(const Snapshot& snapshot, const std::vector<int>& chosen,
                         const Triple& (*of)(const Particle&)) {
  std::vector<double> values;
  values.reserve(chosen.size() * 3);
  for (const int id : chosen) {
    const Particle& p = snapshot.particles[static_cast<std::size_t>(id)];
    values.insert(values.end(), of(p), of(p) + 3);
  }
  return values;
}

}  // namespace

std::string encode_vtp(const Snapshot& snapshot, const ParticleKinds& kinds, VtpData kind) {
  std::vector<int> all(snapshot.particles.size());
  std::iota(all.begin(), all.end(), 0);
  return encode_vtp(snapshot, kinds, kind, all);
}

std::string encode_vtp(const Snapshot& snapshot, const ParticleKinds& kinds, VtpData kind,
                       const std::vector<int>& chosen) {
  const std::size_t n = chosen.size();
  std::vector<std::int32_t> id(n), contacts(n), species(n);
  std::vector<double> radius(n), density(n);
  std::vector<std::int64_t> connectivity(n), offsets(n);
  const std::vector<int> contact_counts = contacts_per_particle(snapshot);
  for (std::size_t i = 0; i < n; ++i) {
    id[i] = chosen[i];
    radius[i] = kinds.radius_of(chosen[i]), density[i] = kinds.density_of(chosen[i]);
    species[i] = kinds.species_of(chosen[i]);
    contacts[i] = contact_counts[static_cast<std::size_t>(chosen[i])];
    connectivity[i] = static_cast<std::int64_t>(i);
    offsets[i] = static_cast<std::int64_t>(i) + 1;
  }
  ArrayWriter data(kind);
  const std::string gas = snapshot.pressure_gradients.empty()
                              ? std::string()
                              : data.field("pressure_gradient", "Float64", snapshot.pressure_gradients);
  std::string xml = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n"
      "  <PolyData>\n    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n      <Points>\n",
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", n, n);
  xml += data.array("Points", "Float64", 3,
                    flat(snapshot, chosen, [](const Particle& p) -> const Triple& { return p.position; }));
  xml += "      </Points>\n      <PointData Vectors=\"velocity\">\n";
  xml += data.array("velocity", "Float64", 3,
                    flat(snapshot, chosen, [](const Particle& p) -> const Triple& { return p.velocity; }));
  xml += data.array("angular_velocity", "Float64", 3,
                    flat(snapshot, chosen, [](const Particle& p) -> const Triple& { return p.angular_velocity; }));
  xml += data.array("radius", "Float64", 1, radius);
  xml += data.array("contacts", "Int32", 1, contacts);
  xml += data.array("id", "Int32", 1, id);
  // By all particles and not the chosen ones, so that all files of a run have the same arrays.
  if (densities_differ(kinds, snapshot.particles.size())) xml += data.array("density", "Float64", 1, density);
  if (kinds.has_species()) xml += data.array("species", "Int32", 1, species);
  xml += "      </PointData>\n      <Verts>\n";
  xml += data.array("connectivity", "Int64", 1, connectivity);
  xml += data.array("offsets", "Int64", 1, offsets);
  xml += fmt::format(
      "      </Verts>\n    </Piece>\n    <FieldData>\n"
      "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{:.12g}</DataArray>\n"
      "      <DataArray type=\"Int64\" Name=\"step\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n"
      "{}    </FieldData>\n  </PolyData>\n",
      snapshot.time, snapshot.step, gas);
  return xml + data.appended() + "</VTKFile>\n";
}

FrameWriter::FrameWriter(std::filesystem::path folder, const ParticleKinds& kinds, VtpData data,
                         std::vector<WrittenFrame> written)
    : folder_(std::move(folder)), kinds_(kinds), data_(data), written_(std::move(written)), flushed_(count()) {
  if (count() > 0) list();  // later ones may be in the list that is there
}

void FrameWriter::write(const Snapshot& snapshot) {
  if (written_.empty()) make_folder(folder_ / "frames");
  const std::string frame = encode_vtp(snapshot, kinds_, data_);
  write_file(frame_path(folder_, count()), frame, Durability::fast);
  RunningHash hash;
  hash.add(frame);
  written_.push_back({snapshot.time, {frame.size(), hash.value()}});
  list();
}

void FrameWriter::list() const {
  std::string pvd = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (int k = 0; k < count(); ++k)
    pvd += fmt::format("    <DataSet timestep=\"{:.12g}\" part=\"0\" file=\"{}\"/>\n",
                       written_[static_cast<std::size_t>(k)].time, frame_path("", k).string());
  pvd += "  </Collection>\n</VTKFile>\n";
  write_file(folder_ / "frames.pvd", pvd, Durability::fast);
}

void FrameWriter::flush() {
  if (flushed_ == count()) return;
  while (flushed_ < count()) flush_file(frame_path(folder_, flushed_++));
  flush_file(folder_ / "frames.pvd");
  flush_folder(folder_ / "frames");
}

}  // namespace fixdem::program

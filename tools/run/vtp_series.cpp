#include "vtp_series.hpp"

#include <fmt/format.h>

#include <utility>

#include "result_folder.hpp"

namespace fixdem::program {

VtpSeries::VtpSeries(std::filesystem::path folder, const char* name, std::vector<WrittenFrame> written)
    : folder_(std::move(folder)), name_(name), written_(std::move(written)), flushed_(count()) {
  if (count() > 0) list();  // later ones may be in the list that is there
}

void VtpSeries::write(double time, const std::string& bytes) {
  if (written_.empty()) make_folder(series_folder(folder_, name_));
  write_file(member_path(folder_, name_, count()), bytes, Durability::fast);
  RunningHash hash;
  hash.add(bytes);
  written_.push_back({time, {bytes.size(), hash.value()}});
  list();
}

void VtpSeries::list() const {
  std::string pvd = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (int k = 0; k < count(); ++k)
    pvd += fmt::format("    <DataSet timestep=\"{:.12g}\" part=\"0\" file=\"{}\"/>\n",
                       written_[static_cast<std::size_t>(k)].time, member_path("", name_, k).string());
  pvd += "  </Collection>\n</VTKFile>\n";
  write_file(series_list(folder_, name_), pvd, Durability::fast);
}

void VtpSeries::flush() {
  if (flushed_ == count()) return;
  while (flushed_ < count()) flush_file(member_path(folder_, name_, flushed_++));
  flush_file(series_list(folder_, name_));
  flush_folder(series_folder(folder_, name_));
}

}  // namespace fixdem::program

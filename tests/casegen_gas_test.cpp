// tools/casegen: inclined pipes, and gas that is more than one velocity and one density.
#include <doctest/doctest.h>

#include "casegen_line_cases.hpp"

using namespace casegen_test;

namespace {

const std::string inclined = "wall = true\ninclination = ";

std::string tilted(const std::string& angle, const std::string& text = good_case) {
  return replaced(text, "wall = true", inclined + angle);
}

/// The line with a gas that follows its pressure, and these keys of it.
std::string compressible(const std::string& lines = "", const std::string& text = line_case) {
  return with_gas("compressible = true\n" + lines, replaced(text, "density = 1.2\n", ""));
}

/// The same without a velocity.
std::string driven(const std::string& lines) { return replaced(compressible(lines), "bulk_velocity = 2.4\n", ""); }

}  // namespace

TEST_CASE("casegen: the inclination of the pipe sets gravity") {
  CHECK(members_of(tilted("0")) == members_of(good_case));
  const auto gravity = [](const std::string& angle) {
    const std::string header = printed(tilted(angle)), start = "gravity[3] = ";
    return header.substr(header.find(start) + start.size(),
                         header.find(" m/s2", header.find(start)) - header.find(start) - start.size());
  };
  check_contains(gravity("30"), {"0, -8.495709211, -4.905"});
  check_contains(gravity("-30"), {"0, -8.495709211, 4.905"});
  check_contains(gravity("90"), {"{0x0p+0, 0x0p+0, -0x1.39eb851eb851fp+3}"});
  check_contains(gravity("-90"), {"{0x0p+0, 0x0p+0, 0x1.39eb851eb851fp+3}"});
  check_contains(printed(tilted("30")), {"[pipe] inclination = 30\\012", "[run] gravity = [0, -8.495709211, -4.905]"});
  for (const std::string angle : {"90.5", "-91"})
    check_refused(tilted(angle), angle, {"inclination = ", "in [pipe] is out of range; allowed: -90 to 90", "degrees"});
  check_refused(replaced(tilted("0"), "duration = 1.2", "duration = 1.2\ngravity = [0, -9.81, 0]"), "gravity",
                {"[run] gravity = [0, -9.81, 0] together with [pipe] inclination; allowed: one of them", "1 error"});
  check_quiet(tilted("45", without_gas(good_case)));
  check_quiet(tilted("90", line_case));
}

TEST_CASE("casegen: the gap below which a slice is full") {
  const std::string header = printed(with_gas("full_gap = 0.0078125"));
  check_contains(header, {"double gas_full_gap = 0x1p-7;", "[gas] full_gap = 0.0078125"});
  check_lacks(printed(good_case), {"full_gap"});
  check_refused(with_gas("full_gap = 0.05"), "0.05\nbulk",
                {"[gas] full_gap = 0.05 leaves no free section; allowed: above 0 and below [pipe] diameter = 0.05"});
  check_refused(with_gas("full_gap = 0"), "0\nbulk", {"full_gap = 0 in [gas] is out of range; allowed: above 0"});
  check_refused(with_gas("full_gap = 0.01\nbed_height = \"strict\""), "0.01\nbed",
                {"full_gap = 0.01 with bed_height = \"strict\"; allowed: \"continuous\", \"hard\""});
  for (const std::string line : {"full_gap = 0.01", "bed_height = \"hard\""}) {
    check_refused(tilted("85", with_gas(line)), line.substr(line.find("= ") + 2) + "\nbulk",
                  {line.c_str(), "in a pipe steeper than 80 degrees", "the gas takes the whole section"});
    printed(tilted("75", with_gas(line)));
  }
}

TEST_CASE("casegen: a compressible gas has its density from pressure and temperature") {
  const std::string header = printed(compressible());
  check_contains(header,
                 {"bool gas_compressible = true;", "double gas_outlet_pressure = 0x1.8bcdp+16;",
                  "double gas_temperature = 0x1.2526666666666p+8;", "double gas_constant = 0x1.1f0f5c28f5c29p+8;",
                  "double gas_density = 0x1.34", "double gas_velocity = 0x1.3333333333333p+1;",
                  "[gas] compressible = true", "[gas] outlet_pressure = 101325", "[gas] temperature = 293.15"});
  check_lacks(header, {"[gas] density", "gas_storage", "gas_supply_volume", "gas_inlet_pressure", "gas_blower"});
  check_lacks(printed(line_case), {"compressible", "outlet_pressure", "temperature", "gas_constant", "storage"});
  CHECK(members_of(with_gas("compressible = false")) == members_of(good_case));
  check_contains(printed(compressible("outlet_pressure = 131072\ntemperature = 256\ngas_constant = 256")),
                 {"double gas_density = 0x1p+1;"});
  check_contains(printed(compressible("storage = true")),
                 {"bool gas_storage = true;", "double gas_supply_volume = 0x0p+0;", "[gas] storage = true"});
  check_contains(printed(compressible("supply_volume = 0.25")),
                 {"bool gas_storage = true;", "double gas_supply_volume = 0x1p-2;"});
  const std::string pressed = printed(driven("inlet_pressure = 131072"));
  check_contains(pressed,
                 {"double gas_inlet_pressure = 0x1p+17;", "bool gas_storage = true;", "gas_velocity = 0x0p+0;"});
  check_lacks(pressed, {"[gas] bulk_velocity"});
  check_contains(printed(driven("blower_flow = 0.0078125\nblower_pressure = 32768")),
                 {"double gas_blower_flow = 0x1p-7;", "double gas_blower_pressure = 0x1p+15;",
                  "bool gas_storage = true;", "double reference_speed = 0x1.fd"});  // of the flow through the section
}

TEST_CASE("casegen refuses gas that is given twice, not at all, or without what it needs") {
  check_refused(with_gas("compressible = true", line_case), "density = 1.2",
                {"[gas] density = 1.2 together with compressible = true; allowed: one of them", "it follows from"});
  check_refused(replaced(good_case, "density = 1.2\n", ""), "[gas]", {"missing key 'density' in [gas]", "1 error"});
  check_refused(replaced(good_case, "bulk_velocity = 2.4\n", ""), "[gas]", {"missing key 'bulk_velocity' in [gas]"});
  for (const std::string line :
       {"outlet_pressure = 1e5", "temperature = 300.0", "gas_constant = 300.0", "storage = true", "supply_volume = 0.5",
        "inlet_pressure = 2e5", "blower_flow = 0.5", "blower_pressure = 1e4"})
    check_refused(with_gas(line), line,
                  {line.substr(0, line.find(' ')).c_str(), "is not used here; allowed: only with compressible = true"});
  check_refused(compressible("inlet_pressure = 1.2e5"), "bulk_velocity",
                {"[gas] bulk_velocity = 2.4 together with inlet_pressure; allowed: one of them", "1 error"});
  check_refused(compressible("blower_flow = 0.01\nblower_pressure = 2e4"), "bulk_velocity",
                {"bulk_velocity = 2.4 together with a blower; allowed: one of them", "1 error"});
  check_refused(driven(""), "[gas]", {"missing key 'bulk_velocity' in [gas]"});
  check_refused(driven("blower_flow = 0.01"), "0.01\nkine",
                {"blower_flow = 0.01 without blower_pressure; allowed: both"});
  check_refused(driven("blower_pressure = 1e4"), "1e4", {"blower_pressure = 10000 without blower_flow"});
  check_refused(driven("inlet_pressure = 1.2e5\nblower_flow = 0.01\nblower_pressure = 2e4"), "1.2e5",
                {"inlet_pressure = 120000 together with a blower; allowed: one of them"});
  check_refused(
      driven("inlet_pressure = 2e4"), "2e4",
      {"inlet_pressure = 20000 is not above outlet_pressure = 101325; allowed: above it", "both are absolute"});
  check_refused(driven("inlet_pressure = 2e5\nsupply_volume = 0.5"), "0.5",
                {"[gas] supply_volume = 0.5 together with inlet_pressure", "remove it"});
  const std::string kept = "storage = false\n";
  check_refused(compressible(kept + "supply_volume = 0.5"), "false",
                {"storage = false with supply_volume; allowed: true"});
  check_refused(driven(kept + "inlet_pressure = 2e5"), "false", {"storage = false with inlet_pressure; allowed: true"});
  check_refused(driven(kept + "blower_flow = 0.01\nblower_pressure = 2e4"), "false", {"storage = false with a blower"});
  check_refused(compressible("temperature = 0"), "0\nbulk", {"temperature = 0 in [gas] is out of range", "above 0"});
  check_warned(compressible("temperature = 20.0"), "20.0", {"temperature = 20 in [gas] is not plausible", "293.15"});
}

TEST_CASE("casegen says whether gas of constant density is good enough for a pipe") {
  const auto long_line = [](const std::string& length, const std::string& text) {
    return replaced(text, "length = 0.800", "length = " + length);
  };
  check_quiet(long_line("5.0", line_case));
  check_warned(
      long_line("6.0", line_case), "6.0",
      {"[pipe] length = 6 with gas of constant density: plugs lose about 6 kPa over it, 6 % of the pressure at",
       "set [gas] compressible = true"});
  check_quiet(long_line("10.0", compressible()));
  check_warned(long_line("11.0", compressible()), "11.0",
               {"[pipe] length = 11 without storage", "set [gas] storage = true"});
  check_quiet(long_line("50.0", compressible("storage = true\nupdate_interval = 50")));
  check_warned(long_line("50.0", compressible("storage = true")), "true\nstorage",
               {"update_interval = 1 with storage", "set it to 50"});
  // Few particles lose little, and a periodic pipe is a piece of a line.
  check_quiet(long_line("6.0", replaced(line_case, "count = 2", "count = 2\ncapacity = 20")));
  check_quiet(long_line("50.0", replaced(good_case, "count = 2", "count = 200")));
  check_warned(compressible("", good_case), "true\n\nbulk", {"compressible = true with [pipe] ends = \"periodic\""});
}

// When a key has a meaning, and how that is put into words.
#include "schema.hpp"

namespace fixdem::casegen {

bool applies(When when, const CaseValues& v) {
  switch (when) {
    case When::always:
    case When::species_default:
      return true;
    case When::hertz:
      return v.normal == "hertz";
    case When::linear:
      return v.normal == "linear";
    case When::random:
      return !v.arrangement.empty();
    case When::from:
      return !v.start_from.empty();
    case When::no_species:
      return !v.has_species;
    case When::one_size:
      return !v.has_species && !v.has_distribution;
    case When::size_ends:
      return v.has_distribution && v.size_distribution != "table";
    case When::size_normal:
      return v.size_distribution == "normal";
    case When::size_lognormal:
      return v.size_distribution == "lognormal";
    case When::size_table:
      return v.size_distribution == "table";
    case When::line:
      return v.is_line();
    case When::velocity_given:
      return v.gas_inlet_pressure == 0 && !v.has_blower();
    case When::incompressible:
      return !v.gas_compressible;
    case When::compressible:
      return v.gas_compressible;
  }
  return true;
}

std::string describe(When when) {
  switch (when) {
    case When::always:
    case When::no_species:
    case When::one_size:
    case When::species_default:
    case When::velocity_given:
    case When::incompressible:
      return "";
    case When::hertz:
      return "normal = \"hertz\"";
    case When::linear:
      return "normal = \"linear\"";
    case When::random:
      return "arrangement = \"random\"";
    case When::from:
      return "from = \"another case\"";
    case When::size_ends:
      return R"(distribution = "uniform", "normal" or "lognormal")";
    case When::size_normal:
      return "distribution = \"normal\"";
    case When::size_lognormal:
      return "distribution = \"lognormal\"";
    case When::size_table:
      return "distribution = \"table\"";
    case When::line:
      return "[pipe] ends = \"open\"";
    case When::compressible:
      return "compressible = true";
  }
  return "";
}

}  // namespace fixdem::casegen

// Walks the TOML tree beside the table of keys (schema.hpp); the only file, with value_reader.hpp, that knows toml++.
#include "reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "nearest_name.hpp"
#include "plain_text.hpp"
#include "schema.hpp"
#include "shown.hpp"
#include "syntax_hint.hpp"
#include "value_reader.hpp"

namespace fixdem::casegen {
namespace {

/// Reads one file; a class only to keep the report and the result at hand.
class Reader {
 public:
  Reader(Reading& reading, Report& report) : reading_(reading), report_(report) {}

  void read(const toml::table& root) {
    for (const auto& [key, node] : root) {
      const std::string name(key.str());
      if (const auto* rule = find_key("", name)) {
        read_value(*rule, "", key, node, reading_.values);
      } else if (find_table(name) == nullptr || is_part(name)) {
        refuse_unknown_table(name, place_of(key.source()));
      }
    }
    for (const auto& table : tables()) {
      if (is_part(table.name)) continue;  // read with the table it belongs to
      if (const toml::node* node = root.get(table.name)) {
        read_node(table, *node);
      } else if (is_needed(table, reading_.values)) {
        if (!misspelt_.contains(table.name))
          report_.error({}, fmt::format("missing table [{}]: {}", table.name, table.meaning),
                        "add it, with " + fmt::format("{}", fmt::join(names_in(table.name, true), ", ")));
        for (const auto& rule : case_keys())
          if (rule.table == table.name) reading_.unusable.insert(full_name(rule));
      }
    }
    reading_.values.has_gas = reading_.tables.contains("gas");
    reading_.values.has_species = reading_.tables.contains("particles.species");
    reading_.values.has_distribution = reading_.tables.contains("particles.sizes");
  }

 private:
  static std::string full_name(const Key& key) { return key.table + "." + key.name; }

  static bool is_part(std::string_view table) { return table.find('.') != std::string_view::npos; }

  template <class Record>
  static void add_names(std::span<const Rule<Record>> keys, std::string_view table, bool only_required,
                        std::vector<std::string>& names) {
    for (const auto& rule : keys)
      if (rule.table == table && (rule.required || !only_required)) names.push_back(rule.name);
  }

  static std::vector<std::string> names_in(std::string_view table, bool only_required = false) {
    std::vector<std::string> names;
    add_names(case_keys(), table, only_required, names);
    add_names(species_keys(), table, only_required, names);
    add_names(placed_keys(), table, only_required, names);
    add_names(probe_keys(), table, only_required, names);
    for (const auto& part : tables())
      if (part.is_part_of(table) && !only_required) names.push_back(part.last_name());
    if (table == "start" && only_required) names = {"one of arrangement = \"random\"", "from", "[[start.particle]]"};
    return names;
  }

  void refuse_unknown_table(const std::string& name, Place place) {
    std::vector<std::string> names{"title"};
    for (const auto& table : tables())
      if (!is_part(table.name)) names.push_back(table.name);
    const std::string nearest = nearest_known(name, names);
    misspelt_.insert(nearest);
    report_.error(place, fmt::format("unknown table or key '{}' at the top of the file", shown(name)),
                  suggestion(nearest, home_of(name), names));
  }

  /// Returns the key that was probably meant, so that it is not reported as missing as well; or "".
  std::string refuse_unknown_key(const std::string& table, const std::string& name, Place place) {
    const auto names = names_in(table);
    std::string nearest = nearest_known(name, names);
    report_.error(place, fmt::format("unknown key '{}' in {}", shown(name), table_title(table)),
                  suggestion(nearest, home_of(name), names));
    return nearest;
  }

  /// For the first unknown names: after so many something else is wrong than the spelling.
  std::string nearest_known(const std::string& name, const std::vector<std::string>& names) {
    constexpr int most = 100;
    return ++unknown_ <= most ? nearest_name(name, names) : "";
  }

  /// The tables that do have a key of this name.
  static std::string home_of(std::string_view name) {
    std::vector<std::string> homes;
    for (const auto& rule : case_keys())
      if (rule.name == name && !rule.table.empty()) homes.push_back(table_title(rule.table));
    return fmt::format("{}", fmt::join(homes, " or "));
  }

  static std::string suggestion(const std::string& nearest, const std::string& home,
                                const std::vector<std::string>& names) {
    std::string words;
    if (!home.empty())
      words = fmt::format("it belongs in {}; ", home);
    else if (!nearest.empty())
      words = fmt::format("did you mean '{}'? ", nearest);
    return words + fmt::format("allowed: {}", fmt::join(names, ", "));
  }

  void read_table(const std::string& name, const toml::node& node) {
    const Place place = place_of(node.source());
    reading_.tables[name] = place;
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      report_.error(place, fmt::format("'{}' is {}, but must be a table", name, written_type(node)),
                    fmt::format("write [{}] on a line of its own and its keys below", name));
      for (const auto& rule : case_keys())
        if (rule.table == name) reading_.unusable.insert(full_name(rule));
      return;
    }
    for (const auto& [key, value] : *table) {
      const std::string key_name(key.str());
      if (const TableRule* part = find_table(fmt::format("{}.{}", name, key_name))) {
        read_node(*part, value);
      } else if (const auto* rule = find_key(name, key_name)) {
        read_value(*rule, name + ".", key, value, reading_.values);
      } else {
        const std::string meant = refuse_unknown_key(name, key_name, place_of(key.source()));
        if (!table->contains(meant)) reading_.unusable.insert(fmt::format("{}.{}", name, meant));
      }
    }
    for (const auto& rule : case_keys())
      if (rule.table == name && rule.required && rule.when == When::always && !table->contains(rule.name))
        refuse_missing(rule, name + ".", place);
  }

  void refuse_missing(const Key& rule, const std::string& prefix, Place place) {
    if (reading_.unusable.contains(prefix + rule.name)) return;
    report_.error(place, fmt::format("missing key '{}' in {}: {}", rule.name, table_title(rule.table), rule.meaning),
                  rule.advice);
    reading_.unusable.insert(prefix + rule.name);
  }

  void read_node(const TableRule& table, const toml::node& node) {
    if (table.name == "start.particle")
      read_list(table, node, placed_keys(), reading_.values.placed, "particle");
    else if (table.name == "particles.species")
      read_list(table, node, species_keys(), reading_.values.species, "kind");
    else if (table.name == "probe")
      read_list(table, node, probe_keys(), reading_.values.probes, "station");
    else
      read_table(table.name, node);
  }

  /// One table for each record; `noun`: what a record is.
  template <class Record>
  void read_list(const TableRule& list, const toml::node& node, std::span<const Rule<Record>> keys,
                 std::vector<Record>& records, const char* noun) {
    const std::string title = table_title(list.name);
    const toml::array* entries = node.as_array();
    reading_.tables[list.name] = place_of(node.source());
    if (entries == nullptr) {
      const std::string where =
          is_part(list.name) ? fmt::format(" in [{}]", list.name.substr(0, list.name.find('.'))) : "";
      report_.error(place_of(node.source()), fmt::format("'{}'{} must be a list of tables", list.last_name(), where),
                    fmt::format("write {}, with two pairs of brackets, before each {}", title, noun));
      reading_.unusable.insert(list.name);
      return;
    }
    for (const toml::node& entry : *entries) {
      const Place place = place_of(entry.source());
      const std::string own = fmt::format("{}.{}", list.name, records.size()), prefix = own + ".";
      reading_.tables[own] = place;
      records.emplace_back();
      const toml::table* table = entry.as_table();
      if (table == nullptr) {
        const auto needed = std::find_if(keys.begin(), keys.end(), [](const auto& rule) { return rule.required; });
        report_.error(place, fmt::format("an entry of {} is {}, but must be a table", title, written_type(entry)),
                      fmt::format("write {} and below it {}, and so on", title, needed->name));
        reading_.unusable.insert(list.name);
        continue;
      }
      for (const auto& [key, value] : *table) {
        const std::string name(key.str());
        const auto rule = std::find_if(keys.begin(), keys.end(), [&](const auto& r) { return r.name == name; });
        if (rule != keys.end())
          read_value(*rule, prefix, key, value, records.back());
        else
          reading_.unusable.insert(prefix + refuse_unknown_key(list.name, name, place_of(key.source())));
      }
      for (const auto& rule : keys)
        if (rule.required && !table->contains(rule.name)) refuse_missing(rule, prefix, place);
    }
  }

  template <class Record>
  void read_value(const Rule<Record>& rule, const std::string& prefix, const toml::key& key, const toml::node& node,
                  Record& record) {
    const std::string name = prefix + rule.name;
    reading_.given[name] = {place_of(key.source()), place_of(node.source()), written(node)};
    const std::string problem = assign(rule, node, record);
    const std::string where = rule.table.empty() ? "at the top of the file" : "in " + table_title(rule.table);
    if (problem.empty()) {
      if (!rule.is_plausible(record))
        report_.warning(place_of(node.source()),
                        fmt::format("{} = {} {} is not plausible; plausible: {} {}", rule.name, written(node), where,
                                    rule.plausible(), rule.unit),
                        rule.advice + "; if the value is meant, leave it");
      return;
    }
    report_.error(place_of(node.source()),
                  fmt::format("{} = {} {} {}; allowed: {}", rule.name, written(node), where, problem, rule.allowed()),
                  rule.advice);
    reading_.unusable.insert(name);
  }

  Reading& reading_;
  Report& report_;
  int unknown_ = 0;
  std::set<std::string> misspelt_;  // tables that were probably meant by an unknown name
};

}  // namespace

Place Reading::place(const std::string& key) const {
  if (const auto found = given.find(key); found != given.end()) return found->second.value;
  const auto table = tables.find(key.substr(0, key.rfind('.')));
  return table != tables.end() ? table->second : Place{};
}

std::string Reading::quote(const std::string& key) const {
  const auto dot = key.rfind('.');
  std::string table = key.substr(0, dot);
  const std::string list = table.substr(0, table.rfind('.'));
  if (find_table(table) == nullptr && find_table(list) != nullptr) table = list;  // without the number of the entry
  const auto found = given.find(key);
  return fmt::format("{} {} = {}", table_title(table), key.substr(dot + 1),
                     found != given.end() ? found->second.text : "(default)");
}

Reading read_case(std::string_view text, std::string_view file, Report& report) {
  Reading reading;
  if (const auto objection = objection_to(text)) {
    report.error(objection->place, objection->message, objection->advice);
    return reading;
  }
  try {
    const toml::table root = toml::parse(text, file);
    Reader(reading, report).read(root);
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source());
    report.error(place, shown(error.description(), 200), syntax_hint(text, place, error.description()));
  } catch (const std::invalid_argument&) {
    report.error({}, "the file cannot be parsed, for a reason that the parser does not tell", syntax_hint("", {}, ""));
  }
  return reading;
}

}  // namespace fixdem::casegen

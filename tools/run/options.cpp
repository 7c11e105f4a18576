#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "failure.hpp"
#include "schedule.hpp"

namespace fixdem::program {
namespace {

std::string version_text(const CaseFacts& facts, const SimulationView& view) {
  std::string text = fmt::format("fixdem {}\ncase:            {} ({}, xxh64 {:016x})\n", program_version, facts.name,
                                 facts.source, facts.source_hash);
  text += fmt::format("title:           {}\nparticles:       {}{}\nfeatures:       ", facts.title,
                      facts.line.is_open ? "at most " : "", facts.particle_count);
  for (const std::string& feature : features(facts)) text += " " + feature;
  text += "\ncapacities:     ";
  for (const CapacityUse& use : view.capacities()) text += fmt::format(" {} {};", use.name, use.limit);
  text += fmt::format("\ninstruction set: {}\nprecision:       {}\ncompiler:        {}\n", facts.instruction_set,
                      precision_name(facts.precision), facts.compiler);
  return text;
}

/// A check for CLI11, which would take -1 for 18446744073709551615.
std::string is_whole_number(const std::string& text) {
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::string() : fmt::format("'{}' is not a whole number, zero or more", text);
}

}  // namespace

std::optional<Options> read_options(const CaseFacts& facts, const SimulationView& view, int argc, char** argv) {
  Options options;
  options.out = std::filesystem::path("out") / facts.name;
  options.seed = facts.seed;
  options.duration = facts.duration;
  options.checkpoint_interval = facts.checkpoint_interval;

  CLI::App app(fmt::format("{}\nfixdem program of the case {} ({})", facts.title, facts.name, facts.source));
  bool no_frames = false;
  std::string out, start_state, resume_from;
  app.add_option("--out", out, fmt::format("folder for all results (default {})", options.out.string()))
      ->type_name("DIR");
  auto* seed = app.add_option("--seed", options.seed, fmt::format("seed of the random start (default {})", facts.seed))
                   ->type_name("N")
                   ->check(is_whole_number);
  auto* duration = app.add_option("--duration", options.duration,
                                  fmt::format("simulated time in seconds (default {})", facts.duration))
                       ->type_name("S");
  app.add_option("--start-state", start_state,
                 facts.start == StartKind::from
                     ? fmt::format("final.fixdem to start from (default DIR/../{}/final.fixdem)", facts.start_from)
                     : std::string("final.fixdem to start from; only for cases with [start] from"))
      ->type_name("FILE");
  app.add_flag("--resume", options.resume, "go on from the latest checkpoint in the folder");
  app.add_option("--resume-from", resume_from, "go on from this checkpoint")->type_name("FILE");
  auto* extend = app.add_option("--extend", options.extension,
                                "go on with the finished run in the folder, for so many seconds more")
                     ->type_name("S");
  auto* fresh = app.add_flag("--fresh", options.fresh,
                             "begin anew; results that lie in the folder are moved aside, to DIR.1, DIR.2, ...");
  auto* replace = app.add_flag("--replace", options.replace, "begin anew; results that lie in the folder are deleted");
  fresh->excludes(replace);
  bool drop_checkpoint = false;
  app.add_flag("--drop-checkpoint", drop_checkpoint,
               "keep no checkpoint once the run is done: less space, but it cannot be extended then");
  auto* interval = app.add_option("--checkpoint-interval", options.checkpoint_interval,
                                  "simulated time between checkpoints in seconds (default: [output] "
                                  "checkpoint_interval, or once a minute by the clock)")
                       ->type_name("S");
  app.add_flag("--quiet", options.quiet, "no table, no progress; errors only");
  app.add_flag("--watch", options.watch, "a live picture of the pipe instead of the table; only on a terminal");
  app.add_flag("--no-frames", no_frames, "write no frames, no dump and no files of contacts");
  app.set_version_flag(
      "--version", [&] { return version_text(facts, view); }, "what is compiled into this program");
  app.footer(
      "Results: log.csv, frames.pvd, frames/, final.fixdem, summary.json; of a line plugs.csv, slices.bin, "
      "probe_N.csv;\n"
      "checkpoint-STEP.fixdem, to go on from.\nExit "
      "codes: 0 done, 2 wrong usage, "
      "3 bad case or input, 4 capacity exceeded,\n5 unstable or non-finite, 6 input/output, 128 + signal.");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    return std::nullopt;
  } catch (const CLI::CallForVersion&) {
    std::fputs(version_text(facts, view).c_str(), stdout);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw Failure(exit_wrong_usage, fmt::format("{}\n  --help lists the options", error.what()));
  }

  if (app.get_option("--out")->count() > 0) {
    if (out.empty()) throw Failure(exit_wrong_usage, "--out needs the name of a folder");
    options.out = out;
  }
  options.frames = !no_frames;
  if (!start_state.empty()) options.start_state = start_state;
  if (!resume_from.empty()) options.resume_from = resume_from;
  options.keeps_checkpoint = !drop_checkpoint;
  options.resume = options.resume || options.resume_from || extend->count() > 0;
  options.seed_is_given = seed->count() > 0;
  options.duration_is_given = duration->count() > 0;
  if (options.resume && (options.fresh || options.replace))
    throw Failure(exit_wrong_usage, fmt::format("{} begins anew: --resume, --resume-from and --extend go on",
                                                options.fresh ? "--fresh" : "--replace"));
  if (extend->count() > 0 && duration->count() > 0)
    throw Failure(exit_wrong_usage,
                  "--extend is added to the duration of the run, --duration is the whole: give one of them");
  if (const double more = options.extension / facts.time_step;
      extend->count() > 0 && !(more >= 0.5 && more < most_steps))
    throw Failure(exit_wrong_usage,
                  fmt::format("--extend {}: a time in seconds is needed, from one step ({} s) to {:.0e} steps ({:g} s)",
                              options.extension, facts.time_step, most_steps, most_steps * facts.time_step));
  if (interval->count() > 0 && !(options.checkpoint_interval >= facts.time_step))
    throw Failure(exit_wrong_usage,
                  fmt::format("--checkpoint-interval {}: a time in seconds is needed, one step ({} s) "
                              "or more; inf for none but on signals",
                              options.checkpoint_interval, facts.time_step));
  if (seed->count() > 0 && facts.start != StartKind::random)
    throw Failure(
        exit_wrong_usage,
        fmt::format("--seed: the case {} has no random start\n  {}", facts.name,
                    facts.start == StartKind::from
                        ? fmt::format("give the seed to {}, whose final state it starts from", facts.start_from)
                        : std::string("its particles are placed one by one")));
  if (options.start_state && facts.start != StartKind::from)
    throw Failure(exit_wrong_usage,
                  fmt::format("--start-state: the case {} does not start from another case's state\n  write [start] "
                              "from = \"other_case\" in {}",
                              facts.name, facts.source));
  if (!is_possible_duration(options.duration, facts.time_step)) {
    const bool given = duration->count() > 0;
    throw Failure(given ? exit_wrong_usage : exit_bad_input,
                  fmt::format("{} {}: a time in seconds, zero or more and below {:.3g} ({:.0e} steps), is needed",
                              given ? "--duration" : fmt::format("{}: [run] duration =", facts.source),
                              options.duration, most_steps * facts.time_step, most_steps));
  }
  return options;
}

}  // namespace fixdem::program

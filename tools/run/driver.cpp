#include "driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <system_error>

#include "failure.hpp"
#include "folder_lock.hpp"
#include "found_run.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "result_folder.hpp"
#include "schedule.hpp"
#include "start.hpp"
#include "time_loop.hpp"

namespace fixdem::program {
namespace {

namespace files = std::filesystem;

void say(const std::string& message) {
  std::fflush(stdout);
  std::fputs(("fixdem: " + message + "\n").c_str(), stderr);
}

int complain(int code, const std::string& message) {
  say(message);
  return code;
}

/// A run from its beginning. Results that lie in the folder are never lost without a word.
class Beginning {
 public:
  Beginning(SimulationView& view, const CaseFacts& facts, Options options, bool resumes = false)
      : view_(view), facts_(facts), options_(std::move(options)), resumes_(resumes) {}

  int run() {
    options_.start_hash = start_state_hash(facts_, options_);
    if (files::is_directory(options_.out) && is_done_already()) return exit_done;
    start_simulation(view_, facts_, options_);
    if (!lock_) {
      make_folder(options_.out);
      if (is_done_already()) return exit_done;  // by another program meanwhile
    }
    if (options_.fresh && holds_results(options_.out)) {
      const files::path aside = move_aside(options_.out);
      say(fmt::format("the results that lay in {} are in {} now", options_.out.string(), aside.string()));
    }
    prepare_folder(options_.out);
    catch_interrupts();
    return TimeLoop(view_, facts_, options_).run();
  }

 private:
  /// Takes the folder. Whether the very run that is asked for lies there; another one that may not go is refused.
  bool is_done_already() {
    lock_.emplace(options_.out);
    if (options_.fresh || options_.replace) return false;
    const FoundRun there = find_run(options_.out, facts_.time_step);
    if (!there.is_there || (resumes_ && !there.checkpoint && there.identity.empty())) return false;
    const std::string what = differences(there, facts_, view_, options_);
    const std::string out = options_.out.string();
    std::string advice =
        "\n  begin anew with --fresh, which moves it to a numbered folder beside (with make: FRESH=1), or choose "
        "another "
        "--out";
    if (there.is_finished && what.empty()) {
      if (there.checkpoint)
        if (const std::string damage = difference(options_, there.checkpoint->checkpoint.outputs); !damage.empty())
          throw Failure(exit_input_output, fmt::format("{} holds {}, but {}{}", out, there.words, damage, advice));
      say(fmt::format("the run in {} is done already; --fresh (with make: FRESH=1) makes it once more", out));
      return true;
    }
    if (there.identity.empty() && checkpoints_in(options_.out).empty())
      advice = "\n  nothing there can be gone on with: --resume (with make: RESUME=1) begins that run again" + advice;
    if (there.checkpoint && differences(there, facts_, view_).empty())
      advice = fmt::format("\n  go on with it by --resume{}{}",
                           there.is_finished ? " and a longer --duration, or by --extend (with make: EXTEND=seconds)"
                                             : " (with make: RESUME=1)",
                           advice);
    throw Failure(exit_input_output, fmt::format("{} holds {}{}{}", out, there.words, what, advice));
  }

  SimulationView& view_;
  const CaseFacts& facts_;
  Options options_;
  bool resumes_;  ///< but there was nothing to go on with
  std::optional<FolderLock> lock_;
};

/// The duration that a run of `there` seconds is to have; `case_there`: what its case said. Never shorter.
double wanted_duration(const CaseFacts& facts, const Options& options, double there, double case_there,
                       const std::string& where) {
  double wanted = there;
  if (options.extension > 0)  // 0.2 and 0.1 are 0.3, as if they had been written so
    wanted = std::strtod(fmt::format("{:.15g}", there + options.extension).c_str(), nullptr);
  else if (options.duration_is_given)
    wanted = options.duration;
  else if (facts.duration != case_there)  // the case file has been changed
    wanted = facts.duration;
  if (!is_possible_duration(wanted, facts.time_step))
    throw Failure(exit_wrong_usage, fmt::format("a duration of {} s is more than {:.0e} steps", wanted, most_steps));
  if (steps_of(wanted, facts.time_step) < steps_of(there, facts.time_step))
    throw Failure(exit_wrong_usage,
                  fmt::format("cannot go on with {}: its run has a duration of {} s, and {} {} is asked for\n"
                              "  it can be made longer, not shorter; begin anew with --fresh",
                              where, there, options.duration_is_given ? "--duration" : "[run] duration =", wanted));
  return wanted;
}

/// Goes on from a checkpoint.
int go_on(SimulationView& view, const CaseFacts& facts, Options options, const Identity& here, Resumable from) {
  Checkpoint& checkpoint = from.checkpoint;
  const std::string name = from.path.string();
  const auto refuse_damaged = [&](const std::string& what) {
    throw Failure(exit_bad_input,
                  fmt::format("{} is damaged: {}{}", name, what, offer_older(from.path, here, options)));
  };
  if (checkpoint.simulation.size() != view.memory().size()) refuse_damaged("its simulation has another size");
  std::copy(checkpoint.simulation.begin(), checkpoint.simulation.end(), view.memory().begin());
  if (!view.is_consistent() || view.step() != checkpoint.step)
    refuse_damaged("its simulation is none: a number in it leads nowhere");
  options.seed = checkpoint.seed, options.frames = checkpoint.frames, options.start_hash = checkpoint.start;
  catch_interrupts();
  if (options.duration != checkpoint.duration) {
    if (const std::string what = difference(options, checkpoint.outputs); !what.empty())
      throw Failure(exit_bad_input,
                    fmt::format("cannot resume: {}\n  put back what it was, or begin anew with --fresh", what));
    // From here on it is a longer run: should it be stopped, --resume goes on to the new end.
    checkpoint.duration = options.duration;
    write_file(checkpoint_path(options.out, checkpoint.step), encode_checkpoint(checkpoint), Durability::durable);
  }
  std::optional<TimeLoop> loop;
  try {
    loop.emplace(view, facts, options, &from);
  } catch (const Failure& failure) {
    if (failure.code() != exit_bad_input) throw;
    throw Failure(exit_bad_input, failure.what() + offer_older(from.path, here, options));
  }
  if (!options.quiet) say(fmt::format("resumed at {:.6g} s, step {}, from {}", view.time(), view.step(), name));
  return loop->run();
}

/// A finished run in the folder: nothing to do, or an extension.
int go_on_with_finished(SimulationView& view, const CaseFacts& facts, Options options, FoundRun there) {
  const std::string out = options.out.string();
  if (const std::string what = differences(there, facts, view); !what.empty())
    throw Failure(exit_bad_input,
                  fmt::format("cannot resume: {} holds {}, which is of another program than this one:{}\n"
                              "  begin anew with --fresh, or choose another --out",
                              out, there.words, what));
  check_options(options, out, there.seed, there.frames, there.start);
  const Identity here = identity(facts, view);
  std::optional<Resumable> from;
  if (options.resume_from || there.checkpoint) from = find_checkpoint(here, options);
  const double case_there = from ? from->checkpoint.case_duration : facts.duration;
  options.duration = wanted_duration(facts, options, there.duration, case_there, out);
  if (options.duration == there.duration) {
    say(fmt::format("the run in {} is done already: nothing to resume", out));
    return exit_done;
  }
  if (!from)
    throw Failure(exit_bad_input, fmt::format("{} holds {}, whose checkpoint has not been kept: it cannot be extended\n"
                                              "  begin anew with --fresh",
                                              out, there.words));
  return go_on(view, facts, options, here, std::move(*from));
}

int resume(SimulationView& view, const CaseFacts& facts, Options options) {
  const std::string out = options.out.string();
  if (options.start_state) options.start_hash = start_state_hash(facts, options);
  if (!files::is_directory(options.out)) {
    if (options.resume_from || options.extension > 0)
      throw Failure(exit_input_output, fmt::format("there is no folder {} with a run to go on with", out));
  } else {
    const FolderLock lock(options.out);
    FoundRun there = find_run(options.out, facts.time_step);
    if (there.is_finished) return go_on_with_finished(view, facts, options, std::move(there));
    const Identity here = identity(facts, view);
    if (auto found = find_checkpoint(here, options)) {
      if (options.extension > 0)
        throw Failure(exit_wrong_usage,
                      fmt::format("--extend is for finished runs, and {} holds {}\n  bring it to its end with --resume "
                                  "first, or give the whole --duration with --resume",
                                  out, there.words));
      const Checkpoint& c = found->checkpoint;
      options.duration = wanted_duration(facts, options, c.duration, c.case_duration, found->path.string());
      return go_on(view, facts, options, here, std::move(*found));
    }
    if (options.extension > 0)
      throw Failure(exit_input_output, fmt::format("there is no finished run in {} to extend", out));
    if (!there.identity.empty())  // it has come to a moment that cannot be gone on from
      throw Failure(exit_bad_input,
                    fmt::format("cannot resume: there is no checkpoint in {}, but {}\n  begin anew with "
                                "--fresh, or choose another --out",
                                out, there.words));
  }
  say(fmt::format("there is no checkpoint in {}: the run begins at its beginning", out));
  return Beginning(view, facts, options, true).run();
}

int run(SimulationView& view, const CaseFacts& facts, int argc, char** argv) {
  const auto options = read_options(facts, view, argc, argv);
  if (!options) return exit_done;
  return options->resume ? resume(view, facts, *options) : Beginning(view, facts, *options).run();
}

}  // namespace

int run_program(SimulationView& view, const CaseFacts& facts, int argc, char** argv) noexcept {
  prepare_process();
  int code;
  try {
    code = run(view, facts, argc, argv);
  } catch (const Failure& failure) {
    code = complain(failure.code(), failure.what());
  } catch (const std::system_error& error) {
    code = complain(exit_input_output, error.what());
  } catch (const std::exception& error) {
    code = complain(exit_input_output, std::string("cannot go on: ") + error.what());
  }
  // A full disk behind a redirected table is an error; a reader that has gone away (`| head`) is not.
  if (std::fflush(stdout) != 0 && errno != EPIPE && code == exit_done)
    code = complain(exit_input_output, "cannot write the table to standard output");
  return code;
}

}  // namespace fixdem::program

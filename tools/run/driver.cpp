#include "driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <system_error>

#include "checkpoint_keeper.hpp"
#include "failure.hpp"
#include "folder_lock.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "result_folder.hpp"
#include "start.hpp"
#include "time_loop.hpp"

namespace fixdem::program {
namespace {

void say(const std::string& message) {
  std::fflush(stdout);
  std::fputs(("fixdem: " + message + "\n").c_str(), stderr);
}

int complain(int code, const std::string& message) {
  say(message);
  return code;
}

int begin_run(SimulationView& view, const CaseFacts& facts, const Options& options) {
  start_simulation(view, facts, options);
  make_folder(options.out);
  const FolderLock lock(options.out);
  if (!options.quiet && !checkpoints_in(options.out).empty())
    say(fmt::format("note: the unfinished run in {} is replaced; --resume would have gone on with it",
                    options.out.string()));
  prepare_folder(options.out);
  catch_interrupts();
  return TimeLoop(view, facts, options).run();
}

int go_on(SimulationView& view, const CaseFacts& facts, Options options, const Identity& here, const Resumable& from) {
  const std::string& bytes = from.checkpoint.simulation;
  if (bytes.size() != view.memory().size())
    throw Failure(exit_bad_input, from.path.string() + " is damaged: its simulation has another size");
  std::copy(bytes.begin(), bytes.end(), view.memory().begin());
  options.duration = from.checkpoint.duration, options.seed = from.checkpoint.seed;
  options.frames = from.checkpoint.frames;
  catch_interrupts();
  std::optional<TimeLoop> loop;
  try {
    loop.emplace(view, facts, options, &from);
  } catch (const Failure& failure) {
    if (failure.code() != exit_bad_input) throw;
    throw Failure(exit_bad_input, failure.what() + offer_older(from.path, here, options));
  }
  if (!options.quiet)
    say(fmt::format("resumed at {:.6g} s, step {}, from {}", view.time(), view.step(), from.path.string()));
  return loop->run();
}

int run(SimulationView& view, const CaseFacts& facts, int argc, char** argv) {
  const auto options = read_options(facts, view, argc, argv);
  if (!options) return exit_done;
  if (!options->resume) return begin_run(view, facts, *options);
  if (std::filesystem::exists(options->out)) {
    const FolderLock lock(options->out);
    const Identity here = identity(facts, view);
    if (const auto found = find_checkpoint(here, *options)) return go_on(view, facts, *options, here, *found);
    if (is_done_already(facts, *options)) {
      say(fmt::format("the run in {} is done already: nothing to resume", options->out.string()));
      return exit_done;
    }
  }
  say(fmt::format("there is no checkpoint in {}: the run begins at its beginning", options->out.string()));
  return begin_run(view, facts, *options);
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

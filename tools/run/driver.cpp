#include "driver.hpp"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>

#include "failure.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "start.hpp"
#include "time_loop.hpp"

namespace fixdem::program {
namespace {

int complain(int code, const std::string& message) {
  std::fflush(stdout);
  std::fputs(("fixdem: " + message + "\n").c_str(), stderr);
  return code;
}

int run(SimulationView& view, const CaseFacts& facts, int argc, char** argv) {
  const auto options = read_options(facts, view, argc, argv);
  if (!options) return exit_done;
  start_simulation(view, facts, *options);
  prepare_folder(options->out);
  catch_interrupts();
  return TimeLoop(view, facts, *options).run();
}

}  // namespace

int run_program(SimulationView& view, const CaseFacts& facts, int argc, char** argv) noexcept {
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

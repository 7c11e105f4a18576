// The test program's entry: doctest's own command line, and one addition. When a check fails, the scene it happened in
// is printed: the case, the seed, and the command that runs this test alone with the same random numbers.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "support.hpp"

namespace fixdem::tests {

namespace {
Scene current{"none", 0};
std::string program;
std::string running_test;
}  // namespace

unsigned long long seed() {
  const char* chosen = std::getenv("FIXDEM_SEED");
  return chosen != nullptr ? std::strtoull(chosen, nullptr, 10) : 1;
}

void enter(Scene scene) { current = scene; }

namespace {

struct FailureReport : doctest::IReporter {
  explicit FailureReport(const doctest::ContextOptions&) {}
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats&) override {}
  void test_case_start(const doctest::TestCaseData& test) override {
    current = {"none", 0};
    running_test = test.m_name;
  }
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {}
  void test_case_exception(const doctest::TestCaseException&) override { print(); }
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData& assertion) override {
    if (assertion.m_failed) print();
  }
  void log_message(const doctest::MessageData& message) override {
    if (message.m_severity != doctest::assertType::is_warn) print();
  }
  void test_case_skipped(const doctest::TestCaseData&) override {}

  static void print() {
    std::string name;  // doctest separates filters by commas and knows * and ?
    for (char c : running_test) name += (c == ',' || c == '\'') ? '?' : c;
    std::fflush(stdout);
    std::fprintf(stderr, "  case %s, seed %llu; alone: FIXDEM_SEED=%llu %s --test-case='%s'\n", current.case_name,
                 current.seed, seed(), program.c_str(), name.c_str());
  }
};

REGISTER_LISTENER("failure_report", 1, FailureReport);

}  // namespace
}  // namespace fixdem::tests

int main(int argc, char** argv) {
  fixdem::tests::program = argv[0];
  doctest::Context context(argc, argv);
  return context.run();
}

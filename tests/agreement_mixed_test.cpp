// Kernel in mixed precision against the reference, which computes in double, on the real scenes, 1000 steps.
#include "agreement_scenes.hpp"
#include "mixed.hpp"

namespace fixdem::tests {
namespace {

TEST_CASE("mixed agreement: a settled bed") { check_settled_bed<in_mixed_precision<short_bed>>(); }
TEST_CASE("mixed agreement: the agitated start of pipe_bed") {
  check_agitated_start<in_mixed_precision<cases::pipe_bed>>();
}
TEST_CASE("mixed agreement: a plug with gas") { check_plug<in_mixed_precision<cases::plug_u24>>(); }

}  // namespace
}  // namespace fixdem::tests

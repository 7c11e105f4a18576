// Kernel against reference on the real scenes, 1000 steps.
#include "agreement_scenes.hpp"

namespace fixdem::tests {
namespace {

TEST_CASE("agreement: a settled bed") { check_settled_bed<short_bed>(); }
TEST_CASE("agreement: the agitated start of pipe_bed") { check_agitated_start<cases::pipe_bed>(); }
TEST_CASE("agreement: a plug with gas") { check_plug<cases::plug_u24>(); }

}  // namespace
}  // namespace fixdem::tests

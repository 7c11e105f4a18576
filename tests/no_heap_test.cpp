// The kernel allocates nothing. Every way to the heap is counted: operator new everywhere, and malloc and its relatives
// where the C library lets a program replace them (glibc, without a sanitizer, which replaces them itself).
#include <cstdlib>
#include <new>
#include <vector>

#include "cases/plug_u24.hpp"
#include "kernel/fixdem.hpp"
#include "line_scenes.hpp"
#include "small_scene.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FIXDEM_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define FIXDEM_SANITIZED
#endif
#if defined(__GLIBC__) && !defined(FIXDEM_SANITIZED)
#define FIXDEM_REPLACES_MALLOC
#endif

namespace {
#if defined(FIXDEM_REPLACES_MALLOC)
constexpr bool replaces_malloc = true;
#else
constexpr bool replaces_malloc = false;
#endif
volatile long long allocations = 0;
void count_allocation() { allocations = allocations + 1; }
}  // namespace

#if defined(FIXDEM_REPLACES_MALLOC)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) noexcept {
  count_allocation();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  count_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) noexcept {
  count_allocation();
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  count_allocation();
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  count_allocation();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** result, std::size_t alignment, std::size_t size) noexcept {
  count_allocation();
  *result = __libc_memalign(alignment, size);
  return *result == nullptr ? 12 : 0;  // ENOMEM
}
void free(void* memory) noexcept { __libc_free(memory); }
}
#endif

void* operator new(std::size_t size) {
  count_allocation();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  count_allocation();
  const auto step = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}
// The library's form that returns null would come with its own allocator, and the address sanitizer object to the pair.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  count_allocation();
  return std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace fixdem::tests {
namespace {

struct gas_scene : cases::plug_u24 {
  static constexpr int particle_count = 133;
  static constexpr double pipe_length = 0.10;
  static constexpr int slice_count = 10;
};
struct closed_rescale_leapfrog : small_closed {
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
  static constexpr Integrator integrator = Integrator::leapfrog;
};

/// Allocations during `work`.
template <class Work>
long long allocations_in(Work&& work) {
  const long long before = allocations;
  work();
  return allocations - before;
}

/// The compiler may leave out an allocation whose result it can follow; not one that it stores here.
void* volatile sink;

TEST_CASE("no heap: the counter sees every kind of allocation") {
  struct alignas(64) Wide {
    double values[8];
  };
  CHECK(allocations_in([] {}) == 0);
  CHECK(allocations_in([] {
          sink = new int(1);
          delete static_cast<int*>(sink);
        }) == (replaces_malloc ? 2 : 1));  // operator new, and the malloc within
  CHECK(allocations_in([] {
          sink = new Wide;
          delete static_cast<Wide*>(sink);
        }) > 0);
  CHECK(allocations_in([] {
          std::vector<double> values(1000);
          sink = values.data();
        }) > 0);
  if (!replaces_malloc) return;
  const auto count_of = [](auto allocate) {
    return allocations_in([&] {
      sink = allocate();
      std::free(sink);
    });
  };
  CHECK(count_of([] { return std::malloc(10); }) == 1);
  CHECK(count_of([] { return std::calloc(10, 10); }) == 1);
  CHECK(count_of([] { return std::realloc(nullptr, 10); }) == 1);
  CHECK(count_of([] { return std::aligned_alloc(64, 64); }) == 1);
}

/// The whole public face of a simulation that renews its list, sorts, opens and closes contacts.
template <class Case>
void check_no_allocation() {
  enter({Case::name, seed()});
  Simulation<Case>& simulation = kernel<Case>();
  if constexpr (is_line<Case>)
    place_all(simulation, spheres_of_line<Case>(0.5, 1, Random(seed())));
  else
    place_all(simulation, layered_spheres<Case>(Case::pipe_length / 7, 0.5, Random(seed())));
  Status status;
  CHECK(allocations_in([&] { status = simulation.start(); }) == 0);
  REQUIRE(status.ok());
  CHECK(allocations_in([&] { status = simulation.run(5000); }) == 0);
  REQUIRE(status.ok());
  CHECK(simulation.listings() > 3);
  double sum = 0;
  CHECK(allocations_in([&] {
          simulation.for_each_contact([&](const Contact& c) { sum += c.normal_force; });
          sum += simulation.observe().max_speed + simulation.energy().elastic + simulation.particle(3).position[0];
          const double history[3] = {};
          simulation.restore_history(0, 1, history);
        }) == 0);
  CHECK(std::isfinite(sum));
}

TEST_CASE("no heap: run() and everything else allocates nothing") {
  check_no_allocation<small_periodic>();
  check_no_allocation<closed_rescale_leapfrog>();
  check_no_allocation<gas_scene>();
  check_no_allocation<short_line>();
  check_no_allocation<in_two_species<short_line>>();
}

}  // namespace
}  // namespace fixdem::tests

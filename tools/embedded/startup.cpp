// From reset to main on a Cortex-M7, and back: vectors, floating-point unit, memory, stack, end.
//
// The stack lies at the lowest addresses of the RAM and grows down, so that one that becomes too deep leaves the memory
// and stops the program instead of writing over the simulation. It is filled with a pattern first; what of it is left
// at the end shows how deep it has been. No library is linked: the four functions that the compiler may call are here.
#include <cstddef>
#include <cstdint>

#include "console.hpp"

int main(int argc, char** argv);

extern "C" {

// mps2_an500.ld
extern std::uint32_t stack_bottom[], stack_top[], data_start[], data_end[], data_image[], bss_start[], bss_end[];
extern void (*constructors_start[])();
extern void (*constructors_end[])();

void* memset(void* to, int value, std::size_t size) {
  auto* bytes = static_cast<volatile unsigned char*>(to);  // volatile: or this loop becomes a call of itself
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<unsigned char>(value);
  return to;
}
void* memcpy(void* to, const void* from, std::size_t size) {
  auto* bytes = static_cast<volatile unsigned char*>(to);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<const unsigned char*>(from)[i];
  return to;
}
void* memmove(void* to, const void* from, std::size_t size) {
  if (to < from) return memcpy(to, from, size);
  auto* bytes = static_cast<volatile unsigned char*>(to);
  for (std::size_t i = size; i > 0; --i) bytes[i - 1] = static_cast<const unsigned char*>(from)[i - 1];
  return to;
}
int memcmp(const void* a, const void* b, std::size_t size) {
  const auto *x = static_cast<const unsigned char*>(a), *y = static_cast<const unsigned char*>(b);
  for (std::size_t i = 0; i < size; ++i)
    if (x[i] != y[i]) return x[i] - y[i];
  return 0;
}
}  // extern "C"

namespace {

namespace console = fixdem::console;
constexpr std::uint32_t untouched = 0x5ac0ffee;

[[noreturn]] void end(int code) {
  const std::uint32_t reason_and_code[] = {0x20026, static_cast<std::uint32_t>(code)};  // "application exit"
  console::ask(console::exit_with_code, reason_and_code);
  for (;;) {
  }
}

void report_stack() {
  const std::uint32_t* deepest = stack_bottom;
  while (deepest < stack_top && *deepest == untouched) ++deepest;
  console::put("# stack: ");
  console::put(static_cast<unsigned long long>(stack_top - deepest) * 4);
  console::put(" bytes used of ");
  console::put(static_cast<unsigned long long>(stack_top - stack_bottom) * 4);
  console::put("\n");
}

/// The words of the command line; main() takes the first for its name.
int split(char* line, char** words, int most) {
  int count = 0;
  for (char* c = line; *c != '\0' && count < most;) {
    while (*c == ' ') *c++ = '\0';
    if (*c != '\0') words[count++] = c;
    while (*c != '\0' && *c != ' ') ++c;
  }
  return count;
}

[[noreturn]] void start() {
  for (std::uint32_t *to = data_start, *from = data_image; to < data_end;) *to++ = *from++;
  for (std::uint32_t* to = bss_start; to < bss_end;) *to++ = 0;
  for (auto construct = constructors_start; construct < constructors_end; ++construct) (*construct)();
  static char line[256];
  static char* words[8];
  const struct {
    char* text;
    std::size_t size;
  } buffer = {line, sizeof line - 1};
  if (console::ask(console::read_command_line, &buffer) != 0) line[0] = '\0';
  const int code = main(split(line, words, 8), words);
  report_stack();
  end(code);
}

}  // namespace

extern "C" {

/// Both coprocessors that make up the floating-point unit (CPACR), then a stack that shows how deep it becomes.
[[noreturn]] __attribute__((naked)) void on_reset() {
  asm volatile(
      "ldr r0, =0xe000ed88 \n"
      "ldr r1, [r0] \n"
      "orr r1, r1, #0xf00000 \n"
      "str r1, [r0] \n"
      "dsb \n"
      "isb \n"
      "ldr r0, =stack_bottom \n"
      "ldr r1, =stack_top \n"
      "ldr r2, =0x5ac0ffee \n"
      "fill: \n"
      "str r2, [r0], #4 \n"
      "cmp r0, r1 \n"
      "bcc fill \n"
      "b go_on \n");
}
[[noreturn]] __attribute__((used)) void go_on() { start(); }

[[noreturn]] void on_fault() {
  // The stack may be what failed: begin a new one.
  asm volatile("msr msp, %0" : : "r"(stack_top));
  console::put("# stopped by a fault of the processor: a bad address, or a stack that is too deep\n");
  end(1);
}

/// Where the processor begins: stack pointer, reset, NMI, and the four faults. No interrupt is ever enabled.
__attribute__((section(".vectors"), used)) const struct {
  std::uint32_t* stack;
  void (*handler[6])();
} vectors = {stack_top, {on_reset, on_fault, on_fault, on_fault, on_fault, on_fault}};
}
